#pragma once

#include <cmath>

namespace movis {

// Angles are in radians everywhere in code; degrees appear only in files and on screens, with `_deg` in the name.
inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double angle_deg) {
  return angle_deg * (kPi / 180.0);
}
constexpr double degrees(double angle) {
  return angle * (180.0 / kPi);
}

// The same direction in (−π, π].
inline double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2.0 * kPi);  // in [−π, π]
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

// The turn from `from` to `to`, in (−π, π].
inline double turn(double from, double to) {
  return wrap_angle(to - from);
}

}  // namespace movis
