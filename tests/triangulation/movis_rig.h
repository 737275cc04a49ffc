#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <vector>

#include "movis/core/angle.h"
#include "movis/core/bearing.h"
#include "movis/core/random.h"
#include "movis/omni/rig.h"

// Rigs on a circle and the exact bearings that they have of a point, by plain trigonometry.
namespace movis::triangulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kL = 0.20;       // metres, of the paper's rig
constexpr double kHeight = 0.25;  // of the viewpoints
constexpr double kBall = 0.11;    // of the ball's centre

inline Vector2d direction(double azimuth) {
  return {std::cos(azimuth), std::sin(azimuth)};
}

inline omni::Camera camera_at(const Vector2d& position, double yaw) {
  omni::Camera camera;
  camera.position << position, kHeight;
  camera.yaw = yaw;
  camera.width = 640;
  camera.height = 480;
  camera.model = omni::Hyperboloid{0.028095, 0.0234125, 0.0275, 660.0, 660.0, 319.5, 239.5};
  return camera;
}

// M1 at 150°, M2 at 30°, M3 at 270°, each with its azimuth zero towards the centroid (docs/paper.md).
inline omni::Rig paper_rig(double radius = kL) {
  omni::Rig rig;
  for (const double azimuth_deg : {150.0, 30.0, 270.0}) {
    const double azimuth = radians(azimuth_deg);
    rig.cameras.push_back(camera_at(radius * direction(azimuth), wrap_angle(azimuth + kPi)));
  }
  return rig;
}

inline omni::Rig regular_rig(int cameras) {
  omni::Rig rig;
  for (int k = 0; k < cameras; ++k) {
    const double azimuth = 2.0 * kPi * k / cameras;
    rig.cameras.push_back(camera_at(kL * direction(azimuth), wrap_angle(azimuth + kPi)));
  }
  return rig;
}

inline double azimuth_of(const Vector2d& offset) {
  return std::atan2(offset.y(), offset.x());
}

inline Bearing exact_bearing(const omni::Rig& rig, int camera, const Vector3d& point, double sigma = 1e-3) {
  const Vector3d offset = point - rig.cameras[camera].position;
  Bearing bearing;
  bearing.camera = camera;
  bearing.azimuth = azimuth_of(offset.head<2>());
  bearing.elevation = std::atan2(offset.z(), offset.head<2>().norm());
  bearing.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  return bearing;
}

inline std::vector<Bearing> exact_bearings(const omni::Rig& rig, const Vector3d& point, double sigma = 1e-3) {
  std::vector<Bearing> bearings;
  bearings.reserve(rig.cameras.size());
  for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
    bearings.push_back(exact_bearing(rig, camera, point, sigma));
  }
  return bearings;
}

inline double normal(RandomStream& stream, double sigma) {
  return std::normal_distribution<double>(0.0, sigma)(stream);
}

inline double uniform(RandomStream& stream, double min, double max) {
  return std::uniform_real_distribution<double>(min, max)(stream);
}

}  // namespace movis::triangulation
