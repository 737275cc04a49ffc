// One camera and a ball on the floor, by its centre's elevation and by its ground contact.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "movis/triangulation/single.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

omni::Camera camera_over(const Vector2d& position) {
  omni::Camera camera = camera_at(position, 0.0);
  camera.name = "S1";
  return camera;
}

// Centre and cone of a ball at a place, with the stated standard deviations.
Bearing ball_at(const omni::Camera& camera, const Vector2d& place, double sigma = 1e-4) {
  const Vector3d offset = Vector3d(place.x(), place.y(), kBall) - camera.position;
  Bearing bearing;
  bearing.camera = 0;
  bearing.azimuth = azimuth_of(offset.head<2>());
  bearing.elevation = std::atan2(offset.z(), offset.head<2>().norm());
  bearing.radius = std::asin(kBall / offset.norm());
  bearing.covariance = sigma * sigma * Eigen::Matrix2d::Identity();
  bearing.radius_variance = sigma * sigma;
  return bearing;
}

// By hand: 0.14 m above the ball's centre and 45° down, the ball is 0.14 m away. An elevation's error of ε moves it by
// (h − R)/sin² 45° ε = 0.28 ε, an azimuth's by 0.14 ε.
TEST(RangeByElevation, FortyFiveDegreesDown) {
  Bearing bearing;
  bearing.azimuth = radians(90.0);
  bearing.elevation = radians(-45.0);
  bearing.covariance << 1e-6, 0.0, 0.0, 4e-6;
  const PointEstimate ball = range_by_elevation(camera_over({0.0, 0.0}), bearing);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_TRUE(ball.on_floor);
  EXPECT_LT((ball.point - Vector3d(0.0, 0.14, 0.11)).norm(), 1e-12);
  EXPECT_NEAR(ball.covariance(0, 0), 0.14 * 0.14 * 1e-6, 1e-15);
  EXPECT_NEAR(ball.covariance(1, 1), 0.28 * 0.28 * 4e-6, 1e-15);
  EXPECT_EQ(ball.covariance.row(2).norm(), 0.0);
}

// By hand: a line 60° below the horizon from 0.25 m meets the floor 0.25/tan 60° = 0.25/√3 away. Floor and line enclose
// 120° on the ball's side, so it touches the floor R/tan 60° = 0.11/√3 further: 0.36/√3 in all.
TEST(RangeByContact, SixtyDegreesDown) {
  Bearing bearing;
  bearing.elevation = radians(-40.0);
  bearing.radius = radians(20.0);
  const PointEstimate ball = range_by_contact(camera_over({0.0, 0.0}), bearing);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_LT((ball.point - Vector3d(0.36 / std::sqrt(3.0), 0.0, 0.11)).norm(), 1e-12);
}

TEST(Single, FindsBallsAllOver) {
  const omni::Camera camera = camera_over({0.03, -0.05});
  for (double azimuth_deg = -175.0; azimuth_deg < 180.0; azimuth_deg += 10.0) {
    for (const double range : {0.3, 1.0, 3.0, 6.0}) {
      const Vector2d place = range * direction(radians(azimuth_deg));
      const Bearing bearing = ball_at(camera, place);
      EXPECT_LT((range_by_elevation(camera, bearing).point.head<2>() - place).norm(), 1e-9);
      EXPECT_LT((range_by_contact(camera, bearing).point.head<2>() - place).norm(), 1e-9);
    }
  }
}

TEST(Single, HorizonAndAbove) {
  const omni::Camera camera = camera_over({0.0, 0.0});
  Bearing bearing;
  bearing.radius = radians(0.5);
  for (const double elevation_deg : {-0.19, 0.0, 10.0}) {
    bearing.elevation = radians(elevation_deg);
    EXPECT_EQ(range_by_elevation(camera, bearing).status, PointStatus::parallel_rays) << elevation_deg;
  }
  bearing.elevation = radians(-0.25);
  EXPECT_EQ(range_by_elevation(camera, bearing).status, PointStatus::ok);
  bearing.elevation = radians(0.4);  // its lowest ray is 0.1° down
  EXPECT_EQ(range_by_contact(camera, bearing).status, PointStatus::parallel_rays);
  bearing.elevation = radians(0.2);
  EXPECT_EQ(range_by_contact(camera, bearing).status, PointStatus::ok);
}

TEST(RangeByContact, RadiusNotMeasured) {
  Bearing bearing;
  bearing.elevation = radians(-5.0);
  EXPECT_EQ(range_by_contact(camera_over({0.0, 0.0}), bearing).status, PointStatus::one_camera);
}

TEST(Single, CameraNoHigherThanTheBall) {
  omni::Camera camera = camera_over({0.0, 0.0});
  camera.position.z() = 0.11;
  test::expect_error([&] { range_by_elevation(camera, {}); }, {"S1", "0.11", "raise it"});
  test::expect_error([&] { range_by_contact(camera, {}); }, {"S1", "raise it"});
}

TEST(Single, OptionsAreReadStrictly) {
  const test::TemporaryFolder folder;
  const auto good = folder.write("good.yaml", "ball_radius: 0.1\n");
  EXPECT_EQ(read_single_options(YamlMap::read(good)).ball_radius, 0.1);
  const auto bad = folder.write("bad.yaml", "ball_radus: 0.1\n");
  test::expect_error([&] { read_single_options(YamlMap::read(bad)); }, {"bad.yaml:1", "ball_radus"});
}

// One draw of (azimuth, elevation, radius) with correlations, by its Cholesky factor.
Eigen::Matrix3d cholesky_factor() {
  Eigen::Matrix3d factor;
  factor << 1.0, 0.0, 0.0, 0.4, 0.9, 0.0, -0.3, 0.5, 0.7;
  return radians(0.01) * factor;
}

// The mean normalized square of the position error on the floor, over its two degrees of freedom.
double nees(PointEstimate (*measure)(const omni::Camera&, const Bearing&, const SingleOptions&), std::uint64_t seed) {
  const omni::Camera camera = camera_over({0.0, 0.0});
  const Eigen::Matrix3d factor = cholesky_factor();
  const Eigen::Matrix3d covariance = factor * factor.transpose();
  RandomStream stream = make_stream(seed, 1);
  constexpr int kDraws = 20000;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Vector2d place = uniform(stream, 0.5, 4.0) * direction(uniform(stream, -kPi, kPi));
    Bearing bearing = ball_at(camera, place);
    const Vector3d noise = factor * Vector3d(normal(stream, 1.0), normal(stream, 1.0), normal(stream, 1.0));
    bearing.azimuth += noise[0];
    bearing.elevation += noise[1];
    bearing.radius += noise[2];
    bearing.covariance = covariance.topLeftCorner<2, 2>();
    bearing.radius_variance = covariance(2, 2);
    bearing.radius_covariance = covariance.col(2).head<2>();
    const PointEstimate ball = measure(camera, bearing, {});
    const Vector2d error = ball.point.head<2>() - place;
    sum += error.dot(ball.covariance.topLeftCorner<2, 2>().inverse() * error) / 2.0;
  }
  return sum / kDraws;
}

// χ² of 40000 degrees of freedom: its mean of 1 is known to 0.7 %, so 3 % are four standard deviations.
TEST(Single, CovarianceIsConsistent) {
  EXPECT_NEAR(nees(range_by_elevation, 1), 1.0, 0.03);
  EXPECT_NEAR(nees(range_by_contact, 2), 1.0, 0.03);
}

}  // namespace
}  // namespace movis::triangulation
