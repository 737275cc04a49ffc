#pragma once

#include <cmath>

namespace movis::sim {

// The sRGB curve (IEC 61966-2-1), both ways; values in 0…1.
inline double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
inline double srgb_of_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1.0 / 2.4) - 0.055;
}

}  // namespace movis::sim
