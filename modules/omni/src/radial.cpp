#include "movis/omni/radial.h"

#include <cmath>

#include "movis/core/angle.h"
#include "movis/omni/camera_model.h"

namespace movis::omni {

std::optional<Projection> project_with_jacobian(const Radial& model, const Eigen::Vector3d& ray_in_camera) {
  const double down = -ray_in_camera.z();
  const Eigen::Vector2d across = ray_in_camera.head<2>();
  const double away = across.norm();
  if (!(down > 0.0) || !std::isfinite(down) || !std::isfinite(away)) return std::nullopt;
  const double slope = model.height / model.a;
  const double tangent = slope * away / down;  // tan(b ρ)
  const double radius = std::atan(tangent) / model.b;
  if (!(radius <= model.max_radius_px)) return std::nullopt;
  const double radius_by_away = slope / (model.b * down * (1.0 + tangent * tangent));
  // Straight down, ρ/away is its own limit.
  const double scale = away > 0.0 ? radius / away : radius_by_away;
  const Eigen::Vector2d outwards = away > 0.0 ? Eigen::Vector2d(across / away) : Eigen::Vector2d(1.0, 0.0);
  Projection projection;
  projection.pixel = Eigen::Vector2d(model.u0, model.v0) + scale * across;
  projection.pixel_by_ray.leftCols<2>() =
      scale * Eigen::Matrix2d::Identity() + (radius_by_away - scale) * outwards * outwards.transpose();
  projection.pixel_by_ray.col(2) = radius_by_away * away / down * outwards;
  return projection;
}

std::optional<Eigen::Vector3d> unproject(const Radial& model, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d from_centre = pixel - Eigen::Vector2d(model.u0, model.v0);
  const double radius = from_centre.norm();
  if (!(radius <= model.max_radius_px) || !(model.b * radius < 0.5 * kPi)) return std::nullopt;
  if (radius == 0.0) return -Eigen::Vector3d::UnitZ();
  const double tangent = model.a / model.height * std::tan(model.b * radius);
  const Eigen::Vector2d across = tangent / radius * from_centre;
  return Eigen::Vector3d(across.x(), across.y(), -1.0).normalized();
}

}  // namespace movis::omni
