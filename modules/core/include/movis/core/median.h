#pragma once

#include <algorithm>
#include <vector>

namespace movis {

inline constexpr double kNormalMedian = 1.4826;  // sigma of a normal variable over the median of its magnitude

// The median; of an even number of values the upper of the two in the middle. 0 of none. Reorders the values.
inline double median_in_place(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

inline double median(std::vector<double> values) {
  return median_in_place(values);
}

}  // namespace movis
