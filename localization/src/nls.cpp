#include "movis/localization/nls.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "landmark_fix.h"
#include "movis/core/angle.h"
#include "nls_solve.h"
#include "nls_start.h"

namespace movis::localization {
namespace {

const double kStartWidth = radians(20.0);  // how far off the edges may be where nobody has a guess, or a rough one
const double kPolishWidth = radians(0.2);  // and where the edges alone have told the pose
constexpr double kClear = 6.0;             // by so much cheaper is a pose to be than any other: 400 times as likely
constexpr int kFewestEdges = 5;            // that agree: three numbers, and two to contradict them
const std::vector<LinePoint> kNoLines;

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

FixStatus too_little(const Problem& problem) {
  if (problem.map.field.goals == Field::Goals::white) return FixStatus::no_landmark;
  const bool yellow = sees(problem.edges, ObjectClass::yellow_goal);
  const bool blue = sees(problem.edges, ObjectClass::blue_goal);
  if (yellow && blue) return FixStatus::no_landmark;
  return yellow || blue ? FixStatus::one_goal : FixStatus::no_goal;
}

double largest_variance(const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix2d of_place = covariance.topLeftCorner<2, 2>();
  const double half_trace = 0.5 * of_place.trace();
  return half_trace + std::sqrt(std::max(0.0, half_trace * half_trace - of_place.determinant()));
}

// Do most of a goal's clean edges lie elsewhere?
bool a_goal_disagrees(const Candidate& candidate) {
  for (const int goal : {0, 1}) {
    if (candidate.clean[goal] > 1 && 2 * candidate.clean_agreeing[goal] < candidate.clean[goal]) return true;
  }
  return false;
}

// Without the lines that the field has, as in a light in which neither they nor the goals' colours are what they should
// be, only goals that are seen both, and where nearly all edges agree as well as they should, are believed.
bool edges_suffice(const Candidate& candidate) {
  constexpr double kWorstScale = 3.0;
  constexpr int kFewestOfGoal = 3;
  const auto& [yellow, blue] = candidate.clean_agreeing;
  const int clean = candidate.clean[0] + candidate.clean[1];
  return yellow >= kFewestOfGoal && blue >= kFewestOfGoal && 4 * (yellow + blue) >= 3 * clean &&
         candidate.edge_scale < kWorstScale;
}

// What becomes of the best pose. `by_lines`: the lines alone tell it, but for the half turn.
Fix fix_of(const Candidate& best, const Problem& problem, bool by_lines) {
  const NlsOptions& options = problem.options;
  if (by_lines) {
    if (edges_contradict(best, problem)) return failed(FixStatus::bad_fit);
  } else {
    const bool enough_clean = best.clean[0] + best.clean[1] > 2 * kFewestEdges;
    if (best.agreeing < kFewestEdges) return failed(enough_clean ? FixStatus::bad_fit : too_little(problem));
    if (best.edge_scale > options.worst_scale || a_goal_disagrees(best)) return failed(FixStatus::bad_fit);
    const LineVerdict lines = verdict_of_lines(best, problem);
    if (lines == LineVerdict::against) return failed(FixStatus::bad_fit);
    const bool lines_missed = lines == LineVerdict::silent && !problem.map.lines.empty();
    if (lines_missed && !edges_suffice(best)) return failed(enough_clean ? FixStatus::bad_fit : too_little(problem));
  }
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = best.world_from_robot;
  fix.covariance = best.covariance;
  const bool finite = fix.world_from_robot.translation().allFinite() && std::isfinite(fix.world_from_robot.beta) &&
                      fix.covariance.allFinite();
  if (!finite) return failed(FixStatus::bad_fit);
  if (largest_variance(fix.covariance) > options.worst_sigma * options.worst_sigma) return failed(too_little(problem));
  if (far_outside(fix.world_from_robot, problem.map.field, kBeyond)) return failed(FixStatus::outside_field);
  return fix;
}

Fix ambiguous(const Candidate& one_of_them) {
  Fix fix;
  fix.status = FixStatus::ambiguous;
  fix.world_from_robot = one_of_them.world_from_robot;
  fix.covariance = one_of_them.covariance;
  return fix;
}

Candidate polished(const Candidate& by_edges, const Problem& problem) {
  if (problem.lines.empty()) return by_edges;
  return solve_from(by_edges.world_from_robot, kPolishWidth, problem);
}

// The cheaper of two poses, unless the other is nearly as cheap.
Fix better_of(Candidate best, Candidate second, const Problem& problem, bool by_lines) {
  const double edges = std::min(best.edge_scale, second.edge_scale);
  const double lines = std::min(best.line_scale, second.line_scale);
  double cost = cost_of(best, edges, lines, problem);
  double other_cost = cost_of(second, edges, lines, problem);
  if (other_cost < cost) {
    std::swap(best, second);
    std::swap(cost, other_cost);
  }
  const Fix fix = fix_of(best, problem, by_lines);
  return fix.status == FixStatus::ok && other_cost < cost + kClear ? ambiguous(best) : fix;
}

// The edges alone tell where the robot may be; the lines make it finer.
Fix by_edges(const Problem& problem) {
  const Problem edges_only{problem.edges, kNoLines, problem.map, problem.options};
  Starts starts;
  offer_by_edges(problem.edges, problem.map.field, starts);
  std::array<Candidate, kMostStarts> candidates;
  double scale = HUGE_VAL;
  for (int i = 0; i < starts.count; ++i) {
    candidates[i] = solve_from(starts.pose[i], kStartWidth, edges_only);
    scale = std::min(scale, candidates[i].edge_scale);
  }
  std::array<double, kMostStarts> costs;
  for (int i = 0; i < starts.count; ++i) costs[i] = cost_of(candidates[i], scale, 1.0, edges_only);
  const auto end = costs.begin() + starts.count;
  const auto best = std::min_element(costs.begin(), end) - costs.begin();
  auto second = best;  // cheapest of those that are elsewhere
  for (int i = 0; i < starts.count; ++i) {
    if (same(candidates[i].world_from_robot, candidates[best].world_from_robot)) continue;
    if (second == best || costs[i] < costs[second]) second = i;
  }
  const Candidate fine = polished(candidates[best], problem);
  if (second == best || costs[second] > costs[best] + kClear) return fix_of(fine, problem, false);
  return better_of(fine, polished(candidates[second], problem), problem, false);
}

// The lines alone tell where the robot may be, but for the half turn about the centre spot; what is seen of the goals
// tells that.
Fix by_lines(const Problem& problem) {
  thread_local LineMatchScratch scratch;
  const LineFit found = find_by_lines(problem.lines, problem.map, problem.options.lines, scratch);
  const bool white = problem.map.field.goals == Field::Goals::white;
  if (found.fix.status != FixStatus::ok) return white ? found.fix : failed(too_little(problem));
  if (problem.edges.count == 0) {
    const Candidate candidate = solve_from(found.fix.world_from_robot, kPolishWidth, problem);
    Fix fix = fix_of(candidate, problem, true);
    fix.symmetric = true;
    if (!white && fix.status == FixStatus::ok) fix.status = FixStatus::ambiguous;
    return fix;
  }
  const Pose2& pose = found.fix.world_from_robot;
  const Pose2 turned = half_turned(pose);
  Fix fix =
      better_of(solve_from(pose, kPolishWidth, problem), solve_from(turned, kPolishWidth, problem), problem, true);
  fix.symmetric = fix.status == FixStatus::ambiguous;
  return fix;
}

}  // namespace

Fix nls(const Instant& instant, const FieldMap& map, const NlsOptions& options) {
  const GoalEdges edges = goal_edges(instant, map.field, options);
  const Problem problem{edges, instant.lines, map, options};
  Fix fix = failed(too_little(problem));
  if (edges.count >= kFewestEdges) fix = by_edges(problem);
  if (fix.status == FixStatus::ok || instant.lines.empty()) return fix;
  const Fix with_lines = by_lines(problem);
  return edges.count > 0 && with_lines.status != FixStatus::ok ? fix : with_lines;
}

Fix nls_from(const Pose2& guess, const Instant& instant, const FieldMap& map, const NlsOptions& options) {
  const GoalEdges edges = goal_edges(instant, map.field, options);
  const Problem problem{edges, instant.lines, map, options};
  if (edges.count >= kFewestEdges) {
    const Candidate candidate = solve_from(guess, kStartWidth, {edges, kNoLines, map, options});
    return fix_of(polished(candidate, problem), problem, false);
  }
  thread_local LineMatchScratch scratch;
  LineFit found = match_lines(instant.lines, map, guess, options.lines, scratch);
  if (found.fix.status != FixStatus::ok) found = find_by_lines(instant.lines, map, options.lines, scratch);
  if (found.fix.status != FixStatus::ok) return found.fix;
  const Pose2& pose = found.fix.world_from_robot;
  const Pose2 turned = half_turned(pose);
  const bool same_half = (pose.translation() - guess.translation()).norm() + std::abs(turn(pose.beta, guess.beta)) <
                         (turned.translation() - guess.translation()).norm() + std::abs(turn(turned.beta, guess.beta));
  return fix_of(solve_from(same_half ? pose : turned, kPolishWidth, problem), problem, true);
}

}  // namespace movis::localization
