#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "movis/core/paths.h"
#include "movis/scan/scanner.h"
#include "omni_scene.h"

// Pictures of a painted floor whose truth is known in closed form, and what the scan makes of them.
namespace movis::scan {

inline const Light3 kCarpet = light(51, 129, 71);
inline const Light3 kWhite = light(228, 228, 225);
inline constexpr double kLineWidth = 0.05;

// The light of a floor's point in the robot frame.
using Paint = std::function<Light3(const Vector2d& point)>;

// A camera of its own rig over painted floors. Its pixels' rays and its scanner take longer to make than to use.
class FloorEye {
 public:
  explicit FloorEye(const omni::Camera& camera, double line_width = kLineWidth)
      : camera_(camera),
        robot_from_camera_(camera.robot_from_camera()),
        scanner_({{camera}}, 0, read_colours(data_file("colours/default.yaml")), ScanOptions{}, line_width) {
    spots_.reserve(static_cast<std::size_t>(camera.width) * camera.height);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) spots_.push_back(spot_at(u, v));
    }
  }

  const omni::Camera& camera() const { return camera_; }

  // Grey above the horizon. Where a pixel's neighbourhood shows more than one thing on the floor, its light is the mean
  // of 8 × 8 rays.
  Picture paint(const Paint& paint) const {
    std::vector<Light3> plain;
    plain.reserve(spots_.size());
    for (const Spot& spot : spots_) plain.push_back(light_of(spot, paint));
    Picture picture;
    picture.bytes.reserve(3 * plain.size());
    Light3 last = Light3::Constant(-1.0);
    std::array<std::uint8_t, 3> bgr{};
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const Light3 mean = mixed(plain, u, v) ? supersampled(paint, u, v) : plain[index(u, v)];
        if ((mean != last).any()) {
          for (int c = 0; c < 3; ++c) bgr[2 - c] = static_cast<std::uint8_t>(std::lround(encoded(mean[c])));
          last = mean;
        }
        picture.bytes.insert(picture.bytes.end(), bgr.begin(), bgr.end());
      }
    }
    picture.view = {picture.bytes.data(), camera_.width, camera_.height, 3 * camera_.width, PixelFormat::bgr8};
    return picture;
  }

  std::vector<LinePoint> lines(const Picture& picture) { return scan(picture).lines; }
  std::vector<ObstacleSight> obstacles(const Picture& picture) { return scan(picture).obstacles; }

 private:
  struct Spot {
    enum { nothing, sky, floor } shows = nothing;
    Vector2d place = Vector2d::Zero();
  };
  struct Seen {
    std::vector<LinePoint> lines;
    std::vector<ObstacleSight> obstacles;
  };

  Seen scan(const Picture& picture) {
    Seen seen;
    scanner_.scan_floor(picture.view, seen.lines, seen.obstacles);
    return seen;
  }

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * camera_.width + u; }

  Spot spot_at(double u, double v) const {
    const auto ray_in_camera = unproject(camera_.model, Vector2d(u, v));
    if (!ray_in_camera) return {};
    const Vector3d ray = robot_from_camera_ * *ray_in_camera;
    if (ray.z() > -1e-3) return {Spot::sky};
    return {Spot::floor, camera_.position.head<2>() - camera_.position.z() / ray.z() * ray.head<2>()};
  }

  static Light3 light_of(const Spot& spot, const Paint& paint) {
    if (spot.shows == Spot::nothing) return Light3::Zero();
    return spot.shows == Spot::sky ? kGrey : paint(spot.place);
  }

  // The horizon and the mirror's border do not count: they are beyond the scan's range.
  bool mixed(const std::vector<Light3>& plain, int u, int v) const {
    if (spots_[index(u, v)].shows != Spot::floor) return false;
    for (const auto& [x, y] : {std::pair{u - 1, v}, {u + 1, v}, {u, v - 1}, {u, v + 1}}) {
      if (x < 0 || y < 0 || x >= camera_.width || y >= camera_.height) continue;
      const std::size_t beside = index(x, y);
      if (spots_[beside].shows == Spot::floor && (plain[beside] != plain[index(u, v)]).any()) return true;
    }
    return false;
  }

  Light3 supersampled(const Paint& paint, int u, int v) const {
    constexpr int kSide = 8;
    Light3 sum = Light3::Zero();
    for (int i = 0; i < kSide * kSide; ++i) {
      const double sample_u = (i % kSide + 0.5) / kSide - 0.5;
      const double sample_v = (i / kSide + 0.5) / kSide - 0.5;
      sum += light_of(spot_at(u + sample_u, v + sample_v), paint);
    }
    return sum / (kSide * kSide);
  }

  omni::Camera camera_;
  Eigen::Matrix3d robot_from_camera_;
  Scanner scanner_;
  std::vector<Spot> spots_;  // of the pixels' centres
};

// What most tests look with: 0.25 m over (0, 0), upright.
inline FloorEye& upright_eye() {
  static FloorEye eye(hyperboloid_camera());
  return eye;
}

// A stripe of this width around all points with normal·p = offset.
inline Paint stripe(const Vector2d& normal, double offset, double width = kLineWidth, const Light3& colour = kWhite) {
  return [=](const Vector2d& point) { return std::abs(normal.dot(point) - offset) < 0.5 * width ? colour : kCarpet; };
}

}  // namespace movis::scan
