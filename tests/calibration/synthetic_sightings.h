#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "movis/localization/goal_silhouette.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/core/pose.h"
#include "movis/core/random.h"
#include "movis/omni/deviation.h"

// What a scan would find on the images of one rig while another rig is believed, without any image: the true direction,
// its pixel through the true camera, and that pixel's direction through the believed one.
namespace movis::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline omni::Rig drawn_rig() {
  return omni::read_rig(data_file("rigs/movis.yaml"));
}

inline double normal(RandomStream& random, double sigma) {
  return std::normal_distribution<double>(0.0, sigma)(random);
}

// One sigma each, degrees; 0: exact.
struct Noise {
  double azimuth_deg = 0.0, elevation_deg = 0.0, edge_deg = 0.0;
};

// A variance of 0 would be infinite trust: exact bearings state a small one.
inline double variance(double sigma_deg) {
  constexpr double kStated = 0.002;
  return std::pow(radians(sigma_deg > 0.0 ? sigma_deg : kStated), 2);
}

inline Vector3d ray(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

// The direction in which the believed camera sees what the true one sees at a direction of the robot's axes.
inline std::optional<Vector3d> mistaken(const omni::Camera& true_camera, const omni::Camera& believed,
                                        const Vector3d& direction) {
  const auto pixel = project(true_camera, Vector3d(true_camera.position + direction));
  if (!pixel) return std::nullopt;
  return unproject(believed, *pixel);
}

class Observer {
 public:
  Observer(omni::Rig true_rig, omni::Rig believed, const Noise& noise, double elevation_bias, RandomStream& random)
      : true_rig_(std::move(true_rig)),
        believed_(std::move(believed)),
        noise_(noise),
        elevation_bias_(elevation_bias),
        random_(random) {}

  void see_ball(const Vector3d& ball_in_robot, calibration::Sighting& sighting) {
    for (std::size_t k = 0; k < true_rig_.cameras.size(); ++k) {
      const Vector3d offset = ball_in_robot - true_rig_.cameras[k].position;
      const double azimuth = std::atan2(offset.y(), offset.x()) + normal(random_, radians(noise_.azimuth_deg));
      const double elevation = std::atan2(offset.z(), offset.head<2>().norm()) + elevation_bias_ +
                               normal(random_, radians(noise_.elevation_deg));
      const auto seen = mistaken(true_rig_.cameras[k], believed_.cameras[k], ray(azimuth, elevation));
      if (!seen) continue;
      Bearing bearing;
      bearing.camera = static_cast<int>(k);
      bearing.object = ObjectClass::ball;
      bearing.azimuth = std::atan2(seen->y(), seen->x());
      bearing.elevation = std::asin(seen->z());
      bearing.covariance = Vector2d(variance(noise_.azimuth_deg), variance(noise_.elevation_deg)).asDiagonal();
      sighting.bearings.push_back(bearing);
    }
  }

  // Edges at the horizon, within the goal's height.
  void see_goals(const Pose2& world_from_robot, const Field& field, calibration::Sighting& sighting) {
    for (const ObjectClass goal : {ObjectClass::yellow_goal, ObjectClass::blue_goal}) {
      for (std::size_t k = 0; k < true_rig_.cameras.size(); ++k) {
        const omni::Camera& camera = true_rig_.cameras[k];
        const Vector2d viewpoint = world_from_robot * Vector2d(camera.position.head<2>());
        const localization::Silhouette silhouette = localization::goal_silhouette(field, goal, viewpoint);
        const auto edge = [&](double azimuth) {
          const double azimuth_in_robot = azimuth - world_from_robot.beta + normal(random_, radians(noise_.edge_deg));
          const Vector3d seen = mistaken(camera, believed_.cameras[k], ray(azimuth_in_robot, 0.0)).value();
          return std::atan2(seen.y(), seen.x());
        };
        Bearing bearing;
        bearing.camera = static_cast<int>(k);
        bearing.object = goal;
        bearing.left = edge(silhouette.left);
        bearing.right = edge(silhouette.right);
        bearing.azimuth = wrap_angle(bearing.right + 0.5 * turn(bearing.right, bearing.left));
        bearing.left_variance = bearing.right_variance = variance(noise_.edge_deg);
        sighting.bearings.push_back(bearing);
      }
    }
  }

 private:
  omni::Rig true_rig_, believed_;
  Noise noise_;
  double elevation_bias_;
  RandomStream& random_;
};

// Balls on spirals around the robot, 0.7 … 4 m away: near and far in every direction.
inline std::vector<Vector3d> spiral(int count) {
  std::vector<Vector3d> balls;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 2.4 * i;  // the golden angle
    const double distance = 0.7 + 3.3 * std::fmod(0.618 * i, 1.0);
    balls.emplace_back(distance * std::cos(azimuth), distance * std::sin(azimuth), 0.11);
  }
  return balls;
}

inline calibration::Sightings see_balls(const omni::Rig& true_rig, const omni::Rig& believed,
                                        const std::vector<Vector3d>& balls, const Noise& noise, double elevation_bias,
                                        RandomStream& random) {
  Observer observer(true_rig, believed, noise, elevation_bias, random);
  calibration::Sightings sightings{believed, {}};
  for (const Vector3d& ball : balls) {
    calibration::Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(sightings.frames.size());
    sighting.ball_in_robot = ball;
    observer.see_ball(ball, sighting);
    sightings.frames.push_back(std::move(sighting));
  }
  return sightings;
}

inline calibration::Sightings exact_sightings(const omni::Rig& true_rig, int balls = 24) {
  RandomStream random = make_stream(1, 1);
  return see_balls(true_rig, drawn_rig(), spiral(balls), {}, 0.0, random);
}

// Floors that nothing was added for are left out, and places are exact.
inline calibration::RigOptions without_floors() {
  calibration::RigOptions options;
  options.azimuth_floor_deg = options.elevation_floor_deg = options.edge_floor_deg = options.place_sigma = 0.0;
  return options;
}

// Of every deviation, in its stated sigmas, squared; the mean.
inline double normalized_square(const calibration::RigCalibration& result,
                                const std::vector<omni::Deviation>& true_ones) {
  double sum = 0.0;
  for (std::size_t k = 0; k < true_ones.size(); ++k) {
    sum += (result.deviation[k] - true_ones[k]).cwiseQuotient(result.sigma[k]).squaredNorm();
  }
  return sum / static_cast<double>(omni::kDeviations * true_ones.size());
}

inline std::vector<omni::Deviation> draw_deviations(std::size_t cameras, RandomStream& random) {
  std::vector<omni::Deviation> deviations(cameras);
  for (omni::Deviation& deviation : deviations) {
    for (int i = 0; i < omni::kDeviations; ++i) deviation[i] = normal(random, omni::individual_differences()[i]);
  }
  return deviations;
}

inline omni::Rig deviated(omni::Rig rig, const std::vector<omni::Deviation>& deviations) {
  for (std::size_t k = 0; k < rig.cameras.size(); ++k) rig.cameras[k] = omni::deviated(rig.cameras[k], deviations[k]);
  return rig;
}

}  // namespace movis::test
