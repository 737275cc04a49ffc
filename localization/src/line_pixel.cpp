#include "movis/localization/line_pixel.h"

#include <algorithm>
#include <cmath>

namespace movis::localization {
namespace {

double smaller_singular_value(const Eigen::Matrix2d& matrix) {
  const double sum = matrix.squaredNorm();  // of both squares
  const double product = std::abs(matrix(0, 0) * matrix(1, 1) - matrix(0, 1) * matrix(1, 0));
  return product / std::sqrt(0.5 * (sum + std::sqrt(std::max(0.0, sum * sum - 4.0 * product * product))));
}

}  // namespace

std::optional<LinePoint> line_point(const omni::Camera& camera, int index, const Eigen::Vector2d& pixel, double line) {
  const auto ray = unproject(camera, pixel);
  if (!ray || !(ray->z() < 0.0) || !(camera.position.z() > 0.0)) return std::nullopt;
  const double length = -camera.position.z() / ray->z();
  const Eigen::Matrix3d camera_from_robot = camera.robot_from_camera().transpose();
  const auto projection = project_with_jacobian(camera.model, camera_from_robot * (length * *ray));
  if (!projection) return std::nullopt;
  const Eigen::Matrix2d pixel_by_floor = projection->pixel_by_ray * camera_from_robot.leftCols<2>();
  const double way = 1.0 / smaller_singular_value(pixel_by_floor);
  LinePoint point;
  point.camera = index;
  point.azimuth = std::atan2(ray->y(), ray->x());
  point.elevation = std::asin(std::clamp(ray->z(), -1.0, 1.0));
  point.point = camera.position.head<2>() + length * ray->head<2>();
  point.sigma_on_floor = std::sqrt(line * line / 12.0 + way * way);
  point.sigma = way * -ray->z() / length;
  if (!point.point.allFinite() || !std::isfinite(point.sigma_on_floor)) return std::nullopt;
  return point;
}

}  // namespace movis::localization
