// What joint triangulation makes of corrected bearings: it uses elevations and radii beside the azimuths, and with a
// good correction they help.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "known_balls.h"
#include "movis/triangulation/joint.h"

namespace movis::calibration {
namespace {

constexpr double kAzimuthNoise = radians(0.004), kElevationNoise = radians(0.006), kRadiusNoise = radians(0.003);

Vector3d ray(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

double angle_between(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// As see() in known_balls.h, but by the rays of the ball's centre and of its cone, so that its radius is seen, too.
Sighting see_cone(const omni::Rig& built, const omni::Rig& believed, const Vector3d& ball, RandomStream& random) {
  std::normal_distribution<double> normal;
  Sighting sighting;
  sighting.ball_in_robot = ball;
  for (int camera = 0; camera < static_cast<int>(built.cameras.size()); ++camera) {
    const auto turned = [&](const Vector3d& direction) {
      const omni::Camera& there = built.cameras[camera];
      return unproject(believed.cameras[camera], project(there, there.position + direction).value()).value();
    };
    const Vector3d offset = ball - built.cameras[camera].position;
    const double azimuth = std::atan2(offset.y(), offset.x()) + kAzimuthNoise * normal(random);
    const double elevation = std::atan2(offset.z(), offset.head<2>().norm()) + kElevationNoise * normal(random);
    const double radius = std::asin(kBall / offset.norm()) + kRadiusNoise * normal(random);
    const Vector3d centre = turned(ray(azimuth, elevation));
    Bearing bearing;
    bearing.camera = camera;
    bearing.azimuth = std::atan2(centre.y(), centre.x());
    bearing.elevation = std::atan2(centre.z(), centre.head<2>().norm());
    bearing.covariance.diagonal() << kAzimuthNoise * kAzimuthNoise, kElevationNoise * kElevationNoise;
    const Vector3d left(-std::sin(azimuth), std::cos(azimuth), 0.0);
    for (const Vector3d& way :
         {left, Vector3d(-left), ray(azimuth, elevation + 0.5 * kPi), Vector3d(-ray(azimuth, elevation + 0.5 * kPi))}) {
      const Vector3d mantle = std::cos(radius) * ray(azimuth, elevation) + std::sin(radius) * way;
      bearing.radius += 0.25 * angle_between(centre, turned(mantle));
    }
    bearing.radius_variance = kRadiusNoise * kRadiusNoise;
    sighting.bearings.push_back(bearing);
  }
  return sighting;
}

Sightings see_cones(const omni::Rig& built, int count, RandomStream& random) {
  std::uniform_real_distribution<double> along(-4.0, 4.0);
  Sightings sightings{nominal_rig(), {}};
  while (static_cast<int>(sightings.frames.size()) < count) {
    const double x = along(random);
    const Vector3d ball(x, along(random), kBall);
    if (ball.head<2>().norm() < 0.45) continue;
    sightings.frames.push_back(see_cone(built, sightings.rig, ball, random));
    sightings.frames.back().frame = static_cast<std::int64_t>(sightings.frames.size());
  }
  return sightings;
}

struct Measured {
  double distance_error = 0.0, nees = 0.0;
};

void add(const PointEstimate& estimate, const Vector3d& ball, Measured& sum) {
  ASSERT_EQ(estimate.status, PointStatus::ok);
  const Eigen::Vector2d error = (estimate.point - ball).head<2>();
  sum.distance_error += std::abs(estimate.point.head<2>().norm() - ball.head<2>().norm());
  sum.nees += 0.5 * error.dot(estimate.covariance.topLeftCorner<2, 2>().inverse() * error);
}

// Jointly from all angles is not worse than from azimuths alone, and its covariance is honest: squared errors over
// their variances have mean 1 (x and y: halved).
TEST(CorrectionJoint, AllAnglesAreAsGoodAsAzimuthsAlone) {
  constexpr int kDraws = 10, kBalls = 80;
  Measured joint, azimuths;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const omni::Rig built = built_rig(seed);
    RandomStream random = make_stream(seed, 11);
    const triangulation::Correction correction = fit_correction(see_cones(built, 40, random)).correction;
    for (const Sighting& sighting : see_cones(built, kBalls, random).frames) {
      std::vector<Bearing> bearings = sighting.bearings;
      triangulation::correct(correction, bearings);
      add(triangulation::triangulate_joint(nominal_rig(), bearings, ObjectClass::ball), *sighting.ball_in_robot, joint);
      triangulation::JointOptions options;
      options.diameter = false;
      for (Bearing& bearing : bearings) {
        bearing.covariance(0, 1) = bearing.covariance(1, 0) = 0.0;
        bearing.covariance(1, 1) = 1e4;  // rad²: tells nothing
      }
      add(triangulation::triangulate_joint(nominal_rig(), bearings, ObjectClass::ball, options),
          *sighting.ball_in_robot, azimuths);
    }
  }
  EXPECT_LT(joint.distance_error, 1.1 * azimuths.distance_error);
  const double nees = joint.nees / (kDraws * kBalls);
  EXPECT_GT(nees, 0.6);
  EXPECT_LT(nees, 1.6);
}

}  // namespace
}  // namespace movis::calibration
