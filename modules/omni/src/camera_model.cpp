#include "movis/omni/camera_model.h"

namespace movis::omni {

std::optional<Projection> project_with_jacobian(const CameraModel& model, const Eigen::Vector3d& ray_in_camera) {
  return std::visit([&](const auto& m) { return project_with_jacobian(m, ray_in_camera); }, model);
}

std::optional<Eigen::Vector2d> project(const CameraModel& model, const Eigen::Vector3d& ray_in_camera) {
  const auto projection = project_with_jacobian(model, ray_in_camera);
  if (!projection) return std::nullopt;
  return projection->pixel;
}

std::optional<Eigen::Vector3d> unproject(const CameraModel& model, const Eigen::Vector2d& pixel) {
  return std::visit([&](const auto& m) { return unproject(m, pixel); }, model);
}

const char* name(const CameraModel& model) {
  struct Name {
    const char* operator()(const Hyperboloid&) const { return "hyperboloid"; }
    const char* operator()(const UnifiedSphere&) const { return "unified"; }
    const char* operator()(const Radial&) const { return "radial"; }
  };
  return std::visit(Name{}, model);
}

}  // namespace movis::omni
