#include "line_descent.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "movis/core/median.h"

namespace movis::localization {
namespace {

constexpr double kWide = 0.25;          // s of the first descent, metres (Lauer et al.)
constexpr double kNoiseScale = 3.0;     // c in units of f σ
constexpr double kLargestSpread = 3.0;  // f in the error; a larger one would let any line attract any point

// E[ψ²]/E[ψ']² of a normal variable for ψ(u) = u (9/(9 + u²))², by numerical integration: 0.42278/0.61969².
constexpr double kInefficiency = 1.1009;

// Of the information about the pose, the part that its least known direction must have. One line, or one circle, leaves
// a direction free; 1/50 are then only the points that lie elsewhere by mistake.
constexpr double kLeastInformation = 0.02;

struct Normal {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  double error = 0.0;
};

struct Turned {
  double cosine, sine;
  explicit Turned(double beta) : cosine(std::cos(beta)), sine(std::sin(beta)) {}
  Eigen::Vector2d operator()(const LineSample& point) const {
    return {cosine * point.x - sine * point.y, sine * point.x + cosine * point.y};
  }
};

Eigen::Vector3d row(const Eigen::Vector2d& normal, const Eigen::Vector2d& arm) {
  return {normal.x(), normal.y(), normal.y() * arm.x() - normal.x() * arm.y()};
}

// E, half its gradient and its Gauss–Newton matrix.
Normal normal_equations(const std::vector<LineSample>& points, const LineMap& map, const Pose2& pose, double s,
                        double f) {
  Normal sum;
  const Turned turned(pose.beta);
  const double noise = kNoiseScale * f * kNoiseScale * f;
  double xx = 0.0, xy = 0.0, yy = 0.0, xb = 0.0, yb = 0.0, bb = 0.0;
  for (const LineSample& point : points) {
    const Eigen::Vector2d arm = turned(point);
    const LineMap::Offset offset = map.offset(pose.translation() + arm);
    const Eigen::Vector3d j = row(offset.normal, arm);
    const double variance = point.sigma * point.sigma;
    const double scale = s * s + noise * variance;  // c²
    const double squared = offset.distance * offset.distance;
    const double near = scale / (scale + squared);
    const double weight = near * near / variance;
    sum.error += near * squared / variance;
    sum.gradient += weight * offset.distance * j;
    xx += weight * j.x() * j.x();
    xy += weight * j.x() * j.y();
    yy += weight * j.y() * j.y();
    xb += weight * j.x() * j.z();
    yb += weight * j.y() * j.z();
    bb += weight * j.z() * j.z();
  }
  sum.information << xx, xy, xb, xy, yy, yb, xb, yb, bb;
  return sum;
}

}  // namespace

Pose2 descend(const std::vector<LineSample>& points, const LineMap& map, const Pose2& start, double s, double f) {
  constexpr int kMostSteps = 20;
  constexpr double kSmallStep = 1e-5;  // metres, radians
  Pose2 pose = start;
  Normal at = normal_equations(points, map, pose, s, f);
  double damping = 1e-4;
  for (int i = 0; i < kMostSteps; ++i) {
    Eigen::Matrix3d damped = at.information;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-9 * (at.information.trace() + 1.0);
    const Eigen::Vector3d step = damped.ldlt().solve(-at.gradient);
    if (!step.allFinite()) break;
    const Pose2 next{pose.x + step.x(), pose.y + step.y(), wrap_angle(pose.beta + step.z())};
    const Normal there = normal_equations(points, map, next, s, f);
    if (there.error <= at.error) {
      pose = next;
      at = there;
      damping *= 0.1;
    } else {
      damping *= 10.0;
    }
    if (step.cwiseAbs().maxCoeff() < kSmallStep) break;
  }
  return pose;
}

double excess_spread(const std::vector<LineSample>& points, const LineMap& map, const Pose2& pose,
                     std::vector<double>& sizes) {
  const Turned turned(pose.beta);
  sizes.clear();
  for (const LineSample& point : points)
    sizes.push_back(std::abs(map.offset(pose.translation() + turned(point)).distance) / point.sigma);
  return std::max(1.0, kNormalMedian * median_in_place(sizes));
}

Pose2 settle(const std::vector<LineSample>& points, const LineMap& map, const Pose2& start,
             std::vector<double>& sizes) {
  Pose2 pose = descend(points, map, start, kWide, 1.0);
  for (int round = 0; round < 2; ++round)
    pose = descend(points, map, pose, 0.0, std::min(kLargestSpread, excess_spread(points, map, pose, sizes)));
  return pose;
}

bool line_covariance(const std::vector<LineSample>& points, const LineMap& map, const Pose2& pose, double f,
                     Eigen::Matrix3d& covariance) {
  const Turned turned(pose.beta);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  double weights = 0.0, arms = 0.0;
  for (const LineSample& point : points) {
    const Eigen::Vector2d arm = turned(point);
    const LineMap::Offset offset = map.offset(pose.translation() + arm);
    if (std::abs(offset.distance) > kNoiseScale * f * point.sigma) continue;
    const double weight = 1.0 / (point.sigma * point.sigma);
    const Eigen::Vector3d j = row(offset.normal, arm);
    information += weight * j * j.transpose();
    weights += weight;
    arms += weight * arm.squaredNorm();
  }
  if (!(weights > 0.0) || !(arms > 0.0)) return false;
  // With the turn measured by the arc at the points' own distance all three directions compare.
  const Eigen::Vector3d unit(1.0, 1.0, std::sqrt(weights / arms));
  const Eigen::Matrix3d compared = unit.asDiagonal() * information * unit.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(compared, Eigen::EigenvaluesOnly);
  if (!(solver.eigenvalues()[0] > kLeastInformation * weights)) return false;
  covariance = kInefficiency * f * f * information.inverse();
  return true;
}

}  // namespace movis::localization
