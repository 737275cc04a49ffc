#pragma once

#include <Eigen/Core>
#include <array>

#include "movis/localization/instant.h"
#include "movis/localization/nls.h"

// What nls sees of the goals; nothing where they are white.
namespace movis::localization {

inline constexpr int kMostEdges = 64;

struct GoalEdge {
  ObjectClass goal = ObjectClass::yellow_goal;
  int sight = 0;  // edges of one goal in one camera share it
  bool is_left = false;
  bool clean = false;  // the scan saw nothing before it
  Eigen::Vector2d viewpoint_in_robot = Eigen::Vector2d::Zero();
  double azimuth = 0.0;  // measured, robot's axes
  double sigma = 0.0;    // radians

  int bias() const { return goal == ObjectClass::yellow_goal ? 0 : 1; }
  double outwards() const { return is_left ? 1.0 : -1.0; }
};

struct GoalEdges {
  std::array<GoalEdge, kMostEdges> edge;
  int count = 0;

  const GoalEdge* begin() const { return edge.data(); }
  const GoalEdge* end() const { return edge.data() + count; }
};

GoalEdges goal_edges(const Instant& instant, const Field& field, const NlsOptions& options);

}  // namespace movis::localization
