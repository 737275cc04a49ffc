#pragma once

#include <cmath>

#include "movis/core/pose.h"

namespace movis {

// A planar velocity, expressed in the moving robot's own frame: x right, y forward, omega counter-clockwise.
struct Twist2 {
  double vx = 0.0;     // m/s
  double vy = 0.0;     // m/s
  double omega = 0.0;  // rad/s

  Eigen::Vector2d translation() const { return {vx, vy}; }
};

// Where a robot stands in the frame it started in, after it kept the twist for a time: the exponential map of SE(2),
// exact for any turn (J. Solà et al., A micro Lie theory, 2018, example 3).
inline Pose2 start_from_end(const Twist2& twist, double seconds) {
  const double angle = twist.omega * seconds;
  const bool small = std::abs(angle) < 1e-6;
  const double a = small ? 1.0 - angle * angle / 6.0 : std::sin(angle) / angle;
  const double b = small ? angle / 2.0 : (1.0 - std::cos(angle)) / angle;
  const double dx = twist.vx * seconds;
  const double dy = twist.vy * seconds;
  return {a * dx - b * dy, b * dx + a * dy, wrap_angle(angle)};
}

}  // namespace movis
