#include "nls_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "movis/core/median.h"
#include "nls_residuals.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

// How wide the loss is, in multiples of the sigmas; and of lines at most, metres: half the way to the next one.
struct Width {
  double sigmas = 4.0;
  double line = 0.0;
};

// By how much the residuals spread more than their sigmas tell.
struct Scales {
  double edges = 1.0;
  double lines = 1.0;
};

struct Normal {
  Matrix5 hessian = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double cost = 0.0;
};

// Geman–McClure of squared u and width: its weight is that of iteratively reweighted least squares, ρ'(u)/u.
struct Loss {
  double squared_width;
  double cost(double squared) const { return 0.5 * squared * squared_width / (squared_width + squared); }
  double weight(double squared) const {
    const double share = squared_width / (squared_width + squared);
    return share * share;
  }
};

double line_share(const Problem& problem) {
  const auto count = static_cast<double>(std::min<std::size_t>(problem.lines.size(), kMostLinePoints));
  return count > 0.0 ? std::min(1.0, problem.options.line_points / count) : 0.0;
}

Normal linearize(const Problem& problem, const State& state, const Width& width, const Scales& scales) {
  Normal normal;
  const Loss loss{width.sigmas * width.sigmas};
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5& by_unknowns) {
    const double information = 1.0 / (edge.sigma * edge.sigma * scales.edges * scales.edges);
    const double squared = residual * residual * information;
    const double weight = loss.weight(squared) * information;
    normal.hessian.noalias() += weight * by_unknowns * by_unknowns.transpose();
    normal.gradient.noalias() += weight * residual * by_unknowns;
    normal.cost += loss.cost(squared);
  });
  const double bias = radians(problem.options.edge_bias_deg) * scales.edges;
  const double prior = 1.0 / (bias * bias);
  for (int goal = 0; goal < 2; ++goal) {
    normal.hessian(3 + goal, 3 + goal) += prior;
    normal.gradient[3 + goal] += prior * state.bias[goal];
    normal.cost += 0.5 * prior * state.bias[goal] * state.bias[goal];
  }
  const double share = line_share(problem);
  Eigen::Matrix3d by_lines = Eigen::Matrix3d::Zero();
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for_each_line_point(problem, state, [&](double sigma, double distance, const Eigen::Vector3d& by_pose) {
    const double information = 1.0 / (sigma * sigma * scales.lines * scales.lines);
    const double sigmas = std::min(width.sigmas, width.line / (sigma * scales.lines));
    const Loss line_loss{sigmas * sigmas};
    const double squared = distance * distance * information;
    const double weight = share * line_loss.weight(squared) * information;
    by_lines.noalias() += weight * by_pose * by_pose.transpose();
    down.noalias() += weight * distance * by_pose;
    normal.cost += share * line_loss.cost(squared);
  });
  normal.hessian.topLeftCorner<3, 3>() += by_lines;
  normal.gradient.head<3>() += down;
  return normal;
}

// A Gauss–Newton step, not longer than a start is off.
double step(State& state, const Normal& normal) {
  constexpr double kLongest = 0.5;  // metres
  constexpr double kWidest = 0.5;   // radians
  Matrix5 damped = normal.hessian;
  damped.diagonal() *= 1.0 + 1e-9;
  damped.diagonal().head<3>().array() += 1e-3;
  Vector5 change = -damped.ldlt().solve(normal.gradient);
  if (!change.allFinite()) return 0.0;
  const double excess = std::max(change.head<2>().norm() / kLongest, std::abs(change[2]) / kWidest);
  if (excess > 1.0) change /= excess;
  state.pose.x += change[0];
  state.pose.y += change[1];
  state.pose.beta = wrap_angle(state.pose.beta + change[2]);
  state.bias += change.tail<2>();
  return change.head<2>().norm() + std::abs(change[2]);
}

constexpr int kUnknowns = 3;
constexpr double kChance = 1.5;  // a dozen edges spread as much more by chance

// The scale of the first `count` sizes: the median that a normal distribution of sigma 1 would have, less what the pose
// took of it.
double scale_of(double* sizes, int count) {
  if (count <= kUnknowns) return 1.0;
  std::nth_element(sizes, sizes + count / 2, sizes + count);
  const double freedom = static_cast<double>(count) / (count - kUnknowns);
  const double scale = kNormalMedian * sizes[count / 2] * std::sqrt(freedom);
  return scale > kChance ? scale : 1.0;
}

bool all_count(const GoalEdges& edges) {
  int clean = 0;
  for (const GoalEdge& edge : edges) clean += edge.clean ? 1 : 0;
  return clean <= kUnknowns + 2;
}

// Do six in ten of the edges lie within `sigmas` of where they are to be, and half of each goal's? Of the clean ones where
// those are enough. The edges of one goal alone fit many poses, so each goal has a say of its own.
bool most_agree(const Problem& problem, const State& state, double sigmas) {
  const bool all = all_count(problem.edges);
  std::array<int, 2> count{};
  std::array<int, 2> within{};
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    if (!edge.clean && !all) return;
    ++count[edge.bias()];
    within[edge.bias()] += std::abs(residual) < sigmas * edge.sigma ? 1 : 0;
  });
  for (const int goal : {0, 1}) {
    if (count[goal] > 1 && 2 * within[goal] < count[goal]) return false;
  }
  return 10 * (within[0] + within[1]) >= 6 * (count[0] + count[1]);
}

// Of the edges within `sigmas`, and of all line points.
Scales robust_scales(const Problem& problem, const State& state, double sigmas) {
  std::array<double, std::max(kMostEdges, kMostLinePoints)> sizes;
  const bool all = all_count(problem.edges);
  int count = 0;
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    const double size = std::abs(residual) / edge.sigma;
    if ((edge.clean || all) && size < sigmas) sizes[count++] = size;
  });
  Scales scales;
  scales.edges = scale_of(sizes.data(), count);
  count = 0;
  for_each_line_point(problem, state, [&](double sigma, double distance, const Eigen::Vector3d&) {
    sizes[count++] = std::abs(distance) / sigma;
  });
  scales.lines = scale_of(sizes.data(), count);
  return scales;
}

constexpr double kStartLine = 0.3;  // metres
constexpr double kFinalLine = 0.06;

}  // namespace

Candidate solve_from(const Pose2& guess, double start_width, const Problem& problem) {
  constexpr double kSigma = 2.3e-4;   // of an edge, about; radians
  constexpr double kWideStep = 0.05;  // radians: above it one step a width will do
  constexpr int kMostSteps = 12;
  constexpr double kSettled = 1e-7;
  const double final_width = problem.options.loss_width;
  State state{guess, Vector2d::Zero()};
  State agreed = state;
  double agreed_width = HUGE_VAL;
  for (double width = start_width / kSigma;; width = std::max(final_width, 0.5 * width)) {
    const double line = std::clamp(width * kSigma, kFinalLine, kStartLine);
    const int steps = width * kSigma > kWideStep ? 1 : 3;
    for (int i = 0; i < steps; ++i) {
      if (step(state, linearize(problem, state, {width, line}, {})) < kSettled) break;
    }
    // The narrowest width at which most edges still agree.
    if (agreed_width == HUGE_VAL || most_agree(problem, state, width)) {
      agreed = state;
      agreed_width = width;
    }
    if (width <= final_width) break;
  }
  state = agreed;
  const Width width{final_width, kFinalLine};
  const Scales scales = robust_scales(problem, state, agreed_width);
  for (int i = 0; i < kMostSteps; ++i) {
    if (step(state, linearize(problem, state, width, scales)) < kSettled) break;
  }
  Candidate candidate;
  candidate.world_from_robot = state.pose;
  candidate.bias = state.bias;
  candidate.edge_scale = scales.edges;
  candidate.line_scale = scales.lines;
  candidate.covariance = linearize(problem, state, width, scales).hessian.inverse().topLeftCorner<3, 3>();
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    const bool agrees = std::abs(residual) < final_width * scales.edges * edge.sigma;
    candidate.agreeing += agrees ? 1 : 0;
    candidate.clean[edge.bias()] += edge.clean ? 1 : 0;
    candidate.clean_agreeing[edge.bias()] += agrees && edge.clean ? 1 : 0;
  });
  return candidate;
}

double cost_of(const Candidate& candidate, double edge_scale, double line_scale, const Problem& problem) {
  const State state{candidate.world_from_robot, candidate.bias};
  return linearize(problem, state, {problem.options.loss_width, kFinalLine}, {edge_scale, line_scale}).cost;
}

}  // namespace movis::localization
