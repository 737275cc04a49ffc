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

GoalEdges goal_edges(const Instant& instant, const Field& field, const NlsOptions& options) {
  const double floor = radians(options.edge_floor_deg);
  GoalEdges edges;
  if (field.goals == Field::Goals::white) return edges;
  const int cameras = static_cast<int>(instant.rig.cameras.size());
  int sight = 0;
  for (const Bearing& bearing : instant.bearings) {
    if (bearing.camera < 0 || bearing.camera >= cameras || !usable(bearing) || edges.count + 2 > kMostEdges) continue;
    const Eigen::Vector2d viewpoint = instant.rig.cameras[bearing.camera].position.head<2>();
    for (const bool is_left : {true, false}) {
      const double variance = is_left ? bearing.left_variance : bearing.right_variance;
      edges.edge[edges.count++] = {bearing.object,
                                   sight,
                                   is_left,
                                   (is_left ? bearing.left_flags : bearing.right_flags) == 0,
                                   viewpoint,
                                   is_left ? bearing.left : bearing.right,
                                   std::sqrt(variance + floor * floor)};
    }
    ++sight;
  }
  return edges;
}

}  // namespace movis::localization
