#pragma once

#include <optional>
#include <ostream>
#include <vector>

#include "movis/scan/scanner.h"
#include "omni_scene.h"

// Cameras, places around them, and what the scan makes of a rendered scene.
namespace movis::scan {

// Beside the robot's middle, turned and tilted.
inline omni::Camera tilted(omni::Camera camera) {
  camera.position = {0.05, -0.1, 0.25};
  camera.yaw = radians(-30.0);
  camera.tilt_x = radians(4.0);
  camera.tilt_y = radians(-3.0);
  return camera;
}

// What test suites over cameras run through.
struct CameraCase {
  const char* label;
  omni::Camera camera;
};

inline std::ostream& operator<<(std::ostream& out, const CameraCase& camera) {
  return out << camera.label;
}

inline std::vector<CameraCase> camera_cases() {
  return {{"Hyperboloid", hyperboloid_camera()},
          {"TiltedHyperboloid", tilted(hyperboloid_camera())},
          {"Unified", unified_camera()},
          {"TiltedUnified", tilted(unified_camera())}};
}

inline Vector2d floor_point(const omni::Camera& camera, double azimuth, double range) {
  return camera.position.head<2>() + range * Vector2d(std::cos(azimuth), std::sin(azimuth));
}

// A ball that lies on the floor.
inline Ball ball_at(const omni::Camera& camera, double azimuth, double range) {
  Ball ball;
  ball.centre << floor_point(camera, azimuth, range), ball.radius;
  return ball;
}

inline double azimuth_from(const omni::Camera& camera, const Vector2d& point) {
  const Vector2d offset = point - camera.position.head<2>();
  return std::atan2(offset.y(), offset.x());
}

inline double elevation_from(const omni::Camera& camera, const Vector3d& point) {
  const Vector3d offset = point - camera.position;
  return std::atan2(offset.z(), offset.head<2>().norm());
}

// A camera of its own rig, what it sees of a scene and what the scan makes of it.
class Eye {
 public:
  explicit Eye(const omni::Camera& camera, const ScanOptions& options = {})
      : camera_(camera), renderer_(camera), scanner_({{camera}}, 0, scene_colours(), options) {}

  const omni::Camera& camera() const { return camera_; }
  Picture render(const Scene& scene) const { return renderer_.render(scene); }

  std::vector<Bearing> scan(const Picture& picture) {
    std::vector<Bearing> bearings;
    scanner_.scan(picture.view, 0.0, bearings);
    return bearings;
  }

  std::optional<Bearing> find(ObjectClass object, const Picture& picture) {
    for (const Bearing& bearing : scan(picture)) {
      if (bearing.object == object) return bearing;
    }
    return std::nullopt;
  }

 private:
  omni::Camera camera_;
  OmniRenderer renderer_;
  Scanner scanner_;
};

}  // namespace movis::scan
