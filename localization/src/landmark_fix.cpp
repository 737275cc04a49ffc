#include "landmark_fix.h"

#include <algorithm>
#include <cmath>

namespace movis::localization {
namespace {

using triangulation::GoalPoints;

bool seen(const GoalPoints& goal) {
  return goal.centre_status != PointStatus::not_seen || goal.edges_status != PointStatus::not_seen;
}

bool measured(const GoalPoints& goal, Needs needs) {
  const bool centre = goal.centre_status == PointStatus::ok && goal.centre.allFinite();
  const bool edges = goal.edges_status == PointStatus::ok && goal.left.allFinite() && goal.right.allFinite();
  return (centre || needs == Needs::edges) && (edges || needs == Needs::centres);
}

}  // namespace

FixStatus landmark_status(const triangulation::GoalLandmarks& landmarks, Needs needs) {
  const auto& [yellow, blue] = landmarks;
  if (!seen(yellow) && !seen(blue)) return FixStatus::no_goal;
  if (!seen(yellow) || !seen(blue)) return FixStatus::one_goal;
  return measured(yellow, needs) && measured(blue, needs) ? FixStatus::ok : FixStatus::no_distance;
}

Fix fix_from(const Solution& solution, const triangulation::GoalLandmarks& landmarks, const Field& field) {
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = solution.world_from_robot;
  fix.covariance.noalias() = solution.by_yellow * landmarks.yellow.covariance * solution.by_yellow.transpose();
  fix.covariance.noalias() += solution.by_blue * landmarks.blue.covariance * solution.by_blue.transpose();
  const bool finite = fix.world_from_robot.translation().allFinite() && std::isfinite(fix.world_from_robot.beta) &&
                      fix.covariance.allFinite();
  if (!finite) return failed(FixStatus::no_distance);
  if (far_outside(fix.world_from_robot, field, kOutsideMargin)) return failed(FixStatus::outside_field);
  return fix;
}

bool far_outside(const Pose2& world_from_robot, const Field& field, double margin) {
  const double back = std::max(field.half_length, field.Fd + field.goal_depth + field.goal_thickness);
  return std::abs(world_from_robot.x) > field.half_width + margin || std::abs(world_from_robot.y) > back + margin;
}

Fix failed(FixStatus status) {
  Fix fix;
  fix.status = status;
  return fix;
}

}  // namespace movis::localization
