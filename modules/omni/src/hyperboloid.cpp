#include "movis/omni/hyperboloid.h"

#include <cmath>

#include "movis/omni/camera_model.h"
#include "sphere.h"

namespace movis::omni {
namespace {

struct Sphere {
  double xi;
  double scale;  // of the focal lengths
};

Sphere sphere_of(const Hyperboloid& model) {
  const double a2 = model.a * model.a;
  const double b2 = model.b * model.b;
  const double c = std::sqrt(a2 + b2);
  const double sum = 2.0 * a2 + b2;  // a² + c²
  return {2.0 * model.a * c / sum, b2 / sum};
}

// Does the unit ray meet the mirror within its rim?
bool meets_mirror(const Hyperboloid& model, const Eigen::Vector3d& ray) {
  const double eccentricity = std::sqrt(model.a * model.a + model.b * model.b) / model.a;
  const double opening = 1.0 - eccentricity * ray.z();
  if (!(opening > 0.0)) return false;
  const double distance = model.b * model.b / model.a / opening;
  return distance * ray.head<2>().norm() <= model.rim_radius;
}

}  // namespace

std::optional<Projection> project_with_jacobian(const Hyperboloid& model, const Eigen::Vector3d& ray_in_camera) {
  const Sphere sphere = sphere_of(model);
  const auto plane = sphere_to_plane(sphere.xi, ray_in_camera);
  if (!plane || !meets_mirror(model, ray_in_camera.normalized())) return std::nullopt;
  const Eigen::Vector2d focal = sphere.scale * Eigen::Vector2d(model.fu, model.fv);
  return Projection{Eigen::Vector2d(model.u0, model.v0) + focal.cwiseProduct(plane->m),
                    focal.asDiagonal() * plane->m_by_ray};
}

std::optional<Eigen::Vector3d> unproject(const Hyperboloid& model, const Eigen::Vector2d& pixel) {
  const Sphere sphere = sphere_of(model);
  const Eigen::Vector2d m((pixel.x() - model.u0) / (sphere.scale * model.fu),
                          (pixel.y() - model.v0) / (sphere.scale * model.fv));
  const auto ray = plane_to_sphere(sphere.xi, m);
  if (!ray || !meets_mirror(model, *ray)) return std::nullopt;
  return ray;
}

}  // namespace movis::omni
