#pragma once

#include <cstdint>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/scan/classify.h"
#include "movis/scan/polar_map.h"

namespace movis::scan {

// Extracted pixels over azimuth, the paper's Fig. 4 (§2.3). Bin i covers azimuths [−π + i·w, −π + (i+1)·w) in the
// robot's axes, w = 2π / bins.
struct Histogram {
  std::vector<std::uint32_t> counts;
  double threshold = 0.0;  // pixels a bin; adaptive, of the last scan
};

struct ThresholdOptions {
  double minimum = 2.0;         // pixels a bin
  double sigmas = 4.0;          // above scattered wrong pixels
  double peak_fraction = 0.15;  // of the fullest bin
};

// The adaptive threshold of §2.3, in place of compressing and enlarging the image: what is scattered over all azimuths
// is noise, Poisson-distributed with a level of m pixels a bin: the median of the bins, or, where that is 0, −ln of the
// share of empty bins. An object stands out from it and is not a small part of the fullest bin:
//   max(minimum, m + sigmas √m, peak_fraction · peak)
double adaptive_threshold(const std::vector<std::uint32_t>& counts, const ThresholdOptions& options);

// One histogram for each object class.
class Histograms {
 public:
  explicit Histograms(int bins);

  // Counts the stretches' pixels by class and bin, and sets the thresholds.
  void fill(const PolarMap& map, const std::vector<Stretch>& stretches, const ThresholdOptions& options = {});
  const Histogram& operator[](ObjectClass object) const { return histograms_[static_cast<int>(object)]; }

 private:
  std::vector<Histogram> histograms_;
};

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
