#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace movis::sim {

// A part of the sphere of directions: azimuths within half_width of `azimuth`, elevations from low to high. Radians.
struct Bounds {
  float azimuth = 0.0F;
  float half_width = 0.0F;
  float low = 0.0F, high = 0.0F;

  // Grows by a unit direction. Straight up and down have every azimuth, so a set of directions that goes around them
  // must come with a half width of more than a quarter turn to be seen as such; it then has them all.
  void include(const Eigen::Vector3f& direction) {
    const float elevation = std::asin(std::clamp(direction.z(), -1.0F, 1.0F));
    low = std::min(low, elevation);
    high = std::max(high, elevation);
    const float off = std::remainder(std::atan2(direction.y(), direction.x()) - azimuth, kTurn);
    half_width = std::max(half_width, std::abs(off));
    if (half_width > kTurn / 4.0F) widen();
  }

  bool meets(const Bounds& other) const {
    if (low > other.high || high < other.low) return false;
    return std::abs(std::remainder(azimuth - other.azimuth, kTurn)) <= half_width + other.half_width;
  }

 private:
  static constexpr float kTurn = 6.2831853F;
  void widen() {
    half_width = kTurn / 2.0F;
    (low < 0.0F ? low : high) = low < 0.0F ? -kTurn / 4.0F : kTurn / 4.0F;
  }
};

}  // namespace movis::sim
