#include <Eigen/Core>

#include "nls_residuals.h"

namespace movis::localization {

// What the lines say of a pose that the edges tell: by the share of points that lie on a line because they are seen
// there, as in line_match.h; a rig whose edges spread puts its points as far off.
LineVerdict verdict_of_lines(const Candidate& candidate, const Problem& problem) {
  constexpr double kLeast = 0.4;         // the share
  constexpr double kFewest = 15.0;       // points, less those that would lie on a line by chance
  const double most_off = radians(0.5);  // of a rig that is not as its file says; more would let anything pass
  const double off = std::min(most_off, 2.0 * candidate.edge_scale * radians(problem.options.edge_floor_deg));
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
  if (told <= kFewest) return LineVerdict::silent;
  return within - by_chance < kLeast * told ? LineVerdict::against : LineVerdict::in_favour;
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
