#include "movis/omni/unified_sphere.h"

#include <Eigen/LU>
#include <cmath>

#include "movis/omni/camera_model.h"
#include "sphere.h"

namespace movis::omni {
namespace {

struct Distorted {
  Eigen::Vector2d m;
  Eigen::Matrix2d by_undistorted;
};

Distorted distort(const UnifiedSphere& model, const Eigen::Vector2d& m) {
  const double x = m.x();
  const double y = m.y();
  const double rho2 = m.squaredNorm();
  const double k = 1.0 + rho2 * (model.k1 + rho2 * model.k2);
  const double k_by_rho2 = model.k1 + 2.0 * model.k2 * rho2;
  Distorted d;
  d.m.x() = k * x + 2.0 * model.p1 * x * y + model.p2 * (rho2 + 2.0 * x * x);
  d.m.y() = k * y + model.p1 * (rho2 + 2.0 * y * y) + 2.0 * model.p2 * x * y;
  const double shear = 2.0 * k_by_rho2 * x * y + 2.0 * model.p1 * x + 2.0 * model.p2 * y;
  d.by_undistorted << k + 2.0 * k_by_rho2 * x * x + 2.0 * model.p1 * y + 6.0 * model.p2 * x, shear,  //
      shear, k + 2.0 * k_by_rho2 * y * y + 6.0 * model.p1 * y + 2.0 * model.p2 * x;
  return d;
}

// The distortion keeps the order of points along a ray from the centre up to the turning point of its radial part, the
// first positive root of d(kρ)/dρ = 1 + 3 k1 ρ² + 5 k2 ρ⁴.
bool grows_outwards(const UnifiedSphere& model, double rho2) {
  const double a = 5.0 * model.k2;
  const double half_b = 1.5 * model.k1;
  const double radicand = half_b * half_b - a;
  if (radicand < 0.0) return true;  // no root
  // The roots of 1 + 2 half_b x + a x² are 1/(−half_b ± √radicand); the larger denominator gives the first.
  const double denominator = -half_b + std::sqrt(radicand);
  return denominator <= 0.0 || rho2 * denominator < 1.0;
}

// Newton's method on distort(m) = target.
std::optional<Eigen::Vector2d> undistort(const UnifiedSphere& model, const Eigen::Vector2d& target) {
  constexpr int kMaxSteps = 20;
  constexpr double kTolerance = 1e-13;
  Eigen::Vector2d m = target;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Distorted d = distort(model, m);
    const Eigen::Vector2d error = target - d.m;
    if (error.norm() < kTolerance * (1.0 + target.norm())) {
      if (!grows_outwards(model, m.squaredNorm())) return std::nullopt;
      return m;
    }
    m += d.by_undistorted.inverse() * error;
    if (!m.allFinite()) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Projection> project_with_jacobian(const UnifiedSphere& model, const Eigen::Vector3d& ray_in_camera) {
  const auto plane = sphere_to_plane(model.xi, ray_in_camera);
  if (!plane || ray_in_camera.z() > std::sin(model.max_elevation) * ray_in_camera.norm()) return std::nullopt;
  if (!grows_outwards(model, plane->m.squaredNorm())) return std::nullopt;
  const Distorted d = distort(model, plane->m);
  Eigen::Matrix2d pixel_by_m;
  pixel_by_m << model.fu, model.fu * model.skew, 0.0, model.fv;
  return Projection{Eigen::Vector2d(model.u0, model.v0) + pixel_by_m * d.m,
                    pixel_by_m * d.by_undistorted * plane->m_by_ray};
}

std::optional<Eigen::Vector3d> unproject(const UnifiedSphere& model, const Eigen::Vector2d& pixel) {
  const double y = (pixel.y() - model.v0) / model.fv;
  const Eigen::Vector2d distorted((pixel.x() - model.u0) / model.fu - model.skew * y, y);
  const auto m = undistort(model, distorted);
  if (!m) return std::nullopt;
  const auto ray = plane_to_sphere(model.xi, *m);
  if (!ray || ray->z() >= std::min(model.xi, 1.0 / model.xi) || ray->z() > std::sin(model.max_elevation)) {
    return std::nullopt;
  }
  return ray;
}

}  // namespace movis::omni
