#include "movis/localization/nls.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "landmark_fix.h"
#include "movis/core/angle.h"
#include "nls_solve.h"
#include "nls_start.h"

namespace movis::localization {
namespace {

bool same(const Pose2& a, const Pose2& b) {
  constexpr double kApart = 0.1;  // metres
  return (a.translation() - b.translation()).norm() < kApart && std::abs(turn(a.beta, b.beta)) < radians(10.0);
}

bool sees(const GoalEdges& edges, ObjectClass goal) {
  for (const GoalEdge& edge : edges) {
    if (edge.goal == goal) return true;
  }
  return false;
}

FixStatus too_little(const GoalEdges& edges) {
  const bool yellow = sees(edges, ObjectClass::yellow_goal);
  const bool blue = sees(edges, ObjectClass::blue_goal);
  if (yellow && blue) return FixStatus::no_landmark;
  return yellow || blue ? FixStatus::one_goal : FixStatus::no_goal;
}

// What becomes of the best solution.
Fix fix_of(const Candidate& best, const Problem& problem) {
  const NlsOptions& options = problem.options;
  constexpr int kFewest = 5;  // edges: three numbers and some to contradict
  if (best.agreeing < kFewest) return failed(best.clean > 2 * kFewest ? FixStatus::bad_fit : too_little(problem.edges));
  if (best.scale > options.worst_scale || 2 * best.clean_agreeing < best.clean) return failed(FixStatus::bad_fit);
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = best.world_from_robot;
  fix.covariance = best.covariance;
  const bool finite = fix.world_from_robot.translation().allFinite() && std::isfinite(fix.world_from_robot.beta) &&
                      fix.covariance.allFinite();
  if (!finite) return failed(FixStatus::bad_fit);
  const Eigen::Matrix2d of_place = fix.covariance.topLeftCorner<2, 2>();
  const double half_trace = 0.5 * of_place.trace();
  const double variance = half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - of_place.determinant()));
  if (variance > options.worst_sigma * options.worst_sigma) return failed(too_little(problem.edges));
  if (far_outside(fix.world_from_robot, problem.map.field)) return failed(FixStatus::outside_field);
  return fix;
}

}  // namespace

NlsOptions read_nls_options(const YamlMap& map) {
  map.allow({});
  return {};
}

Fix nls(const Instant& instant, const FieldMap& map, const NlsOptions& options) {
  constexpr double kStartWidth = 0.35;  // radians: 20°
  const GoalEdges edges = goal_edges(instant, options);
  const Problem problem{edges, instant.lines, map, options};
  if (edges.count < 3) return failed(too_little(edges));
  Starts starts;
  offer_by_edges(edges, map.field, starts);
  Candidate best, second;
  best.cost = second.cost = HUGE_VAL;
  for (int i = 0; i < starts.count; ++i) {
    const Candidate candidate = solve_from(starts.pose[i], kStartWidth, problem);
    const double cost = candidate.cost;
    if (cost < best.cost) {
      if (!same(candidate.world_from_robot, best.world_from_robot)) second = best;
      best = candidate;
    } else if (cost < second.cost && !same(candidate.world_from_robot, best.world_from_robot)) {
      second = candidate;
    }
  }
  constexpr double kClear = 6.0;  // of the cost: a likelihood ratio of 400
  const Fix fix = fix_of(best, problem);
  if (fix.status == FixStatus::ok && second.cost < best.cost + kClear) return failed(FixStatus::ambiguous);
  return fix;
}

Fix nls_from(const Pose2& guess, const Instant& instant, const FieldMap& map, const NlsOptions& options) {
  constexpr double kStartWidth = 0.35;
  const GoalEdges edges = goal_edges(instant, options);
  const Problem problem{edges, instant.lines, map, options};
  return fix_of(solve_from(guess, kStartWidth, problem), problem);
}

}  // namespace movis::localization
