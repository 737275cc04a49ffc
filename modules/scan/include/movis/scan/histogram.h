#pragma once

#include <cstdint>
#include <vector>

namespace movis::scan {

// Extracted pixels over azimuth, the paper's Fig. 4 (§2.3). Bin i covers azimuths [−π + i·w, −π + (i+1)·w) in the
// robot's axes, w = 2π / bins.
struct Histogram {
  std::vector<std::uint32_t> counts;
  double threshold = 0.0;  // pixels a bin; adaptive, of the last scan
};

// The threshold that separates objects from scattered wrongly coloured pixels: mean + `sigmas` standard deviations of
// the bins that lie below it themselves (found by iteration from the top), at least `minimum`.
double adaptive_threshold(const std::vector<std::uint32_t>& counts, double minimum, double sigmas);

// A run of bins at or above the threshold, [first, first + length) modulo the number of bins.
struct Segment {
  int first = 0;
  int length = 0;
  std::uint64_t pixels = 0;
};

// The runs of bins at or above the threshold, around the circle; gaps of up to `bridged` bins within a run are
// bridged. `segments` is cleared first and never grows beyond its capacity: the largest runs are kept.
void find_segments(const Histogram& histogram, int bridged, std::vector<Segment>& segments);

}  // namespace movis::scan
