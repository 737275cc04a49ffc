#include "nls_solve.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/localization/goal_silhouette.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

// How wide the loss is: for edges in multiples of their sigma, and of lines never more than to half the way to the next.
struct Width {
  double sigmas = 4.0;
  double line = 0.0;  // at most, metres
};

struct Normal {
  Matrix5 hessian = Matrix5::Zero();
  Vector5 gradient = Vector5::Zero();
  double cost = 0.0;
};

struct State {
  Pose2 pose;
  Vector2d bias = Vector2d::Zero();
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

// Calls visit(edge, residual, its derivative by the unknowns).
template <typename Visit>
void for_each_edge(const Problem& problem, const State& state, Visit visit) {
  const double c = std::cos(state.pose.beta);
  const double s = std::sin(state.pose.beta);
  Silhouette silhouette;
  Vector2d viewpoint, arm;
  int sight = -1;
  for (const GoalEdge& edge : problem.edges) {
    if (edge.sight != sight) {
      sight = edge.sight;
      const Vector2d& in_robot = edge.viewpoint_in_robot;
      arm = {c * in_robot.x() - s * in_robot.y(), s * in_robot.x() + c * in_robot.y()};
      viewpoint = state.pose.translation() + arm;
      silhouette = goal_silhouette(problem.map.field, edge.goal, viewpoint);
    }
    const double azimuth = edge.is_left ? silhouette.left : silhouette.right;
    const Vector2d to_corner = (edge.is_left ? silhouette.left_corner : silhouette.right_corner) - viewpoint;
    const double squared = std::max(1e-4, to_corner.squaredNorm());
    // The azimuth's derivative by the viewpoint is (y, −x)/ρ², and the viewpoint's by β is (−arm_y, arm_x).
    const Vector2d by_viewpoint(to_corner.y() / squared, -to_corner.x() / squared);
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
  for (const LinePoint& point : problem.lines) {
    const Vector2d arm(c * point.point.x() - s * point.point.y(), s * point.point.x() + c * point.point.y());
    const LineMap::Offset offset = problem.map.lines.offset(state.pose.translation() + arm);
    const Vector2d& n = offset.normal;
    const double sigma = std::sqrt(point.sigma_on_floor * point.sigma_on_floor + floor * floor);
    visit(sigma, offset.distance, Eigen::Vector3d(n.x(), n.y(), n.y() * arm.x() - n.x() * arm.y()));
  }
}

double line_share(const Problem& problem) {
  const auto count = static_cast<double>(problem.lines.size());
  return count > 0.0 ? std::min(1.0, problem.options.line_points / count) : 0.0;
}

Normal linearize(const Problem& problem, const State& state, const Width& width) {
  Normal normal;
  const Loss loss{width.sigmas * width.sigmas};
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5& by_unknowns) {
    const double information = 1.0 / (edge.sigma * edge.sigma);
    const double squared = residual * residual * information;
    const double weight = loss.weight(squared) * information;
    normal.hessian.noalias() += weight * by_unknowns * by_unknowns.transpose();
    normal.gradient.noalias() += weight * residual * by_unknowns;
    normal.cost += loss.cost(squared);
  });
  const double bias = radians(problem.options.edge_bias_deg);
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
    const double information = 1.0 / (sigma * sigma);
    const double sigmas = std::min(width.sigmas, width.line / sigma);
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

// The residuals' scale over their sigma: 1.4826 times the median of their size, less what the pose took of it. Of the
// clean edges where there are enough, else of all.
double robust_scale(const Problem& problem, const State& state) {
  constexpr int kUnknowns = 3;
  constexpr double kMedianOfNormal = 1.4826;
  std::array<double, kMostEdges> sizes;
  int clean = 0;
  for (const GoalEdge& edge : problem.edges) clean += edge.clean ? 1 : 0;
  const bool only_clean = clean > kUnknowns + 2;
  int count = 0;
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    if (edge.clean || !only_clean) sizes[count++] = std::abs(residual) / edge.sigma;
  });
  if (count <= kUnknowns) return 1.0;
  std::nth_element(sizes.begin(), sizes.begin() + count / 2, sizes.begin() + count);
  return std::max(1.0,
                  kMedianOfNormal * sizes[count / 2] * std::sqrt(count / (count - static_cast<double>(kUnknowns))));
}

void judge(const Problem& problem, const State& state, const Width& width, Candidate& candidate) {
  for_each_edge(problem, state, [&](const GoalEdge& edge, double residual, const Vector5&) {
    const bool agrees = std::abs(residual) < width.sigmas * edge.sigma;
    candidate.agreeing += agrees ? 1 : 0;
    candidate.clean += edge.clean ? 1 : 0;
    candidate.clean_agreeing += agrees && edge.clean ? 1 : 0;
  });
  int agreeing = 0;
  for_each_line_point(problem, state, [&](double sigma, double distance, const Eigen::Vector3d&) {
    agreeing += std::abs(distance) < std::min(width.sigmas * sigma, width.line) ? 1 : 0;
  });
  if (!problem.lines.empty()) candidate.lines_agreeing = agreeing / static_cast<double>(problem.lines.size());
}

}  // namespace

Candidate solve_from(const Pose2& guess, double start_width, const Problem& problem) {
  constexpr double kStartLine = 0.3;  // metres
  constexpr double kFinalLine = 0.06;
  constexpr double kSigma = 2.3e-4;  // of an edge, about; radians
  constexpr int kMostSteps = 12;
  constexpr double kSettled = 1e-7;
  const double final_width = problem.options.loss_width;
  State state{guess, Vector2d::Zero()};
  for (double width = start_width / kSigma; width > 4.0 * final_width; width *= 0.5) {
    step(state, linearize(problem, state, {width, std::clamp(width * kSigma, kFinalLine, kStartLine)}));
  }
  Candidate candidate;
  for (int round = 0; round < 2; ++round) {
    candidate.scale = robust_scale(problem, state);
    for (int i = 0; i < kMostSteps; ++i) {
      if (step(state, linearize(problem, state, {final_width * candidate.scale, kFinalLine})) < kSettled) break;
    }
  }
  const Width width{final_width * candidate.scale, kFinalLine};
  const Normal normal = linearize(problem, state, width);
  candidate.world_from_robot = state.pose;
  candidate.bias = state.bias;
  candidate.cost = normal.cost / (candidate.scale * candidate.scale);
  const Matrix5 covariance = normal.hessian.inverse() * (candidate.scale * candidate.scale);
  candidate.covariance = covariance.topLeftCorner<3, 3>();
  judge(problem, state, width, candidate);
  return candidate;
}

}  // namespace movis::localization
