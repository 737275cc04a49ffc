#include <gtest/gtest.h>

#include <cmath>

#include "eye.h"
#include "floor_picture.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "support/shared_data.h"

namespace movis::scan {
namespace {

const Light3 kHull = light(44, 44, 44);

// A body so high that its picture on the floor is what a light in the camera would leave in shadow: from its foot
// outward, between the tangents.
Paint body_at(const omni::Camera& camera, const Vector2d& axis, double radius, const Light3& colour = kHull) {
  const Vector2d from = camera.position.head<2>();
  return [=](const Vector2d& point) -> Light3 {
    const Vector2d sight = (point - from).normalized();
    const double along = sight.dot(axis - from);
    const double beside = (axis - from).squaredNorm() - along * along;
    const bool hidden =
        along > 0.0 && beside < radius * radius && (point - from).norm() > along - std::sqrt(radius * radius - beside);
    return hidden ? colour : kCarpet;
  };
}

std::vector<ObstacleSight> obstacles_on(const Paint& paint) {
  return upright_eye().obstacles(upright_eye().paint(paint));
}

std::vector<ObstacleSight> obstacles_by_body(const Vector2d& axis, double radius, const Light3& colour = kHull) {
  return obstacles_on(body_at(upright_eye().camera(), axis, radius, colour));
}

// By hand: an axis 1.2 m ahead, radius 0.2 m: the nearest point of the foot is 1.0 m away, the tangents lie
// asin(0.2/1.2) = 9.594° to both sides of 90°.
TEST(ObstacleScan, RoundBody) {
  const auto sights = obstacles_by_body({0.0, 1.2}, 0.2);
  ASSERT_EQ(sights.size(), 1U);
  EXPECT_NEAR(sights[0].distance, 1.0, 0.02);
  EXPECT_NEAR(degrees(sights[0].left), 99.594, 1.1);
  EXPECT_NEAR(degrees(sights[0].right), 80.406, 1.1);
  EXPECT_GT(sights[0].sigma, 0.0);
}

class ObstacleScanOfCameras : public testing::TestWithParam<CameraCase> {};

TEST_P(ObstacleScanOfCameras, Roundtrip) {
  FloorEye eye(GetParam().camera);
  for (const double range : {0.6, 1.1, 2.0, 3.0}) {
    const double azimuth = 3.0 * range;  // all around, also across ±π
    const Vector2d axis = floor_point(eye.camera(), azimuth, range);
    const auto sights = eye.obstacles(eye.paint(body_at(eye.camera(), axis, 0.22)));
    ASSERT_EQ(sights.size(), 1U) << range;
    EXPECT_NEAR(sights[0].distance, range - 0.22, 0.01 + 2.5 * sights[0].sigma);
    const double half = std::asin(0.22 / range);
    EXPECT_NEAR(turn(azimuth + half, sights[0].left), 0.0, radians(1.1));
    EXPECT_NEAR(turn(azimuth - half, sights[0].right), 0.0, radians(1.1));
  }
}

INSTANTIATE_TEST_SUITE_P(All, ObstacleScanOfCameras, testing::ValuesIn(camera_cases()),
                         [](const auto& test) { return test.param.label; });

// Squared errors of the distance over their variances, at seeded places in noise. Half a pixel of sigma is for shadows
// at a foot, which are not here: their mean lies below 1.
TEST(ObstacleScan, Consistency) {
  FloorEye& eye = upright_eye();
  RandomStream stream = make_stream(5, 1);
  std::uniform_real_distribution<double> range(0.7, 2.6);
  std::uniform_real_distribution<double> azimuth(-kPi, kPi);
  constexpr int kDraws = 12;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double distance = range(stream);
    const Vector2d axis = floor_point(eye.camera(), azimuth(stream), distance);
    Picture picture = eye.paint(body_at(eye.camera(), axis, 0.2));
    add_noise(picture, 2.0, stream);
    const auto sights = eye.obstacles(picture);
    ASSERT_EQ(sights.size(), 1U) << distance;
    sum += std::pow((sights[0].distance - (distance - 0.2)) / sights[0].sigma, 2);
  }
  EXPECT_LT(sum / kDraws, 2.0);
  EXPECT_GT(sum / kDraws, 0.005);
}

TEST(ObstacleScan, BareFloor) {
  EXPECT_TRUE(obstacles_on([](const Vector2d&) { return kCarpet; }).empty());
}

TEST(ObstacleScan, NoCarpet) {
  const Paint on_grey = [](const Vector2d& point) { return point.y() > 1.0 ? kHull : kGrey; };
  EXPECT_TRUE(obstacles_on(on_grey).empty());
}

// The own body: dark from below, then carpet all around.
TEST(ObstacleScan, OwnBody) {
  const Paint paint = [](const Vector2d& point) { return point.norm() < 0.3 ? kHull : kCarpet; };
  EXPECT_TRUE(obstacles_on(paint).empty());
}

TEST(ObstacleScan, WhatIsNotDark) {
  for (const Light3& colour : {kOrange, kYellow, kBlue, kWhite, kGrey}) {
    EXPECT_TRUE(obstacles_by_body({0.0, 1.2}, 0.2, colour).empty()) << colour.transpose();
  }
}

// Carpet with an eighth of the light is dark, but green.
TEST(ObstacleScan, DeepShadow) {
  EXPECT_TRUE(obstacles_by_body({0.0, 1.2}, 0.2, Light3(0.125 * kCarpet)).empty());
}

TEST(ObstacleScan, Narrow) {
  EXPECT_TRUE(obstacles_by_body({0.0, 1.2}, 0.01).empty());
}

TEST(ObstacleScan, TwoBodies) {
  const omni::Camera& camera = upright_eye().camera();
  const Paint near = body_at(camera, {0.0, 1.0}, 0.2);
  const Paint far = body_at(camera, {0.5, 1.6}, 0.2);
  const auto sights = obstacles_on([&](const Vector2d& point) -> Light3 { return near(point).min(far(point)); });
  ASSERT_EQ(sights.size(), 2U);
  EXPECT_NEAR(sights[0].distance, std::hypot(0.5, 1.6) - 0.2, 0.1);
  EXPECT_NEAR(sights[1].distance, 0.8, 0.02);
}

// Ray-traced sets without opponents, with balls, goals, the own body and the other sensor units.
TEST(ObstacleScan, NoneInRayTracedSets) {
  for (const char* set : {"open", "near", "field"}) {
    const auto folder = test::shared_data() / "pov" / set;
    MOVIS_NEEDS_SHARED_DATA(folder);
    grab::DatasetSource source(grab::read_dataset(folder));
    std::vector<Scanner> scanners;
    for (int k = 0; k < 3; ++k) {
      scanners.emplace_back(source.dataset().rig, k, read_colours(data_file("colours/default.yaml")), ScanOptions{});
    }
    source.open();
    int left = 3;
    for (grab::FrameSet images; left > 0 && source.acquire(images); --left) {
      for (int k = 0; k < 3; ++k) {
        std::vector<LinePoint> lines;
        std::vector<ObstacleSight> obstacles;
        scanners[k].scan_floor(images.frames[k].view, lines, obstacles);
        EXPECT_TRUE(obstacles.empty()) << set << " " << images.index << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace movis::scan
