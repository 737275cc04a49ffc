#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "movis/core/status.h"

namespace movis::localization {

enum class ObjectStatus : std::uint8_t {
  ok,
  no_point,    // the object's point was not measured
  no_pose,     // the robot's pose was not
  not_finite,  // point, pose or a covariance is not finite, or too large to compute with
};

// Where an object is on the field. With a status other than ok, point and covariance mean nothing.
struct ObjectPosition {
  ObjectStatus status = ObjectStatus::no_point;
  Eigen::Vector2d in_field = Eigen::Vector2d::Zero();    // metres
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // m²
};

// The absolute position of an object on the floor plane, from its point in the robot frame and the robot's pose.
//
// Source: the MOVIS paper, steps 1, 2 and 4 of section 2.4, by (5)–(6). With the point p, the pose (X_R, Y_R, β) and
// the rotation R(β), metres and radians:
//   P = (X_R, Y_R)ᵀ + R(β) p
// R'(β) = E R(β) with the quarter turn E = (0 −1; 1 0), so dP = d(X_R, Y_R) + E R p dβ + R dp. With the arm a = R p =
// P − (X_R, Y_R), to first order:
//   C_P = J C_pose Jᵀ + R C_p Rᵀ,   J = ∂P/∂(X_R, Y_R, β) = (1  0  −a_y;  0  1  a_x)
// Point and pose are taken as independent, as the noise of their bearings is: they come from different objects. What
// both have in common is left out: an error of the rig moves both, and only the error correction takes it away.
//
// Domain: an arm |a| whose second-order term |a| σ_β²/2 is small beside the result's standard deviation. The height of
// the point does not count.
// Fails with no_point, no_pose and not_finite; no_point where both are missing.
ObjectPosition object_position(const Fix& fix, const PointEstimate& point_in_robot);

}  // namespace movis::localization
