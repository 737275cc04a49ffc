#pragma once

#include <Eigen/Core>

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/localization/localizer.h"
#include "movis/triangulation/goal_points.h"

// What the three methods of the paper share: whether the landmarks suffice, and what becomes of a solution.
namespace movis::localization {

// Columns of a GoalPoints: (centre, left, right), two each.
inline constexpr int kCentre = 0;
inline constexpr int kLeft = 2;
inline constexpr int kRight = 4;
using GoalGradient = Eigen::Matrix<double, 1, 6>;
using GoalJacobian = Eigen::Matrix<double, 3, 6>;

// Rows of a GoalJacobian.
inline constexpr int kX = 0;
inline constexpr int kY = 1;
inline constexpr int kBeta = 2;

// A pose and its derivatives by the points of either goal.
struct Solution {
  Pose2 world_from_robot;
  GoalJacobian by_yellow = GoalJacobian::Zero();
  GoalJacobian by_blue = GoalJacobian::Zero();
};

enum class Needs { centres, edges, both };

// ok, no_goal, one_goal or no_distance.
FixStatus landmark_status(const triangulation::GoalLandmarks& landmarks, Needs needs);

// The solution as a fix: with J C Jᵀ, the goals being independent of each other; no_distance where a number is not
// finite, outside_field where the robot cannot be. Whatever is not finite on the way shows here.
Fix fix_from(const Solution& solution, const triangulation::GoalLandmarks& landmarks, const Field& field);

// Farther than the margin, metres, beyond the lines or the goals' backs.
bool far_outside(const Pose2& world_from_robot, const Field& field, double margin);

// A fix without a pose.
Fix failed(FixStatus status);

}  // namespace movis::localization
