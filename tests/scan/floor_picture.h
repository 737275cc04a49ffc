#pragma once

#include <array>
#include <functional>
#include <vector>

#include "omni_scene.h"

// Pictures of a painted floor whose truth is known in closed form.
namespace movis::scan {

inline const Light3 kCarpet = light(51, 129, 71);
inline const Light3 kWhite = light(228, 228, 225);

// The light of a floor's point in the robot frame.
using Paint = std::function<Light3(const Vector2d& point)>;

// Grey above the horizon. Where a pixel's neighbourhood shows more than one thing, its light is the mean of 8 × 8 rays.
inline Picture paint_floor(const omni::Camera& camera, const Paint& paint) {
  const Eigen::Matrix3d robot_from_camera = camera.robot_from_camera();
  const auto light_of = [&](double u, double v) -> Light3 {
    const auto ray_in_camera = unproject(camera.model, Vector2d(u, v));
    if (!ray_in_camera) return Light3::Zero();
    const Vector3d ray = robot_from_camera * *ray_in_camera;
    if (ray.z() > -1e-3) return kGrey;
    return paint(camera.position.head<2>() - camera.position.z() / ray.z() * ray.head<2>());
  };
  std::vector<Light3> plain;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) plain.push_back(light_of(u, v));
  }
  Picture picture;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const auto at = [&](int x, int y) -> const Light3& {
        return plain[static_cast<std::size_t>(std::clamp(y, 0, camera.height - 1)) * camera.width +
                     std::clamp(x, 0, camera.width - 1)];
      };
      Light3 mean = at(u, v);
      bool mixed = false;
      for (const auto& [x, y] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
        mixed = mixed || (at(x, y) != mean).any();
      }
      if (mixed) {
        constexpr int kSide = 8;
        mean.setZero();
        for (int i = 0; i < kSide * kSide; ++i) {
          const double sample_u = (i % kSide + 0.5) / kSide - 0.5;
          const double sample_v = (i / kSide + 0.5) / kSide - 0.5;
          mean += light_of(u + sample_u, v + sample_v) / (kSide * kSide);
        }
      }
      for (const int c : {2, 1, 0}) picture.bytes.push_back(static_cast<std::uint8_t>(std::lround(encoded(mean[c]))));
    }
  }
  picture.view = {picture.bytes.data(), camera.width, camera.height, 3 * camera.width, PixelFormat::bgr8};
  return picture;
}

// A stripe of this width around all points with normal·p = offset.
inline Paint stripe(const Vector2d& normal, double offset, double width, const Light3& colour = kWhite) {
  return [=](const Vector2d& point) { return std::abs(normal.dot(point) - offset) < 0.5 * width ? colour : kCarpet; };
}

}  // namespace movis::scan
