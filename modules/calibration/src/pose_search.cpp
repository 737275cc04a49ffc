#include "pose_search.h"

#include <algorithm>
#include <cmath>

#include "movis/localization/goal_silhouette.h"
#include "movis/core/angle.h"

namespace movis::calibration {
namespace {

struct Edge {
  Eigen::Vector2d viewpoint_in_robot;
  double azimuth;
  ObjectClass goal;
  bool left;
};

struct Proposal {
  double cost = HUGE_VAL;
  double heading = 0.0;
};

// By the edges' azimuths in the field's axes at a place: cameras stand where the heading puts them.
Proposal best_heading(const std::vector<Edge>& edges, const Eigen::Vector2d& place, const Field& field) {
  constexpr double kWrong = radians(10.0);  // an edge that is off by more is not of this place
  // Twice: with the cameras at the robot's origin, then where they stand by the first heading.
  Proposal best;
  for (int round = 0; round < 2; ++round) {
    const Pose2 world_from_robot{place.x(), place.y(), best.heading};
    std::vector<double> headings;
    for (const Edge& edge : edges) {
      const Eigen::Vector2d viewpoint = round == 0 ? place : world_from_robot * edge.viewpoint_in_robot;
      const localization::Silhouette goal = localization::goal_silhouette(field, edge.goal, viewpoint);
      headings.push_back((edge.left ? goal.left : goal.right) - edge.azimuth);
    }
    best.cost = HUGE_VAL;
    for (const double heading : headings) {
      double cost = 0.0;
      for (const double other : headings) cost += std::min(kWrong, std::abs(turn(heading, other)));
      if (cost < best.cost) best = {cost, wrap_angle(heading)};
    }
  }
  return best;
}

}  // namespace

std::optional<Pose2> search_pose(const omni::Rig& rig, const std::vector<Bearing>& goals, const Field& field) {
  std::vector<Edge> edges;
  for (const Bearing& goal : goals) {
    const Eigen::Vector2d viewpoint = rig.cameras[goal.camera].position.head<2>();
    edges.push_back({viewpoint, goal.left, goal.object, true});
    edges.push_back({viewpoint, goal.right, goal.object, false});
  }
  constexpr std::size_t kFewest = 4;
  if (edges.size() < kFewest) return std::nullopt;
  constexpr int kSteps = 16;  // of the lattice, in each direction
  Proposal best;
  Pose2 pose;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Eigen::Vector2d place(field.half_width * (2.0 * i / kSteps - 1.0),
                                  std::min(field.half_length, field.Fd - 0.05) * (2.0 * j / kSteps - 1.0));
      const Proposal proposal = best_heading(edges, place, field);
      if (proposal.cost >= best.cost) continue;
      best = proposal;
      pose = {place.x(), place.y(), proposal.heading};
    }
  }
  return pose;
}

}  // namespace movis::calibration
