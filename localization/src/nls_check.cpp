#include <Eigen/Core>

#include "nls_residuals.h"

namespace movis::localization {

// Do the lines contradict a pose that the edges tell? By the share of points that lie on a line because they are seen
// there, as in line_match.h; a rig whose edges spread puts its points as far off.
bool lines_contradict(const Candidate& candidate, const Problem& problem) {
  constexpr double kLeast = 0.4;    // the share
  constexpr double kFewest = 15.0;  // points, less those that would lie on a line by chance
  const double off = 2.0 * candidate.edge_scale * radians(problem.options.edge_floor_deg);  // radians
  const State state{candidate.world_from_robot, candidate.bias};
  double within = 0.0;
  double by_chance = 0.0;
  int count = 0;
  const std::size_t points = std::min<std::size_t>(problem.lines.size(), kMostLinePoints);
  for (std::size_t i = 0; i < points; ++i) {
    const LinePoint& point = problem.lines[i];
    if (!(point.sigma > 0.0)) continue;
    const double way = point.sigma_on_floor / point.sigma;  // metres a radian
    const double limit = 0.5 * problem.map.field.line + 2.0 * point.sigma_on_floor + off * way;
    const LineMap::Offset offset = problem.map.lines.offset(state.pose * point.point);
    within += std::abs(offset.distance) < limit ? 1.0 : 0.0;
    by_chance += problem.map.lines.share_within(limit);
    ++count;
  }
  const double told = count - by_chance;
  return told > kFewest && within - by_chance < kLeast * told;
}

// Do the clean edges lie about where a pose that the lines tell has them?
bool edges_contradict(const Candidate& candidate, const Problem& problem) {
  constexpr double kAbout = 0.05;  // radians
  const State state{candidate.world_from_robot, candidate.bias};
  int clean = 0;
  int about = 0;
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    if (!edge.clean) return;
    ++clean;
    about += std::abs(residual) < kAbout ? 1 : 0;
  });
  return 2 * about < clean;
}

}  // namespace movis::localization
