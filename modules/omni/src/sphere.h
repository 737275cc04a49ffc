#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

namespace movis::omni {

// The step that both models share: a unit ray s to the normalized plane, m = (s_x, s_y)/(ξ − s_z), and back.

struct PlanePoint {
  Eigen::Vector2d m;
  Eigen::Matrix<double, 2, 3> m_by_ray;  // for a ray of any length
};

// Nothing for a null ray, or where the ray has no image point of its own: s_z ≥ min(ξ, 1/ξ).
inline std::optional<PlanePoint> sphere_to_plane(double xi, const Eigen::Vector3d& ray) {
  const double length = ray.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  if (ray.z() >= std::min(xi, 1.0 / xi) * length) return std::nullopt;
  // With the length kept, m = (x, y)/(ξ |ray| − z) =: (x, y)/D and ∂D = ξ ray/|ray| − e_z.
  const double inverse_depth = 1.0 / (xi * length - ray.z());
  PlanePoint plane;
  plane.m = ray.head<2>() * inverse_depth;
  const Eigen::RowVector3d depth_by_ray = xi / length * ray.transpose() - Eigen::RowVector3d::UnitZ();
  plane.m_by_ray = -inverse_depth * plane.m * depth_by_ray;
  plane.m_by_ray(0, 0) += inverse_depth;
  plane.m_by_ray(1, 1) += inverse_depth;
  return plane;
}

// The unit ray; nothing where the line meets no point of the sphere (ξ > 1, far out).
inline std::optional<Eigen::Vector3d> plane_to_sphere(double xi, const Eigen::Vector2d& m) {
  const double rho2 = m.squaredNorm();
  const double radicand = 1.0 + (1.0 - xi * xi) * rho2;
  if (!(radicand >= 0.0)) return std::nullopt;
  const double scale = (xi + std::sqrt(radicand)) / (1.0 + rho2);
  return Eigen::Vector3d(scale * m.x(), scale * m.y(), xi - scale);
}

}  // namespace movis::omni
