#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "movis/calibration/correction_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/omni/deviation.h"

// Balls at known places as rigs with individual differences see them, by plain projection.
namespace movis::calibration {

using Eigen::Vector3d;

inline constexpr double kBall = 0.11;  // height of its centre, metres

inline omni::Rig nominal_rig() {
  return omni::read_rig(data_file("rigs/movis.yaml"));
}

inline omni::Rig built_rig(std::uint64_t seed) {
  RandomStream random = make_stream(seed, 1);
  return omni::draw_rig(nominal_rig(), omni::individual_differences(), random);
}

// What a detector gets wrong and what it says that it gets wrong, radians.
struct Noise {
  double azimuth = radians(0.01), elevation = radians(0.03);
  double stated_azimuth = radians(0.01), stated_elevation = radians(0.03);
};

// A ball as a rig built as `built` sees it, believed to be the nominal one.
inline Sighting see(const omni::Rig& built, const omni::Rig& believed, const Vector3d& ball, const Noise& noise,
                    RandomStream& random) {
  std::normal_distribution<double> normal;
  Sighting sighting;
  sighting.ball_in_robot = ball;
  for (int camera = 0; camera < static_cast<int>(built.cameras.size()); ++camera) {
    const auto pixel = project(built.cameras[camera], ball);
    const Vector3d ray = unproject(believed.cameras[camera], pixel.value()).value();
    Bearing bearing;
    bearing.camera = camera;
    bearing.azimuth = wrap_angle(std::atan2(ray.y(), ray.x()) + noise.azimuth * normal(random));
    bearing.elevation = std::atan2(ray.z(), ray.head<2>().norm()) + noise.elevation * normal(random);
    bearing.covariance(0, 0) = noise.stated_azimuth * noise.stated_azimuth;
    bearing.covariance(1, 1) = noise.stated_elevation * noise.stated_elevation;
    sighting.bearings.push_back(bearing);
  }
  return sighting;
}

inline Vector3d place(double distance, double azimuth) {
  return {distance * std::cos(azimuth), distance * std::sin(azimuth), kBall};
}

inline Sightings see_many(const omni::Rig& built, int count, std::uint64_t seed, const Noise& noise = {}) {
  RandomStream random = make_stream(seed, 2);
  std::uniform_real_distribution<double> along(-4.0, 4.0);
  Sightings sightings{nominal_rig(), {}};
  while (static_cast<int>(sightings.frames.size()) < count) {
    const Vector3d ball(along(random), along(random), kBall);
    if (ball.head<2>().norm() < 0.45) continue;
    sightings.frames.push_back(see(built, sightings.rig, ball, noise, random));
    sightings.frames.back().frame = 100 + static_cast<int>(sightings.frames.size());
  }
  return sightings;
}

// Places as a tape has them that errs by sigma in x and y, metres.
inline void add_slips(Sightings& sightings, double sigma, std::uint64_t seed) {
  RandomStream random = make_stream(seed, 7);
  std::normal_distribution<double> normal;
  for (Sighting& sighting : sightings.frames) {
    for (int i = 0; i < 2; ++i) (*sighting.ball_in_robot)[i] += sigma * normal(random);
  }
}

// Angles of corrected bearings, of elevations that the correction was fitted to, against the ball's true direction from
// the nominal viewpoints.
struct Left {
  double azimuth_rms = 0.0, elevation_rms = 0.0;
  double azimuth_normalized = 0.0, elevation_normalized = 0.0;  // mean of error² over stated variance
};

inline Left left_of(const triangulation::Correction& correction, const Sightings& sightings) {
  Left left;
  double count = 0.0;
  for (const Sighting& sighting : sightings.frames) {
    std::vector<Bearing> corrected = sighting.bearings;
    triangulation::correct(correction, corrected);
    for (std::size_t i = 0; i < corrected.size(); ++i) {
      const Bearing& bearing = corrected[i];
      const triangulation::CameraCorrection& camera = correction.cameras[bearing.camera];
      const double measured = sighting.bearings[i].elevation;
      if (measured < camera.min_elevation || measured > camera.max_elevation) continue;
      const Vector3d offset = *sighting.ball_in_robot - sightings.rig.cameras[bearing.camera].position;
      const double azimuth = turn(std::atan2(offset.y(), offset.x()), bearing.azimuth);
      const double elevation = bearing.elevation - std::atan2(offset.z(), offset.head<2>().norm());
      left.azimuth_rms += azimuth * azimuth;
      left.elevation_rms += elevation * elevation;
      left.azimuth_normalized += azimuth * azimuth / bearing.covariance(0, 0);
      left.elevation_normalized += elevation * elevation / bearing.covariance(1, 1);
      count += 1.0;
    }
  }
  left.azimuth_rms = std::sqrt(left.azimuth_rms / count);
  left.elevation_rms = std::sqrt(left.elevation_rms / count);
  left.azimuth_normalized /= count;
  left.elevation_normalized /= count;
  return left;
}

}  // namespace movis::calibration
