#pragma once

#include <Eigen/Core>
#include <cmath>

#include "movis/core/angle.h"

namespace movis {

// A planar rigid transform, named after the frames it joins so that names cancel when composed:
//   world_from_ball = world_from_robot * robot_from_ball
// As world_from_robot, (x, y) is the robot's origin in the field frame (metres) and beta the angle from the field's
// X axis to the robot's x axis (radians): the paper's (X_R, Y_R, β), equations (5)–(6).
struct Pose2 {
  double x = 0.0;
  double y = 0.0;
  double beta = 0.0;

  Eigen::Vector2d translation() const { return {x, y}; }
};

// A point in the right frame of the transform, expressed in its left frame.
inline Eigen::Vector2d operator*(const Pose2& a_from_b, const Eigen::Vector2d& point_in_b) {
  const double c = std::cos(a_from_b.beta);
  const double s = std::sin(a_from_b.beta);
  return {a_from_b.x + c * point_in_b.x() - s * point_in_b.y(), a_from_b.y + s * point_in_b.x() + c * point_in_b.y()};
}

inline Pose2 operator*(const Pose2& a_from_b, const Pose2& b_from_c) {
  const Eigen::Vector2d origin_in_a = a_from_b * b_from_c.translation();
  return {origin_in_a.x(), origin_in_a.y(), wrap_angle(a_from_b.beta + b_from_c.beta)};
}

// Turned by half a turn about the frame's origin: what a field with white goals shows no difference to.
inline Pose2 half_turned(const Pose2& pose) {
  return {-pose.x, -pose.y, wrap_angle(pose.beta + kPi)};
}

inline Pose2 inverse(const Pose2& a_from_b) {
  const double c = std::cos(a_from_b.beta);
  const double s = std::sin(a_from_b.beta);
  return {-c * a_from_b.x - s * a_from_b.y, s * a_from_b.x - c * a_from_b.y, wrap_angle(-a_from_b.beta)};
}

}  // namespace movis
