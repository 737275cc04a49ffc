#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/chi2.h"
#include "sights.h"

// A goal's edges are upright, so only azimuths count: its landmarks are points of the floor plane.
namespace movis::triangulation {
namespace {

using Eigen::Matrix2d;
using Eigen::RowVector2d;
using Eigen::Vector2d;

// Of fixed memory.
using Azimuths = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostCameras, 1>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMostCameras, 2>;
using Gain = Eigen::Matrix<double, 2, Eigen::Dynamic, 0, 2, kMostCameras>;

struct GoalSight {
  const Bearing* bearing = nullptr;
  Vector2d position;
  double left_variance = 0.0, right_variance = 0.0;
};

struct GoalSights {
  std::array<GoalSight, kMostCameras> sight;
  int count = 0;
};

GoalSights goal_sights(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                       const JointOptions& options) {
  constexpr double kLeastVariance = 1e-16;  // rad²
  GoalSights sights;
  for (const Bearing& bearing : bearings) {
    if (bearing.object != goal) continue;
    const Vector2d position = camera_of(rig, bearing).position.head<2>();
    const auto end = sights.sight.begin() + sights.count;
    const bool again = std::any_of(sights.sight.begin(), end,
                                   [&](const GoalSight& sight) { return sight.bearing->camera == bearing.camera; });
    if (again) continue;
    const double factor = bearing.clean() ? 1.0 : options.flagged_factor;
    sights.sight[sights.count++] = {&bearing, position,
                                    std::max(factor * factor * bearing.left_variance, kLeastVariance),
                                    std::max(factor * factor * bearing.right_variance, kLeastVariance)};
  }
  return sights;
}

// A landmark is seen at `left` times the left edge's azimuth plus `right` times the right one's.
struct Landmark {
  double Bearing::*azimuth;
  double left, right;
  int row;  // of GoalPoints::covariance
};

constexpr Landmark kLandmarks[] = {
    {&Bearing::azimuth, 0.5, 0.5, 0}, {&Bearing::left, 1.0, 0.0, 2}, {&Bearing::right, 0.0, 1.0, 4}};

// One landmark by the cameras whose bit is set. `gain` tells how the point moves with the azimuths; it is zero for the
// cameras that are left out.
struct GoalPoint {
  PointStatus status = PointStatus::not_seen;
  unsigned cameras = 0;
  Vector2d point = Vector2d::Zero();
  Gain gain;
  double chi2 = 0.0;
  int dof = 0;
  double largest_residual = 0.0;  // radians
  double scale = 1.0;             // of the covariance: Birge's ratio
};

class PlanarFit {
 public:
  PlanarFit(const GoalSights& sights, const Landmark& landmark, unsigned cameras, const JointOptions& options);

  GoalPoint solve();

 private:
  bool start();         // the point nearest to all rays
  bool linearize();     // false: it lies behind a camera
  bool ranged() const;  // is its distance known?
  GoalPoint result(PointStatus status) const;

  std::array<int, kMostCameras> place_{};  // of each row's sight
  std::array<Vector2d, kMostCameras> position_, ray_;
  int count_ = 0, all_ = 0;
  unsigned cameras_;
  Vector2d centre_ = Vector2d::Zero();  // of the cameras
  Azimuths weight_;                     // 1/variance of each azimuth, without the shared bias
  double bias_variance_ = 0.0;
  Vector2d point_ = Vector2d::Zero();
  Rows by_point_;
  Azimuths residual_;
  Matrix2d covariance_ = Matrix2d::Zero();
};

PlanarFit::PlanarFit(const GoalSights& sights, const Landmark& landmark, unsigned cameras, const JointOptions& options)
    : all_(sights.count), cameras_(cameras) {
  weight_.resize(kMostCameras);
  for (int i = 0; i < sights.count; ++i) {
    if ((cameras >> i & 1U) == 0) continue;
    const GoalSight& sight = sights.sight[i];
    const double azimuth = sight.bearing->*landmark.azimuth;
    const double variance =
        landmark.left * landmark.left * sight.left_variance + landmark.right * landmark.right * sight.right_variance;
    place_[count_] = i;
    position_[count_] = sight.position;
    ray_[count_] = Vector2d(std::cos(azimuth), std::sin(azimuth));
    weight_(count_) = 1.0 / variance;
    centre_ += sight.position;
    ++count_;
  }
  centre_ /= std::max(count_, 1);
  weight_.conservativeResize(count_);
  const double bias = radians(options.edge_bias_deg);
  bias_variance_ = (landmark.left * landmark.left + landmark.right * landmark.right) * bias * bias;
  by_point_.resize(count_, 2);
  residual_.resize(count_);
}

bool PlanarFit::start() {
  for (int i = 0; i < count_; ++i) {
    by_point_.row(i) = RowVector2d(-ray_[i].y(), ray_[i].x());
    residual_(i) = by_point_.row(i) * position_[i];
  }
  const Rows weighted = weight_.asDiagonal() * by_point_;
  const Matrix2d normal = by_point_.transpose() * weighted;
  if (!(normal.determinant() > 0.0)) return false;
  point_ = normal.inverse() * (weighted.transpose() * residual_);
  return point_.allFinite();
}

bool PlanarFit::linearize() {
  for (int i = 0; i < count_; ++i) {
    const Vector2d o = point_ - position_[i];
    const double ahead = ray_[i].dot(o);
    if (!(ahead > 0.0)) return false;
    residual_(i) = (ray_[i].y() * o.x() - ray_[i].x() * o.y()) / ahead;
    by_point_.row(i) = RowVector2d(-o.y(), o.x()) / o.squaredNorm();
  }
  return true;
}

bool PlanarFit::ranged() const {
  constexpr double kLeastParallax = 3.0;  // sigmas
  const Vector2d sight = point_ - centre_;
  const double range2 = sight.squaredNorm();
  return kLeastParallax * kLeastParallax * sight.dot(covariance_ * sight) <= range2 * range2;
}

GoalPoint PlanarFit::result(PointStatus status) const {
  GoalPoint result;
  result.status = status;
  result.cameras = cameras_;
  result.gain.setZero(2, all_);
  if (status != PointStatus::ok) return result;
  result.point = point_;
  result.dof = count_ - 2;
  // Of residuals that share the bias: (D + b 1 1ᵀ)⁻¹ after Sherman and Morrison.
  const double mean = weight_.dot(residual_);
  result.chi2 =
      residual_.cwiseAbs2().dot(weight_) - bias_variance_ * mean * mean / (1.0 + bias_variance_ * weight_.sum());
  result.largest_residual = residual_.cwiseAbs().maxCoeff();
  for (int i = 0; i < count_; ++i) {
    result.gain.col(place_[i]) = weight_(i) * covariance_ * by_point_.row(i).transpose();
  }
  return result;
}

GoalPoint PlanarFit::solve() {
  constexpr int kMostSteps = 15;
  constexpr double kSmallStep = 1e-8;  // squared, in sigmas
  if (count_ < 2) return result(count_ == 0 ? PointStatus::not_seen : PointStatus::one_camera);
  if (!start()) return result(PointStatus::parallel_rays);
  for (int steps = 0; steps < kMostSteps; ++steps) {
    if (!linearize()) return result(PointStatus::behind_camera);
    const Rows weighted = weight_.asDiagonal() * by_point_;
    const Matrix2d information = by_point_.transpose() * weighted;
    if (!(information.determinant() > 0.0)) break;
    covariance_ = information.inverse();
    const Vector2d step = covariance_ * (weighted.transpose() * residual_);
    const double longest = 0.5 * (point_ - centre_).norm();  // as for a ball
    point_ += step.norm() > longest ? Vector2d(longest / step.norm() * step) : step;
    if (!point_.allFinite()) break;
    if (step.dot(information * step) < kSmallStep) {
      return result(ranged() ? PointStatus::ok : PointStatus::parallel_rays);
    }
  }
  return result(PointStatus::parallel_rays);
}

bool agrees(const GoalPoint& point, const JointOptions& options) {
  return point.status == PointStatus::ok &&
         (point.dof == 0 || point.chi2 <= chi2_limit(point.dof, options.test_sigmas));
}

// By all cameras, or, where they contradict each other and it can be told which is wrong, without those.
GoalPoint locate(const GoalSights& sights, const Landmark& landmark, const JointOptions& options) {
  const auto by = [&](unsigned cameras) { return PlanarFit(sights, landmark, cameras, options).solve(); };
  const GoalPoint all = by((1U << sights.count) - 1U);
  GoalPoint point = all;
  // Two cameras always agree.
  for (int used = sights.count; used > 3 && !agrees(point, options); --used) {
    GoalPoint best;
    for (int i = 0; i < sights.count; ++i) {
      if ((point.cameras >> i & 1U) == 0) continue;
      const GoalPoint without = by(point.cameras & ~(1U << i));
      const bool better =
          without.status == PointStatus::ok && (best.status != PointStatus::ok || without.chi2 < best.chi2);
      if (better || best.cameras == 0) best = without;
    }
    point = best;
  }
  if (agrees(point, options)) return point;
  if (all.status != PointStatus::ok) return all;
  point = all;
  point.scale = std::max(1.0, all.chi2 / std::max(all.dof, 1));
  if (all.largest_residual > radians(options.contradiction_deg)) point.status = PointStatus::contradiction;
  return point;
}

// Covariance of two landmarks, through the edges' azimuths that they share.
Matrix2d cross_covariance(const GoalSights& sights, const Landmark& one, const GoalPoint& point1, const Landmark& two,
                          const GoalPoint& point2, double bias_variance) {
  const double left = one.left * two.left;
  const double right = one.right * two.right;
  Matrix2d covariance =
      (left + right) * bias_variance * point1.gain.rowwise().sum() * point2.gain.rowwise().sum().transpose();
  for (int i = 0; i < sights.count; ++i) {
    const double variance = left * sights.sight[i].left_variance + right * sights.sight[i].right_variance;
    covariance += variance * point1.gain.col(i) * point2.gain.col(i).transpose();
  }
  return std::sqrt(point1.scale * point2.scale) * covariance;
}

}  // namespace

GoalPoints triangulate_goal_joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                                  const JointOptions& options) {
  require_joint_rig(rig);
  const GoalSights sights = goal_sights(rig, bearings, goal, options);
  GoalPoint found[3];
  for (int i = 0; i < 3; ++i) found[i] = locate(sights, kLandmarks[i], options);

  GoalPoints points;
  points.centre_status = found[0].status;
  points.edges_status = found[1].status != PointStatus::ok ? found[1].status : found[2].status;
  points.centre = found[0].point;
  points.left = found[1].point;
  points.right = found[2].point;
  const bool solved[] = {points.centre_status == PointStatus::ok, points.edges_status == PointStatus::ok,
                         points.edges_status == PointStatus::ok};
  const double bias = radians(options.edge_bias_deg);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!solved[i] || !solved[j]) continue;
      points.covariance.block<2, 2>(kLandmarks[i].row, kLandmarks[j].row) =
          cross_covariance(sights, kLandmarks[i], found[i], kLandmarks[j], found[j], bias * bias);
    }
  }
  return points;
}

}  // namespace movis::triangulation
