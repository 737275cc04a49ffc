#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "movis/core/angle.h"
#include "movis/core/image_view.h"
#include "movis/core/random.h"
#include "movis/omni/rig.h"
#include "movis/scan/colours.h"

// A tiny renderer of scenes whose truth is known in closed form: balls and upright rectangles on grey. Where a pixel's
// neighbourhood shows more than one thing, its light is the mean of 8 × 8 rays, in linear light.
namespace movis::scan {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline omni::Camera hyperboloid_camera() {
  omni::Camera camera;
  camera.name = "M1";
  camera.position = {0.0, 0.0, 0.25};
  camera.width = 640;
  camera.height = 480;
  camera.model = omni::Hyperboloid{0.028095, 0.0234125, 0.0275, 660.0, 660.0, 319.5, 239.5};
  return camera;
}

inline omni::Camera unified_camera() {
  omni::Camera camera = hyperboloid_camera();
  omni::UnifiedSphere model;
  model.xi = 0.9;
  model.fu = 185.0;
  model.fv = 184.0;
  model.u0 = 321.3;
  model.v0 = 238.6;
  model.k1 = -0.02;
  model.p1 = 1e-3;
  model.max_elevation = radians(12.0);
  camera.model = model;
  return camera;
}

using Light3 = Eigen::Array3d;  // linear R, G, B

// sRGB, IEC 61966-2-1.
inline double encoded(double linear) {
  return 255.0 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055);
}

inline double decoded(double byte) {
  const double c = byte / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

inline Light3 light(double r, double g, double b) {  // from encoded 0…255
  return {decoded(r), decoded(g), decoded(b)};
}

// Hues by hand, from α = R − (G + B)/2 and β = √3/2 (G − B): 25.3°, 54.5°, 227°; and no hue.
inline const Light3 kOrange = light(230, 110, 20);
inline const Light3 kYellow = light(220, 200, 30);
inline const Light3 kBlue = light(30, 70, 200);
inline const Light3 kGrey = light(120, 120, 120);
inline const Light3 kBlack = light(8, 8, 8);

inline Colours scene_colours() {
  const auto sector = [](ObjectClass object, double from_deg, double to_deg) {
    return ColourClass{object, radians(from_deg), radians(to_deg - from_deg), 0.25, 1.0, 0.2, 1.0};
  };
  return {{sector(ObjectClass::ball, 5.0, 38.0), sector(ObjectClass::yellow_goal, 40.0, 70.0),
           sector(ObjectClass::blue_goal, 205.0, 250.0)}};
}

struct Ball {
  Vector3d centre;
  double radius = 0.11;
  Light3 colour = kOrange;
};

// An upright rectangle over the floor line from a to b.
struct Wall {
  Vector2d a, b;
  double low, high;
  Light3 colour;
};

struct Scene {
  std::vector<Ball> balls;
  std::vector<Wall> walls;
};

struct Picture {
  std::vector<std::uint8_t> bytes;  // BGR
  ImageView view;
};

class OmniRenderer {
 public:
  explicit OmniRenderer(const omni::Camera& camera) : camera_(camera), robot_from_camera_(camera.robot_from_camera()) {
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) rays_.push_back(ray_of(Vector2d(u, v)));
    }
  }

  Picture render(const Scene& scene) const {
    std::vector<int> shown(rays_.size(), kNothing);
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (rays_[i]) shown[i] = hit(scene, *rays_[i]);
    }
    std::vector<Bytes> plain;  // by what is shown, from kNothing
    for (int id = kNothing; id < static_cast<int>(scene.balls.size() + scene.walls.size()); ++id) {
      plain.push_back(to_bytes(colour(scene, id)));
    }
    Picture picture;
    picture.bytes.resize(3 * rays_.size());
    for (int v = 0; v < camera_.height; ++v) {
      for (int u = 0; u < camera_.width; ++u) {
        const std::size_t i = static_cast<std::size_t>(v) * camera_.width + u;
        const Bytes bytes =
            uniform_around(shown, u, v) ? plain[shown[i] - kNothing] : to_bytes(supersampled(scene, u, v));
        std::copy(bytes.begin(), bytes.end(), picture.bytes.begin() + 3 * static_cast<std::ptrdiff_t>(i));
      }
    }
    picture.view = {picture.bytes.data(), camera_.width, camera_.height, 3 * camera_.width, PixelFormat::bgr8};
    return picture;
  }

 private:
  using Bytes = std::array<std::uint8_t, 3>;  // B, G, R

  static Bytes to_bytes(const Light3& linear) {
    const auto byte = [&](int c) { return static_cast<std::uint8_t>(std::lround(encoded(linear[c]))); };
    return {byte(2), byte(1), byte(0)};
  }

  static constexpr int kNothing = -2;  // no ray: black
  static constexpr int kBackground = -1;

  std::optional<Vector3d> ray_of(const Vector2d& pixel) const {
    const auto ray_in_camera = unproject(camera_.model, pixel);
    if (!ray_in_camera) return std::nullopt;
    return Vector3d(robot_from_camera_ * *ray_in_camera);
  }

  // What the ray meets first: a ball by its index, walls after the balls.
  int hit(const Scene& scene, const Vector3d& ray) const {
    int nearest = kBackground;
    double distance = 1e9;
    const int balls = static_cast<int>(scene.balls.size());
    for (int i = 0; i < balls; ++i) {
      const Ball& ball = scene.balls[i];
      const double x = ball.centre.x() - camera_.position.x();
      const double y = ball.centre.y() - camera_.position.y();
      const double z = ball.centre.z() - camera_.position.z();
      const double along = x * ray.x() + y * ray.y() + z * ray.z();
      const double radicand = along * along - (x * x + y * y + z * z) + ball.radius * ball.radius;
      if (along <= 0.0 || radicand < 0.0 || along - std::sqrt(radicand) >= distance) continue;
      distance = along - std::sqrt(radicand);
      nearest = i;
    }
    for (int i = 0; i < static_cast<int>(scene.walls.size()); ++i) {
      // camera + t ray = a + s (b − a) in plan, by Cramer's rule.
      const Wall& wall = scene.walls[i];
      const Vector2d side = wall.b - wall.a;
      const Vector2d to_a = wall.a - camera_.position.head<2>();
      const double determinant = ray.x() * side.y() - ray.y() * side.x();
      if (std::abs(determinant) < 1e-12) continue;
      const double t = (to_a.x() * side.y() - to_a.y() * side.x()) / determinant;
      const double s = (to_a.x() * ray.y() - to_a.y() * ray.x()) / determinant;
      const double z = camera_.position.z() + t * ray.z();
      if (t <= 0.0 || t >= distance || s < 0.0 || s > 1.0 || z < wall.low || z > wall.high) continue;
      distance = t;
      nearest = balls + i;
    }
    return nearest;
  }

  static Light3 colour(const Scene& scene, int shown) {
    const int balls = static_cast<int>(scene.balls.size());
    if (shown == kNothing) return Light3::Zero();
    if (shown == kBackground) return kGrey;
    return shown < balls ? scene.balls[shown].colour : scene.walls[shown - balls].colour;
  }

  // The border of the mirror does not count: nothing is there to be seen.
  bool uniform_around(const std::vector<int>& shown, int u, int v) const {
    const int here = shown[static_cast<std::size_t>(v) * camera_.width + u];
    if (here == kNothing) return true;
    for (int y = std::max(0, v - 1); y <= std::min(camera_.height - 1, v + 1); ++y) {
      for (int x = std::max(0, u - 1); x <= std::min(camera_.width - 1, u + 1); ++x) {
        const int there = shown[static_cast<std::size_t>(y) * camera_.width + x];
        if (there != here && there != kNothing) return false;
      }
    }
    return true;
  }

  Light3 supersampled(const Scene& scene, int u, int v) const {
    constexpr int kSide = 8;
    Light3 sum = Light3::Zero();
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto ray = ray_of({u + (x + 0.5) / kSide - 0.5, v + (y + 0.5) / kSide - 0.5});
        sum += colour(scene, ray ? hit(scene, *ray) : kNothing);
      }
    }
    return sum / (kSide * kSide);
  }

  omni::Camera camera_;
  Eigen::Matrix3d robot_from_camera_;
  std::vector<std::optional<Vector3d>> rays_;  // of the pixels' centres
};

// Gaussian noise of the camera, in grey levels: a table of draws, used again and again.
inline void add_noise(Picture& picture, double sigma, RandomStream& stream) {
  constexpr std::size_t kTable = 16381;  // a prime: rows do not repeat each other
  std::normal_distribution<double> noise(0.0, sigma);
  std::vector<int> table(kTable);
  for (int& value : table) value = static_cast<int>(std::lround(noise(stream)));
  for (std::size_t begin = 0; begin < picture.bytes.size(); begin += kTable) {
    std::uint8_t* bytes = picture.bytes.data() + begin;
    const std::size_t count = std::min(kTable, picture.bytes.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      bytes[i] = static_cast<std::uint8_t>(std::clamp(bytes[i] + table[i], 0, 255));
    }
  }
}

}  // namespace movis::scan
