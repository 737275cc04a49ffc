#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/random.h"
#include "movis/triangulation/obstacles.h"
#include "movis_rig.h"

namespace movis::triangulation {
namespace {

// What a camera sees of a round body, by its tangents.
ObstacleSight sight_of(const omni::Rig& rig, int camera, const Vector2d& axis, double radius, double sigma = 0.02) {
  const Vector2d offset = axis - rig.cameras[camera].position.head<2>();
  const double middle = std::atan2(offset.y(), offset.x());
  const double half = std::asin(radius / offset.norm());
  return {camera, wrap_angle(middle + half), wrap_angle(middle - half), offset.norm() - radius, sigma};
}

std::vector<Obstacle> merge(const omni::Rig& rig, const std::vector<ObstacleSight>& sights) {
  std::vector<Obstacle> obstacles;
  merge_obstacles(rig, sights, ObstacleOptions{}, obstacles);
  return obstacles;
}

// By hand: one camera over the origin sees a foot 0.8 m ahead under 90° ± 11.537°, sin 11.537° = 0.2. So
// R = 0.8 · 0.2/0.8 = 0.2, the axis is 1.0 m away, the foot at (0, 0.8).
TEST(Obstacles, OneSight) {
  omni::Rig rig;
  rig.cameras.resize(1);
  rig.cameras[0].position = {0.0, 0.0, 0.25};
  const double half = std::asin(0.2);
  const auto obstacles = merge(rig, {{0, 0.5 * kPi + half, 0.5 * kPi - half, 0.8, 0.02}});
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_NEAR(obstacles[0].azimuth, 0.5 * kPi, 1e-12);
  EXPECT_NEAR(obstacles[0].distance, 0.8, 1e-12);
  EXPECT_NEAR(obstacles[0].width, 0.4, 1e-12);
  EXPECT_NEAR(obstacles[0].foot.x(), 0.0, 1e-12);
  EXPECT_NEAR(obstacles[0].foot.y(), 0.8, 1e-12);
  EXPECT_EQ(obstacles[0].cameras, 1);
  // Along: 0.02² + 0.01². Across: (1.0 m · 0.4°)²/2.
  EXPECT_NEAR(obstacles[0].covariance(1, 1), 5e-4, 1e-12);
  EXPECT_NEAR(obstacles[0].covariance(0, 0), 0.5 * std::pow(radians(0.4), 2), 1e-12);
}

TEST(Obstacles, Roundtrip) {
  const omni::Rig rig = paper_rig();
  const Vector2d axis(-1.1, 0.7);
  std::vector<ObstacleSight> sights;
  for (int camera = 0; camera < 3; ++camera) sights.push_back(sight_of(rig, camera, axis, 0.22));
  const auto obstacles = merge(rig, sights);
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_EQ(obstacles[0].cameras, 3);
  EXPECT_NEAR(obstacles[0].distance, axis.norm() - 0.22, 1e-9);
  EXPECT_NEAR(obstacles[0].azimuth, std::atan2(axis.y(), axis.x()), 1e-9);
  EXPECT_NEAR(obstacles[0].width, 0.44, 1e-9);
}

// Errors as the options say, the distance's common to all cameras: two degrees of freedom.
TEST(Obstacles, Consistency) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(11, 1);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 2000;
  constexpr double kSigma = 0.03;
  const double azimuth_sigma = radians(ObstacleOptions{}.azimuth_sigma_deg);
  const double distance_sigma = std::hypot(kSigma, ObstacleOptions{}.distance_sigma);
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double azimuth = kPi * std::cos(draw);
    const Vector2d axis = 1.4 * Vector2d(std::cos(azimuth), std::sin(azimuth));
    std::vector<ObstacleSight> sights;
    const double common = distance_sigma * normal(stream);
    for (int camera = 0; camera < 3; ++camera) {
      ObstacleSight sight = sight_of(rig, camera, axis, 0.2, kSigma);
      sight.left += azimuth_sigma * normal(stream);
      sight.right += azimuth_sigma * normal(stream);
      sight.distance += common;
      sights.push_back(sight);
    }
    const auto obstacles = merge(rig, sights);
    ASSERT_EQ(obstacles.size(), 1U);
    const Vector2d error = obstacles[0].foot - axis * (1.2 / 1.4);
    sum += error.dot(obstacles[0].covariance.inverse() * error);
  }
  // The azimuths' errors average over three cameras, which the best sight's covariance does not claim: below 2.
  EXPECT_GT(sum / kDraws, 0.8);
  EXPECT_LT(sum / kDraws, 2.2);
}

TEST(Obstacles, TwoBodiesSideBySide) {
  const omni::Rig rig = paper_rig();
  std::vector<ObstacleSight> sights;
  for (int camera = 0; camera < 3; ++camera) {
    sights.push_back(sight_of(rig, camera, {-0.45, 1.2}, 0.2));
    sights.push_back(sight_of(rig, camera, {0.45, 1.2}, 0.2));
  }
  EXPECT_EQ(merge(rig, sights).size(), 2U);
}

TEST(Obstacles, NoSight) {
  EXPECT_TRUE(merge(paper_rig(), {}).empty());
}

TEST(Obstacles, AllAround) {
  const auto obstacles = merge(paper_rig(), {{0, kPi, -kPi + 0.1, 0.02, 0.001}});
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_TRUE(obstacles[0].foot.allFinite());
  EXPECT_TRUE(obstacles[0].covariance.allFinite());
}

TEST(Obstacles, MoreThanThereIsRoomFor) {
  const omni::Rig rig = paper_rig();
  std::vector<ObstacleSight> sights;
  for (int i = 0; i < 100; ++i) {
    sights.push_back(sight_of(rig, 0, {3.0 * std::cos(0.3 * i), (1.0 + 0.1 * i) * std::sin(0.3 * i)}, 0.05, 0.001));
  }
  EXPECT_LE(merge(rig, sights).size(), static_cast<std::size_t>(kMostObstacles));
}

TEST(Obstacles, UnknownCamera) {
  EXPECT_THROW(merge(paper_rig(), {{7, 1.0, 0.9, 1.0, 0.02}}), Error);
}

TEST(Obstacles, MoreCamerasThanAreCounted) {
  omni::Rig rig;
  rig.cameras.resize(32);
  const auto obstacles = merge(rig, {{31, 1.0, 0.9, 1.0, 0.02}, {0, 1.0, 0.9, 1.0, 0.02}});
  ASSERT_EQ(obstacles.size(), 1U);
  EXPECT_EQ(obstacles[0].cameras, 2);
  rig.cameras.resize(33);
  EXPECT_THROW(merge(rig, {{32, 1.0, 0.9, 1.0, 0.02}}), Error);
}

Bearing goal(int camera, double left, double right) {
  Bearing bearing;
  bearing.camera = camera;
  bearing.object = ObjectClass::yellow_goal;
  bearing.left = left;
  bearing.right = right;
  bearing.left_variance = bearing.right_variance = 1e-6;
  return bearing;
}

// The goal is seen from 1.2 to 1.8: a hidden edge has the variance 0.3² = 0.09.
TEST(CoveredEdges, WithinAndAtTheBorder) {
  for (const auto& [left, right] : {std::pair{1.9, 1.7}, {1.795, 1.6}}) {
    std::vector<Bearing> bearings{goal(1, 1.8, 1.2)};
    hide_covered_edges({{1, left, right, 1.0, 0.02}}, bearings);
    EXPECT_NEAR(bearings[0].left_variance, 0.09, 1e-12);
    EXPECT_EQ(bearings[0].right_variance, 1e-6);
    EXPECT_EQ(bearings[0].left_flags, kCutByObject);
    EXPECT_EQ(bearings[0].right_flags, 0);
    EXPECT_EQ(bearings[0].flags, kCutByObject);
  }
}

// What the scan flagged stays.
TEST(CoveredEdges, FlagsAddUp) {
  std::vector<Bearing> bearings{goal(1, 1.8, 1.2)};
  bearings[0].left_flags = kNearSensor;
  bearings[0].flags = kNearSensor | kCutByBody;
  hide_covered_edges({{1, 1.3, 1.1, 1.0, 0.02}}, bearings);
  EXPECT_EQ(bearings[0].left_flags, kNearSensor);
  EXPECT_EQ(bearings[0].right_flags, kCutByObject);
  EXPECT_EQ(bearings[0].flags, kNearSensor | kCutByBody | kCutByObject);
}

TEST(CoveredEdges, NotByOthers) {
  std::vector<Bearing> bearings{goal(1, 1.8, 1.2)};
  hide_covered_edges({{0, 1.9, 1.7, 1.0, 0.02}, {1, 1.6, 1.4, 1.0, 0.02}, {1, 2.2, 1.9, 1.0, 0.02}}, bearings);
  EXPECT_EQ(bearings[0].left_variance, 1e-6);
  EXPECT_EQ(bearings[0].flags | bearings[0].left_flags | bearings[0].right_flags, 0);
}

TEST(CoveredEdges, AcrossTheBackAndNoBall) {
  std::vector<Bearing> bearings{goal(0, -3.0, 3.0), goal(0, -3.0, 3.0)};
  bearings[1].object = ObjectClass::ball;
  hide_covered_edges({{0, -3.1, 2.9, 1.0, 0.02}}, bearings);
  EXPECT_GT(bearings[0].right_variance, 0.01);
  EXPECT_EQ(bearings[0].left_variance, 1e-6);
  EXPECT_EQ(bearings[1].flags, 0);
}

}  // namespace
}  // namespace movis::triangulation
