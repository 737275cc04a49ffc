#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "movis/core/angle.h"

namespace movis::calibration {

// A direction on the floor plane, robot frame.
struct PlanarRay {
  Eigen::Vector2d origin;  // metres
  double azimuth;          // radians
};

// Where the rays' lines come nearest to each other, by the sum of squared distances; nothing where they are parallel.
inline std::optional<Eigen::Vector2d> meeting_point(const std::vector<PlanarRay>& rays) {
  Eigen::Matrix2d normal_matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right_side = Eigen::Vector2d::Zero();
  for (const PlanarRay& ray : rays) {
    const Eigen::Vector2d across(-std::sin(ray.azimuth), std::cos(ray.azimuth));
    normal_matrix += across * across.transpose();
    right_side += across * across.dot(ray.origin);
  }
  constexpr double kParallel = 1e-7;
  if (normal_matrix.determinant() < kParallel) return std::nullopt;
  return Eigen::Vector2d(normal_matrix.inverse() * right_side);
}

// By how much the rays miss the point in which they should meet: the largest angle; π where they meet nowhere.
inline double largest_error(const std::vector<PlanarRay>& rays) {
  const auto point = meeting_point(rays);
  if (!point) return kPi;
  double largest = 0.0;
  for (const PlanarRay& ray : rays) {
    const Eigen::Vector2d offset = *point - ray.origin;
    largest = std::max(largest, std::abs(turn(std::atan2(offset.y(), offset.x()), ray.azimuth)));
  }
  return largest;
}

}  // namespace movis::calibration
