#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "movis/experiments/statistics.h"

namespace movis::experiments {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Sum {
  double sum = 0.0;
  int count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  void add(const Sum& other) {
    sum += other.sum;
    count += other.count;
  }
  double mean() const { return count > 0 ? sum / count : kUnknown; }
};

// The 95 % interval of a statistic of draws, which are resampled with all that is theirs: B. Efron, R. Tibshirani, An
// introduction to the bootstrap, 1993, chapter 8. `statistic` is given the numbers of the draws that were picked. Of
// fewer than two draws nothing is known. The same interval for the same draws.
Interval bootstrap(std::size_t draws, const std::function<double(const std::vector<std::size_t>& picked)>& statistic);

// The mean of all first sums as a multiple of that of all second ones; a pair of sums is of one draw.
Ratio ratio_of(const std::vector<std::pair<Sum, Sum>>& draws);

// Of magnitudes, whose sums by draw give the mean's interval.
ErrorStatistics statistics_of(std::vector<double> magnitudes, const std::vector<Sum>& by_draw);

}  // namespace movis::experiments
