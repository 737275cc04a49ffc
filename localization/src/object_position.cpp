#include "movis/localization/object_position.h"

#include <Eigen/Geometry>

namespace movis::localization {

ObjectPosition object_position(const Fix& fix, const PointEstimate& point_in_robot) {
  if (point_in_robot.status != PointStatus::ok) return {ObjectStatus::no_point};
  if (fix.status != FixStatus::ok) return {ObjectStatus::no_pose};
  const Pose2& world_from_robot = fix.world_from_robot;
  ObjectPosition object{ObjectStatus::ok, world_from_robot * Eigen::Vector2d(point_in_robot.point.head<2>())};
  const Eigen::Vector2d arm = object.in_field - world_from_robot.translation();
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(world_from_robot.beta).toRotationMatrix();
  Eigen::Matrix<double, 2, 3> by_pose;
  by_pose << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  object.covariance.noalias() = by_pose * fix.covariance * by_pose.transpose();
  object.covariance.noalias() += rotation * point_in_robot.covariance.topLeftCorner<2, 2>() * rotation.transpose();
  if (!object.in_field.allFinite() || !object.covariance.allFinite()) return {ObjectStatus::not_finite};
  return object;
}

}  // namespace movis::localization
