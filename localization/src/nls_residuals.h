#pragma once

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/localization/goal_silhouette.h"
#include "nls_solve.h"

// The residuals of nls.h and their derivatives.
namespace movis::localization {

struct State {
  Pose2 pose;
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
};

// Calls visit(edge, residual, its derivative by the unknowns).
template <typename Visit>
void for_each_edge(const Problem& problem, const State& state, Visit visit) {
  const double c = std::cos(state.pose.beta);
  const double s = std::sin(state.pose.beta);
  Silhouette silhouette;
  Eigen::Vector2d viewpoint, arm;
  int sight = -1;
  for (const GoalEdge& edge : problem.edges) {
    if (edge.sight != sight) {
      sight = edge.sight;
      const Eigen::Vector2d& in_robot = edge.viewpoint_in_robot;
      arm = {c * in_robot.x() - s * in_robot.y(), s * in_robot.x() + c * in_robot.y()};
      viewpoint = state.pose.translation() + arm;
      silhouette = goal_silhouette(problem.map.field, edge.goal, viewpoint);
    }
    const double azimuth = edge.is_left ? silhouette.left : silhouette.right;
    const Eigen::Vector2d to_corner = (edge.is_left ? silhouette.left_corner : silhouette.right_corner) - viewpoint;
    const double squared = std::max(1e-4, to_corner.squaredNorm());
    // The azimuth's derivative by the viewpoint is (y, −x)/ρ², and the viewpoint's by β is (−arm_y, arm_x).
    const Eigen::Vector2d by_viewpoint(to_corner.y() / squared, -to_corner.x() / squared);
    Vector5 by_unknowns = Vector5::Zero();
    by_unknowns.head<2>() = -by_viewpoint;
    by_unknowns[2] = 1.0 - (by_viewpoint.y() * arm.x() - by_viewpoint.x() * arm.y());
    by_unknowns[3 + edge.bias()] = -edge.outwards();
    const double residual = turn(azimuth - state.pose.beta, edge.azimuth) - edge.outwards() * state.bias[edge.bias()];
    visit(edge, residual, by_unknowns);
  }
}

// Calls visit(sigma, distance, its derivative by x, y, β).
template <typename Visit>
void for_each_line_point(const Problem& problem, const State& state, Visit visit) {
  const double c = std::cos(state.pose.beta);
  const double s = std::sin(state.pose.beta);
  const double floor = problem.options.line_floor;
  const std::size_t count = std::min<std::size_t>(problem.lines.size(), kMostLinePoints);
  for (std::size_t i = 0; i < count; ++i) {
    const LinePoint& point = problem.lines[i];
    const Eigen::Vector2d arm(c * point.point.x() - s * point.point.y(), s * point.point.x() + c * point.point.y());
    const LineMap::Offset offset = problem.map.lines.offset(state.pose.translation() + arm);
    const Eigen::Vector2d& n = offset.normal;
    const double sigma = std::sqrt(point.sigma_on_floor * point.sigma_on_floor + floor * floor);
    visit(sigma, offset.distance, Eigen::Vector3d(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y()));
  }
}

}  // namespace movis::localization
