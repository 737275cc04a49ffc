#include "movis/scan/histogram.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace movis::scan {

double adaptive_threshold(const std::vector<std::uint32_t>& counts, const ThresholdOptions& options) {
  std::uint32_t peak = 0;
  for (const std::uint32_t count : counts) peak = std::max(peak, count);
  if (peak == 0) return options.minimum;
  // The median by counting: bins hold few pixels, and what holds more than the table is long is no background.
  constexpr std::uint32_t kTable = 256;
  std::array<std::size_t, kTable> bins_with{};
  for (const std::uint32_t count : counts) ++bins_with[std::min(count, kTable - 1)];
  std::uint32_t median = 0;
  for (std::size_t below = bins_with[0]; median + 1 < kTable && 2 * below < counts.size(); below += bins_with[median]) {
    ++median;
  }
  double level = median;
  if (median == 0) level = std::log(static_cast<double>(counts.size()) / static_cast<double>(bins_with[0]));
  return std::max({options.minimum, level + options.sigmas * std::sqrt(level), options.peak_fraction * peak});
}

Histograms::Histograms(int bins) : histograms_(kObjectClasses) {
  for (Histogram& histogram : histograms_) histogram.counts.assign(bins, 0);
}

void Histograms::fill(const PolarMap& map, const std::vector<Stretch>& stretches, const ThresholdOptions& options) {
  for (Histogram& histogram : histograms_) std::fill(histogram.counts.begin(), histogram.counts.end(), 0U);
  for (const Stretch& stretch : stretches) {
    std::uint32_t* counts = histograms_[static_cast<int>(stretch.object)].counts.data();
    const std::uint16_t* bin = &map.bin[map.index(stretch.begin, stretch.row)];
    const std::uint16_t* end = bin + (stretch.end - stretch.begin);
    for (; bin != end; ++bin) ++counts[*bin];
  }
  for (Histogram& histogram : histograms_) histogram.threshold = adaptive_threshold(histogram.counts, options);
}

void find_segments(const Histogram& histogram, int bridged, std::vector<Segment>& segments) {
  segments.clear();
  const int bins = static_cast<int>(histogram.counts.size());
  const auto filled = [&](int bin) { return histogram.counts[bin] >= histogram.threshold; };
  const auto keep = [&](const Segment& segment) {
    if (segments.size() < segments.capacity()) return segments.push_back(segment);
    const auto smallest = std::min_element(segments.begin(), segments.end(),
                                           [](const Segment& a, const Segment& b) { return a.pixels < b.pixels; });
    if (smallest != segments.end() && smallest->pixels < segment.pixels) *smallest = segment;
  };

  // Start behind a gap that is too wide to be bridged, so that no segment crosses the start.
  int start = -1;
  int gap = 0;
  for (int i = 0; i < 2 * bins && start < 0; ++i) {
    const int bin = i < bins ? i : i - bins;
    gap = filled(bin) ? 0 : gap + 1;
    if (gap > bridged) start = bin + 1 < bins ? bin + 1 : 0;
  }
  if (start < 0) start = 0;  // all around

  Segment current;
  gap = 0;
  for (int i = 0; i < bins; ++i) {
    const int bin = start + i < bins ? start + i : start + i - bins;
    if (!filled(bin)) {
      ++gap;
      continue;
    }
    if (current.length > 0 && gap > bridged) {
      keep(current);
      current = {};
    }
    if (current.length == 0) current.first = bin;
    current.length = (bin - current.first + bins) % bins + 1;
    current.pixels += histogram.counts[bin];
    gap = 0;
  }
  if (current.length > 0) keep(current);
}

}  // namespace movis::scan
