// Level `bearings`: the ball's cone, with noise, through the true camera to pixels and back through the believed one.
#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "eyes.h"
#include "movis/sim/scene.h"

namespace movis::experiments {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector3d ray(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

// A ball in one camera's picture: the pixels of its centre's ray and of four rays of its cone's mantle.
struct Seen {
  std::array<Vector2d, 5> pixels;
  Eigen::Matrix3d covariance;  // of (azimuth, elevation, radius)
};

class BearingEyes : public Eyes {
 public:
  BearingEyes(const MeasurementSettings& settings, const omni::Rig& truth) : settings_(settings), truth_(truth) {}

  int believe(const omni::Rig& rig) override {
    believed_.push_back(rig);
    return static_cast<int>(believed_.size()) - 1;
  }

  void look_at(const Vector2d& ball, std::uint64_t noise_seed) override {
    RandomStream random = make_stream(noise_seed, 0);
    std::normal_distribution<double> normal;
    seen_.clear();
    for (const omni::Camera& camera : truth_.cameras) {
      Vector3d draw;
      for (double& number : draw) number = normal(random);  // also where it is not seen: the next camera's stay its own
      seen_.push_back(see(camera, {ball.x(), ball.y(), sim::kBallRadius}, draw));
    }
  }

  void bearings(int believed, std::vector<Bearing>& bearings) override {
    const omni::Rig& rig = believed_.at(static_cast<std::size_t>(believed));
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      if (!seen_[i]) continue;
      if (const auto bearing = bearing_of(rig.cameras[i], static_cast<int>(i), *seen_[i])) {
        bearings.push_back(*bearing);
      }
    }
  }

 private:
  std::optional<Seen> see(const omni::Camera& camera, const Vector3d& ball, const Vector3d& draw) const;
  static std::optional<Bearing> bearing_of(const omni::Camera& camera, int index, const Seen& seen);

  const MeasurementSettings& settings_;
  omni::Rig truth_;
  std::vector<omni::Rig> believed_;
  std::vector<std::optional<Seen>> seen_;  // by camera
};

std::optional<Seen> BearingEyes::see(const omni::Camera& camera, const Vector3d& ball, const Vector3d& draw) const {
  Seen seen;
  seen.covariance = settings_.detector_factor * settings_.detector_factor *
                    triangulation::bearing_bound(camera, ball, sim::kBallRadius, settings_.picture);
  if (!seen.covariance.allFinite()) return std::nullopt;
  const Vector3d noise = seen.covariance.llt().matrixL() * draw;
  const Vector3d offset = ball - camera.position;
  const double azimuth = std::atan2(offset.y(), offset.x()) + noise[0];
  const double elevation = std::atan2(offset.z(), offset.head<2>().norm()) + noise[1];
  const double radius = std::asin(sim::kBallRadius / offset.norm()) + noise[2];
  const Vector3d centre = ray(azimuth, elevation);
  const Vector3d up = ray(azimuth, elevation + 0.5 * kPi);
  const Vector3d left(-std::sin(azimuth), std::cos(azimuth), 0.0);
  const std::array<Vector3d, 5> rays{
      centre, std::cos(radius) * centre + std::sin(radius) * up, std::cos(radius) * centre - std::sin(radius) * up,
      std::cos(radius) * centre + std::sin(radius) * left, std::cos(radius) * centre - std::sin(radius) * left};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto pixel = omni::project(camera, camera.position + rays[i]);
    if (!pixel) return std::nullopt;
    seen.pixels[i] = *pixel;
  }
  return seen;
}

std::optional<Bearing> BearingEyes::bearing_of(const omni::Camera& camera, int index, const Seen& seen) {
  std::array<Vector3d, 5> rays;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto found = omni::unproject(camera, seen.pixels[i]);
    if (!found) return std::nullopt;
    rays[i] = *found;
  }
  Bearing bearing;
  bearing.camera = index;
  bearing.object = ObjectClass::ball;
  bearing.azimuth = std::atan2(rays[0].y(), rays[0].x());
  bearing.elevation = std::atan2(rays[0].z(), rays[0].head<2>().norm());
  bearing.covariance = seen.covariance.topLeftCorner<2, 2>();
  for (std::size_t i = 1; i < rays.size(); ++i) {
    bearing.radius += 0.25 * std::atan2(rays[0].cross(rays[i]).norm(), rays[0].dot(rays[i]));
  }
  bearing.radius_variance = seen.covariance(2, 2);
  bearing.radius_covariance = seen.covariance.col(2).head<2>();
  return bearing;
}

}  // namespace

std::unique_ptr<Eyes> make_bearing_eyes(const MeasurementSettings& settings, const omni::Rig& truth) {
  return std::make_unique<BearingEyes>(settings, truth);
}

}  // namespace movis::experiments
