#include "movis/triangulation/cramer_rao.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "information.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of (azimuth, elevation, angular radius); without a radius its row and column are zero. A singular one has no inverse.
Matrix3d information_of(const Bearing& bearing) {
  const bool has_radius = bearing.radius_variance > 0.0;
  Matrix3d covariance = Matrix3d::Identity();
  covariance.topLeftCorner<2, 2>() = bearing.covariance;
  if (has_radius) {
    covariance(2, 2) = bearing.radius_variance;
    covariance.block<2, 1>(0, 2) = bearing.radius_covariance;
    covariance.block<1, 2>(2, 0) = bearing.radius_covariance.transpose();
  }
  const Eigen::LLT<Matrix3d> cholesky(covariance);
  if (cholesky.info() != Eigen::Success) {
    throw Error("the covariance of camera number {}'s bearing is not positive definite: give it variances above 0",
                bearing.camera);
  }
  Matrix3d information = cholesky.solve(Matrix3d::Identity());
  if (!has_radius) information(2, 2) = 0.0;
  return information;
}

bool tells_nothing(const Bearing& bearing) {
  return std::isinf(bearing.covariance(0, 0)) || std::isinf(bearing.covariance(1, 1)) ||
         std::isinf(bearing.radius_variance);
}

// The derivatives of azimuth, elevation and angular radius by the point.
Matrix3d angles_by_point(const Vector3d& offset, double ball_radius) {
  const double r2 = offset.head<2>().squaredNorm();
  const double r = std::sqrt(r2);
  const double distance2 = offset.squaredNorm();
  const double tan_radius = ball_radius / std::sqrt(std::max(distance2 - ball_radius * ball_radius, 0.0));
  Matrix3d rows;
  rows << -offset.y() / r2, offset.x() / r2, 0.0,  //
      -offset.x() * offset.z() / (r * distance2), -offset.y() * offset.z() / (r * distance2), r / distance2,
      -tan_radius / distance2 * offset.transpose();
  return rows;
}

}  // namespace

Matrix3d position_bound(const omni::Rig& rig, const Vector3d& point_in_robot, const std::vector<Bearing>& covariances,
                        double ball_radius, double floor_sigma) {
  Matrix3d information = Matrix3d::Zero();
  for (const Bearing& bearing : covariances) {
    if (bearing.camera < 0 || bearing.camera >= static_cast<int>(rig.cameras.size())) {
      throw Error("a bearing is of camera number {}, the rig has {} cameras", bearing.camera, rig.cameras.size());
    }
    const bool has_radius = bearing.radius_variance > 0.0;
    if (has_radius && !(ball_radius > 0.0)) {
      throw Error("the ball's radius is {} m: angular radii tell nothing without one above 0", ball_radius);
    }
    const Vector3d offset = point_in_robot - rig.cameras[bearing.camera].position;
    if (tells_nothing(bearing) || offset.head<2>().norm() < kNoAzimuth * offset.norm()) continue;
    if (has_radius && offset.norm() <= ball_radius) continue;  // the camera is within the ball
    const Matrix3d rows = angles_by_point(offset, has_radius ? ball_radius : 0.0);
    information += rows.transpose() * information_of(bearing) * rows;
  }
  if (floor_sigma == 0.0) {
    Matrix3d bound = Matrix3d::Zero();
    bound.topLeftCorner<2, 2>() = inverse_information<2>(information.topLeftCorner<2, 2>());
    return bound.allFinite() ? bound : unobservable<3>();
  }
  if (floor_sigma > 0.0) information(2, 2) += 1.0 / (floor_sigma * floor_sigma);
  return inverse_information<3>(information);
}

FloorSigma floor_sigma_of(const Matrix3d& finite_bound, const Vector3d& point_in_robot) {
  const Eigen::Matrix2d floor = finite_bound.topLeftCorner<2, 2>();
  const double range = point_in_robot.head<2>().norm();
  if (!(range > 0.0)) throw Error("a distance and a direction of the robot's origin itself do not exist");
  const Eigen::Vector2d along = point_in_robot.head<2>() / range;
  const Eigen::Vector2d across(-along.y(), along.x());
  return {std::sqrt(along.dot(floor * along)), std::sqrt(across.dot(floor * across)) / range, std::sqrt(floor.trace())};
}

}  // namespace movis::triangulation
