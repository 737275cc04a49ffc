#include "movis/omni/rig.h"

#include <Eigen/Geometry>

namespace movis::omni {

Eigen::Matrix3d Camera::robot_from_camera() const {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(yaw, Vector3d::UnitZ()) * AngleAxisd(tilt_y, Vector3d::UnitY()) *
          AngleAxisd(tilt_x, Vector3d::UnitX()))
      .toRotationMatrix();
}

std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point_in_robot) {
  const Eigen::Vector3d ray_in_camera = camera.robot_from_camera().transpose() * (point_in_robot - camera.position);
  const auto pixel = project(camera.model, ray_in_camera);
  // The picture reaches half a pixel beyond the centres of its outermost pixels.
  if (!pixel || pixel->x() < -0.5 || pixel->y() < -0.5 || pixel->x() > camera.width - 0.5 ||
      pixel->y() > camera.height - 0.5) {
    return std::nullopt;
  }
  return pixel;
}

std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel) {
  const auto ray_in_camera = unproject(camera.model, pixel);
  if (!ray_in_camera) return std::nullopt;
  return Eigen::Vector3d(camera.robot_from_camera() * *ray_in_camera);
}

}  // namespace movis::omni
