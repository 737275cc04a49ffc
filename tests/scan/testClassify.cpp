#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <array>
#include <memory>
#include <tuple>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/random.h"
#include "movis/scan/classify.h"
#include "support/temporary_folder.h"

namespace movis::scan {
namespace {

using Runs = std::vector<scan::Run>;    // testing::Test has a Run of its own
using Key = std::tuple<int, int, int>;  // v, u, class

int random_integer(RandomStream& stream, int min, int max) {
  return std::uniform_int_distribution<int>(min, max)(stream);
}

// An image in memory of exactly its size: its last row ends with its last pixel, so that a sanitizer sees a byte more.
struct Image {
  std::unique_ptr<std::uint8_t[]> bytes;
  std::size_t size;
  ImageView view;

  Image(int width, int height, PixelFormat format, int padding, RandomStream& stream) {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(width) * channels(format);
    const std::ptrdiff_t stride = row + padding;
    size = static_cast<std::size_t>(stride * (height - 1) + row);
    bytes.reset(new std::uint8_t[size]);
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(random_integer(stream, 0, 255));
    view = {bytes.get(), width, height, stride, format};
  }
};

IntegerClass colour_class(ObjectClass object, double from_deg, double width_deg, double chroma, double brightness) {
  return to_integers({object, radians(from_deg), radians(width_deg), chroma, 1.0, brightness, 1.0});
}

std::vector<IntegerClass> overlapping_classes() {
  return {colour_class(ObjectClass::yellow_goal, 20.0, 60.0, 0.2, 0.3),
          colour_class(ObjectClass::ball, 0.0, 40.0, 0.1, 0.2),
          colour_class(ObjectClass::blue_goal, 170.0, 170.0, 0.3, 0.1),
          to_integers({ObjectClass::obstacle, 0.0, 2.0 * kPi, 0.05, 0.25, 0.0, 0.5})};
}

// Pixel by pixel, the first class that it belongs to.
std::vector<Key> one_by_one(const ImageView& image, const Runs& runs, const std::vector<IntegerClass>& classes) {
  std::vector<Key> keys;
  for (const Run& run : runs) {
    for (int u = run.begin; u < run.end; ++u) {
      const std::uint8_t* pixel = image.row(run.row) + u * channels(image.format);
      const int red = image.format == PixelFormat::bgr8 ? 2 : 0;
      for (const IntegerClass& colour : classes) {
        if (!belongs(colour, pixel[red], pixel[1], pixel[2 - red])) continue;
        keys.emplace_back(run.row, u, static_cast<int>(colour.object));
        break;
      }
    }
  }
  return keys;
}

std::vector<Stretch> classify_into_stretches(const ImageView& image, const Runs& runs,
                                             const std::vector<IntegerClass>& classes) {
  std::vector<Stretch> stretches;
  classify(image, runs, classes, stretches);
  return stretches;
}

// The pixels of the stretches, one by one.
std::vector<Key> classified(const ImageView& image, const Runs& runs, const std::vector<IntegerClass>& classes) {
  std::vector<Key> keys;
  for (const Stretch& stretch : classify_into_stretches(image, runs, classes)) {
    EXPECT_LT(stretch.begin, stretch.end);
    for (int u = stretch.begin; u < stretch.end; ++u) {
      keys.emplace_back(stretch.row, u, static_cast<int>(stretch.object));
    }
  }
  return keys;
}

Runs random_runs(const ImageView& image, RandomStream& stream) {
  Runs runs;
  for (int row = 0; row < image.height; ++row) {
    for (int u = random_integer(stream, 0, 20); u < image.width; u += random_integer(stream, 1, 20)) {
      const int end = std::min(image.width, u + random_integer(stream, 1, 150));
      runs.push_back({row, u, end});
      u = end;
    }
  }
  return runs;
}

std::vector<Key> of_class(const std::vector<Key>& keys, int object) {
  std::vector<Key> chosen;
  std::copy_if(keys.begin(), keys.end(), std::back_inserter(chosen),
               [&](const Key& key) { return std::get<2>(key) == object; });
  return chosen;
}

// The same pixels, and those of every class in memory order.
void expect_same_hits(const std::vector<Key>& hits, const std::vector<Key>& expected) {
  EXPECT_EQ(hits.size(), expected.size());
  for (int object = 0; object < kObjectClasses; ++object) {
    EXPECT_EQ(of_class(hits, object), of_class(expected, object)) << name(static_cast<ObjectClass>(object));
  }
}

// Once for every instruction set that the processor has.
template <typename Body>
void on_every_instruction_set(Body body) {
  for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
    const std::int64_t target = targets & -targets;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    SCOPED_TRACE(hwy::TargetName(target));
    body();
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().DeInit();
  }
}

class EveryFormat : public testing::TestWithParam<PixelFormat> {};

INSTANTIATE_TEST_SUITE_P(Classify, EveryFormat,
                         testing::Values(PixelFormat::bgr8, PixelFormat::rgb8, PixelFormat::rgba8),
                         [](const auto& format) { return std::string(name(format.param)); });

// Runs of every length, the last of which ends at the image's very last byte.
TEST_P(EveryFormat, RunsOfEveryLength) {
  RandomStream stream = make_stream(1, 1);
  const auto classes = overlapping_classes();
  on_every_instruction_set([&] {
    for (int length = 1; length <= 200; ++length) {
      const Image image(length, 2, GetParam(), 0, stream);
      const Runs runs = {{0, 0, length}, {1, 0, length}};
      SCOPED_TRACE(length);
      expect_same_hits(classified(image.view, runs, classes), one_by_one(image.view, runs, classes));
    }
  });
}

// Runs anywhere in rows that are followed by padding, random colours and, with them, stretches of every length.
TEST_P(EveryFormat, RandomRunsAndStrides) {
  RandomStream stream = make_stream(2, 1);
  const auto classes = overlapping_classes();
  on_every_instruction_set([&] {
    std::size_t hits = 0;
    for (int round = 0; round < 50; ++round) {
      const int width = random_integer(stream, 1, 300);
      const Image image(width, random_integer(stream, 1, 12), GetParam(), random_integer(stream, 0, 40), stream);
      const Runs runs = random_runs(image.view, stream);
      const auto expected = one_by_one(image.view, runs, classes);
      SCOPED_TRACE(round);
      expect_same_hits(classified(image.view, runs, classes), expected);
      hits += expected.size();
    }
    EXPECT_GT(hits, 5000U);
  });
}

// Two classes of the same colours: the one that comes first takes every pixel.
TEST_P(EveryFormat, OfOverlappingClassesTheFirstCounts) {
  RandomStream stream = make_stream(3, 1);
  const Image image(131, 3, GetParam(), 5, stream);
  const Runs runs = {{0, 0, 131}, {1, 0, 131}, {2, 0, 131}};
  const auto ball = colour_class(ObjectClass::ball, 0.0, 120.0, 0.0, 0.0);
  const auto goal = colour_class(ObjectClass::yellow_goal, 0.0, 120.0, 0.0, 0.0);
  const auto first_ball = classified(image.view, runs, {ball, goal});
  const auto first_goal = classified(image.view, runs, {goal, ball});
  EXPECT_GT(first_ball.size(), 50U);
  EXPECT_EQ(first_ball.size(), first_goal.size());
  EXPECT_EQ(of_class(first_ball, static_cast<int>(ObjectClass::ball)).size(), first_ball.size());
  EXPECT_EQ(of_class(first_goal, static_cast<int>(ObjectClass::yellow_goal)).size(), first_goal.size());
}

// By hand: one red pixel each in the bytes' order of the format.
TEST(Classify, OrderOfTheChannels) {
  const std::vector<IntegerClass> red = {colour_class(ObjectClass::ball, 350.0, 20.0, 0.5, 0.5)};
  const std::uint8_t bgr[] = {9, 9, 240, 240, 9, 9};
  const std::uint8_t rgba[] = {9, 9, 240, 0, 240, 9, 9, 0};
  const Runs runs = {{0, 0, 2}};
  EXPECT_EQ(classified({bgr, 2, 1, 6, PixelFormat::bgr8}, runs, red), (std::vector<Key>{{0, 0, 0}}));
  EXPECT_EQ(classified({bgr, 2, 1, 6, PixelFormat::rgb8}, runs, red), (std::vector<Key>{{0, 1, 0}}));
  EXPECT_EQ(classified({rgba, 2, 1, 8, PixelFormat::rgba8}, runs, red), (std::vector<Key>{{0, 1, 0}}));
}

// Most vectors are done after a cheap test, which must let pass every vector with a pixel of the class: here one alone
// in a grey row, of hardly more than the least chroma.
TEST(Classify, LonePixelsAreFound) {
  RandomStream stream = make_stream(6, 1);
  std::vector<std::uint8_t> bytes(3 * 100, 128);
  const ImageView image{bytes.data(), 100, 1, 300, PixelFormat::rgb8};
  int found = 0;
  for (int round = 0; round < 20000; ++round) {
    const double width_deg = round % 2 == 0 ? 10.0 : random_integer(stream, 1, 175);
    const int chroma = random_integer(stream, 3, 200);
    const IntegerClass colour =
        colour_class(ObjectClass::ball, random_integer(stream, 0, 359), width_deg, chroma / 255.0, 0.0);
    const int low = random_integer(stream, 0, 50);
    const int high = std::min(255, low + chroma + random_integer(stream, 0, 3));
    std::array<std::uint8_t, 3> rgb = {static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(high),
                                       static_cast<std::uint8_t>(random_integer(stream, low, high))};
    std::shuffle(rgb.begin(), rgb.end(), stream);
    if (!belongs(colour, rgb[0], rgb[1], rgb[2])) continue;
    const int u = random_integer(stream, 0, 99);
    std::copy(rgb.begin(), rgb.end(), bytes.begin() + 3 * u);
    ASSERT_EQ(classified(image, {{0, 0, 100}}, {colour}), (std::vector<Key>{{0, u, 0}})) << round;
    std::fill(bytes.begin(), bytes.end(), std::uint8_t{128});
    ++found;
  }
  EXPECT_GT(found, 1000);
}

// A uniform row, longer than any vector and with a wrong pixel in it, is two stretches.
TEST(Classify, StretchesAreAsLongAsTheyCanBe) {
  std::vector<std::uint8_t> bytes(3 * 500);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = i % 3 == 0 ? 240 : 9;
  bytes[3 * 321] = 9;  // red becomes grey
  const std::vector<IntegerClass> red = {colour_class(ObjectClass::ball, 350.0, 20.0, 0.5, 0.5)};
  on_every_instruction_set([&] {
    const auto stretches = classify_into_stretches({bytes.data(), 500, 1, 1500, PixelFormat::rgb8}, {{0, 3, 499}}, red);
    ASSERT_EQ(stretches.size(), 2U);
    EXPECT_EQ(std::tie(stretches[0].begin, stretches[0].end), std::make_tuple(3, 321));
    EXPECT_EQ(std::tie(stretches[1].begin, stretches[1].end), std::make_tuple(322, 499));
  });
}

TEST(Classify, AppendsToWhatIsThere) {
  const std::uint8_t red[] = {240, 9, 9};
  std::vector<Stretch> stretches(1);  // column 0 of row 0, empty
  stretches[0].row = 7;
  classify({red, 1, 1, 3, PixelFormat::rgb8}, {{0, 0, 1}}, {colour_class(ObjectClass::ball, 350.0, 20.0, 0.5, 0.5)},
           stretches);
  EXPECT_EQ(stretches.size(), 2U);
}

TEST(Classify, GreyAndRawImagesAreErrors) {
  const std::uint8_t bytes[3] = {};
  for (const PixelFormat format : {PixelFormat::mono8, PixelFormat::bayer_rggb8, PixelFormat::bayer_bggr8,
                                   PixelFormat::bayer_grbg8, PixelFormat::bayer_gbrg8}) {
    test::expect_error(
        [&] {
          classify_into_stretches({bytes, 1, 1, 1, format}, {{0, 0, 1}}, overlapping_classes());
        },
        {name(format), "convert"});
  }
}

TEST(Classify, DetectedAreBallAndGoals) {
  Colours colours;
  for (int i = kObjectClasses - 1; i >= 0; --i) {
    colours.classes.push_back({static_cast<ObjectClass>(i), 0.0, 1.0, 0.0, 1.0, 0.0, 1.0});
  }
  const auto classes = detected_classes(colours);
  ASSERT_EQ(classes.size(), 3U);
  EXPECT_EQ(classes[0].object, ObjectClass::blue_goal);  // in the order of the colours
  EXPECT_EQ(classes[1].object, ObjectClass::yellow_goal);
  EXPECT_EQ(classes[2].object, ObjectClass::ball);
}

}  // namespace
}  // namespace movis::scan
