#include <gtest/gtest.h>

#include <algorithm>

#include "movis/scan/histogram.h"

namespace movis::scan {
namespace {

using Counts = std::vector<std::uint32_t>;

constexpr ThresholdOptions kOptions{2.0, 4.0, 0.15};  // minimum, sigmas, peak fraction

std::vector<Segment> segments_of(const Counts& counts, double threshold, int bridged, std::size_t capacity = 16) {
  std::vector<Segment> segments(3);  // is cleared
  segments.reserve(capacity);
  find_segments({counts, threshold}, bridged, segments);
  std::sort(segments.begin(), segments.end(), [](const Segment& a, const Segment& b) { return a.first < b.first; });
  return segments;
}

void expect_segment(const Segment& segment, int first, int length, std::uint64_t pixels) {
  EXPECT_EQ(segment.first, first);
  EXPECT_EQ(segment.length, length);
  EXPECT_EQ(segment.pixels, pixels);
}

// One object on nothing: the median is 0, so that its share of the peak decides, 0.15 · 40 = 6, …
TEST(AdaptiveThreshold, FractionOfThePeak) {
  EXPECT_DOUBLE_EQ(adaptive_threshold({0, 0, 0, 10, 40, 10, 0, 0, 0}, kOptions), 6.0);
}

// … unless the peak is so low that the minimum does: 0.15 · 10 < 2.
TEST(AdaptiveThreshold, Minimum) {
  EXPECT_DOUBLE_EQ(adaptive_threshold({0, 0, 0, 10, 0, 0, 0, 0, 0}, kOptions), 2.0);
}

// Wrong pixels all around, nine in the median bin: 9 + 4 √9 = 21, above 0.15 · 100.
TEST(AdaptiveThreshold, NoiseFloor) {
  EXPECT_DOUBLE_EQ(adaptive_threshold({9, 8, 9, 10, 100, 9, 7, 11, 9}, kOptions), 21.0);
  ThresholdOptions fewer = kOptions;
  fewer.sigmas = 1.0;
  EXPECT_DOUBLE_EQ(adaptive_threshold({9, 8, 9, 10, 60, 9, 7, 11, 9}, fewer), 12.0);  // 9 + √9, above 0.15 · 60 = 9
}

// The median is the value that half of the bins do not exceed: of 1, 1, 1, 4, 4, 4, 4 it is 4, which gives 4 + 4 √4.
TEST(AdaptiveThreshold, MedianByCounting) {
  EXPECT_DOUBLE_EQ(adaptive_threshold({4, 1, 4, 1, 4, 1, 4}, kOptions), 12.0);
  EXPECT_DOUBLE_EQ(adaptive_threshold({4, 1, 4, 1, 1, 1, 4}, kOptions), 5.0);  // 1 + 4 √1
}

// An object that fills most of the picture is not taken for noise for ever: the median is counted up to 255 only.
TEST(AdaptiveThreshold, FullerThanTheTable) {
  EXPECT_NEAR(adaptive_threshold(Counts(360, 4000), kOptions), 600.0, 1e-9);  // 0.15 · 4000, above 255 + 4 √255 = 318.9
}

TEST(AdaptiveThreshold, Empty) {
  EXPECT_DOUBLE_EQ(adaptive_threshold({}, kOptions), 2.0);
  EXPECT_DOUBLE_EQ(adaptive_threshold(Counts(720, 0), kOptions), 2.0);
}

// Two rows of four pixels with the bins 0 1 2 2 and 3 3 0 1.
TEST(Histograms, CountPixelsByClassAndBin) {
  PolarMap map;
  map.width = 4;
  map.height = 2;
  map.bins = 4;
  map.bin = {0, 1, 2, 2, 3, 3, 0, 1};
  map.ray.resize(8);
  Histograms histograms(4);
  for (int scan = 0; scan < 2; ++scan) {  // the second scan forgets the first
    histograms.fill(map,
                    {{0, 1, 4, ObjectClass::ball}, {1, 0, 1, ObjectClass::blue_goal}, {1, 1, 4, ObjectClass::ball}},
                    {1.5, 1.0, 0.1});
    EXPECT_EQ(histograms[ObjectClass::ball].counts, (Counts{1, 2, 2, 1}));
    EXPECT_EQ(histograms[ObjectClass::blue_goal].counts, (Counts{0, 0, 0, 1}));
    EXPECT_EQ(histograms[ObjectClass::yellow_goal].counts, (Counts{0, 0, 0, 0}));
    EXPECT_DOUBLE_EQ(histograms[ObjectClass::ball].threshold, 2.0);  // the lower median 1, and √1
    EXPECT_DOUBLE_EQ(histograms[ObjectClass::blue_goal].threshold, 1.5);
  }
}

TEST(FindSegments, ByHand) {
  const auto segments = segments_of({0, 5, 7, 0, 0, 0, 3, 2, 0, 4}, 3.0, 0);
  ASSERT_EQ(segments.size(), 3U);
  expect_segment(segments[0], 1, 2, 12);
  expect_segment(segments[1], 6, 1, 3);  // at the threshold it is in, below it not
  expect_segment(segments[2], 9, 1, 4);
}

TEST(FindSegments, AcrossTheWrap) {
  const auto segments = segments_of({5, 6, 0, 0, 0, 0, 9, 0, 3, 4}, 3.0, 0);
  ASSERT_EQ(segments.size(), 2U);
  expect_segment(segments[0], 6, 1, 9);
  expect_segment(segments[1], 8, 4, 18);
}

TEST(FindSegments, BridgesGapsUpToTheLimit) {
  const Counts counts = {0, 0, 5, 1, 1, 5, 0, 0, 0, 5, 0, 0};
  const auto two = segments_of(counts, 3.0, 2);
  ASSERT_EQ(two.size(), 2U);
  expect_segment(two[0], 2, 4, 10);  // what lies below the threshold is bridged, not counted
  expect_segment(two[1], 9, 1, 5);
  const auto three = segments_of(counts, 3.0, 3);
  ASSERT_EQ(three.size(), 1U);
  expect_segment(three[0], 2, 8, 15);
  EXPECT_EQ(segments_of(counts, 3.0, 1).size(), 3U);
}

TEST(FindSegments, BridgesAcrossTheWrap) {
  const auto segments = segments_of({0, 5, 0, 0, 0, 0, 0, 0, 6, 0}, 3.0, 2);
  ASSERT_EQ(segments.size(), 1U);
  expect_segment(segments[0], 8, 4, 11);
}

TEST(FindSegments, AllAround) {
  const auto full = segments_of(Counts(8, 5), 3.0, 0);
  ASSERT_EQ(full.size(), 1U);
  EXPECT_EQ(full[0].length, 8);
  EXPECT_EQ(full[0].pixels, 40U);
  const auto bridged = segments_of({0, 5, 5, 0, 5, 5, 0, 5}, 3.0, 1);  // nowhere a gap that is too wide
  ASSERT_EQ(bridged.size(), 1U);
  EXPECT_GE(bridged[0].length, 7);
  EXPECT_LE(bridged[0].length, 8);
  EXPECT_EQ(bridged[0].pixels, 25U);
}

TEST(FindSegments, NothingAboveTheThreshold) {
  EXPECT_TRUE(segments_of(Counts(12, 2), 3.0, 2).empty());
  EXPECT_TRUE(segments_of({}, 3.0, 2).empty());
}

TEST(FindSegments, KeepsTheLargestWithinItsCapacity) {
  const Counts counts = {5, 0, 9, 0, 3, 0, 8, 0, 7, 0, 4, 0};
  std::vector<Segment> segments;
  segments.reserve(3);
  const std::size_t capacity = segments.capacity();
  ASSERT_EQ(capacity, 3U);
  find_segments({counts, 3.0}, 0, segments);
  EXPECT_EQ(segments.capacity(), capacity);  // the scan allocates nothing
  ASSERT_EQ(segments.size(), 3U);
  std::vector<std::uint64_t> pixels(3);
  std::transform(segments.begin(), segments.end(), pixels.begin(), [](const Segment& s) { return s.pixels; });
  std::sort(pixels.begin(), pixels.end());
  EXPECT_EQ(pixels, (std::vector<std::uint64_t>{7, 8, 9}));
}

}  // namespace
}  // namespace movis::scan
