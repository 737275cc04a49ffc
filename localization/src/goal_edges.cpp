#include "goal_edges.h"

#include <cmath>

#include "movis/core/angle.h"

namespace movis::localization {
namespace {

// Wider than this a goal is seen only from between its posts or from inside: there is no silhouette.
const double kWidest = radians(150.0);

bool usable(const Bearing& bearing) {
  const bool goal = bearing.object == ObjectClass::yellow_goal || bearing.object == ObjectClass::blue_goal;
  return goal && std::isfinite(bearing.left + bearing.right) && bearing.left_variance > 0.0 &&
         bearing.right_variance > 0.0 && std::isfinite(bearing.left_variance + bearing.right_variance) &&
         std::abs(turn(bearing.right, bearing.left)) < kWidest;
}

}  // namespace

GoalEdges goal_edges(const Instant& instant, const NlsOptions& options) {
  const double floor = radians(options.edge_floor_deg);
  // A bearing's flag speaks of both edges; that one of them is hidden shows in its sigma, too.
  const double hidden = radians(1.0);
  GoalEdges edges;
  if (instant.rig.cameras.empty()) return edges;
  int sight = 0;
  for (const Bearing& bearing : instant.bearings) {
    if (!usable(bearing) || edges.count + 2 > kMostEdges) continue;
    const Eigen::Vector2d viewpoint = instant.rig.cameras.at(bearing.camera).position.head<2>();
    for (const bool is_left : {true, false}) {
      const double variance = is_left ? bearing.left_variance : bearing.right_variance;
      edges.edge[edges.count++] = {bearing.object,
                                   sight,
                                   is_left,
                                   bearing.clean() && variance < hidden * hidden,
                                   viewpoint,
                                   is_left ? bearing.left : bearing.right,
                                   std::sqrt(variance + floor * floor)};
    }
    ++sight;
  }
  return edges;
}

}  // namespace movis::localization
