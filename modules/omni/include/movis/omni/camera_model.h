#pragma once

#include <Eigen/Core>
#include <optional>
#include <variant>

#include "movis/omni/hyperboloid.h"
#include "movis/omni/radial.h"
#include "movis/omni/unified_sphere.h"

namespace movis::omni {

// The closed set of central camera models. All share the camera frame (origin at the effective viewpoint, z up along
// the mirror's axis; image u grows along x, v along y) and these functions, which dispatch to the model:
//   project    ray in the camera frame (any length > 0) → pixel; nothing outside the model's domain
//   unproject  pixel → unit ray in the camera frame; nothing where no ray of the domain arrives
using CameraModel = std::variant<Hyperboloid, UnifiedSphere, Radial>;

using PixelJacobian = Eigen::Matrix<double, 2, 3>;  // ∂(u, v)/∂(x, y, z) of the ray, pixels per unit of the ray

struct Projection {
  Eigen::Vector2d pixel;
  PixelJacobian pixel_by_ray;
};

std::optional<Eigen::Vector2d> project(const CameraModel& model, const Eigen::Vector3d& ray_in_camera);
std::optional<Projection> project_with_jacobian(const CameraModel& model, const Eigen::Vector3d& ray_in_camera);
std::optional<Eigen::Vector3d> unproject(const CameraModel& model, const Eigen::Vector2d& pixel);

const char* name(const CameraModel& model);

}  // namespace movis::omni
