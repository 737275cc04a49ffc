#include "candidate.h"

#include <cmath>

#include "movis/core/angle.h"

namespace movis::calibration {

Direction direction_of(const Eigen::Vector3d& ray_in_robot) {
  return {std::atan2(ray_in_robot.y(), ray_in_robot.x()), std::atan2(ray_in_robot.z(), ray_in_robot.head<2>().norm())};
}

omni::Camera bare(const omni::Camera& camera) {
  omni::Camera result = camera;
  result.name.clear();
  result.mask.clear();
  if (auto* mirror = std::get_if<omni::Hyperboloid>(&result.model)) mirror->rim_radius *= 2.0;
  if (auto* sphere = std::get_if<omni::UnifiedSphere>(&result.model)) sphere->max_elevation = kPi / 2.0;
  if (auto* radial = std::get_if<omni::Radial>(&result.model)) radial->max_radius_px *= 2.0;
  return result;
}

omni::Camera candidate(const omni::Camera& drawing, const omni::Deviation& sigma, const double* deviation) {
  return omni::deviated(drawing, sigma.cwiseProduct(Eigen::Map<const omni::Deviation>(deviation)));
}

std::optional<Eigen::Vector2d> pixel_of(const omni::Camera& believed, const Direction& direction) {
  const double level = std::cos(direction.elevation);
  const Eigen::Vector3d ray(level * std::cos(direction.azimuth), level * std::sin(direction.azimuth),
                            std::sin(direction.elevation));
  return project(believed.model, Eigen::Vector3d(believed.robot_from_camera().transpose() * ray));
}

std::optional<Direction> direction_of(const omni::Camera& camera, const Eigen::Vector2d& pixel) {
  const auto ray = unproject(camera, pixel);
  if (!ray) return std::nullopt;
  return direction_of(*ray);
}

}  // namespace movis::calibration
