#include <gtest/gtest.h>

#include <cmath>

#include "eye.h"
#include "floor_picture.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/sim/renderer.h"
#include "support/shared_data.h"

namespace movis::scan {
namespace {

const Light3 kHull = light(44, 44, 44);

std::vector<ObstacleSight> scan_obstacles(const omni::Rig& rig, int camera, const ImageView& image) {
  Scanner scanner(rig, camera, read_colours(data_file("colours/default.yaml")), ScanOptions{});
  std::vector<LinePoint> lines;
  std::vector<ObstacleSight> obstacles;
  scanner.scan_floor(image, lines, obstacles);
  return obstacles;
}

std::vector<ObstacleSight> scan_obstacles(const omni::Camera& camera, const Picture& picture) {
  omni::Rig rig;
  rig.cameras.push_back(camera);
  return scan_obstacles(rig, 0, picture.view);
}

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

// By hand: an axis 1.2 m ahead, radius 0.2 m: the nearest point of the foot is 1.0 m away, the tangents lie
// asin(0.2/1.2) = 9.594° to both sides of 90°.
TEST(ObstacleScan, RoundBody) {
  const omni::Camera camera = hyperboloid_camera();
  const auto sights = scan_obstacles(camera, paint_floor(camera, body_at(camera, {0.0, 1.2}, 0.2)));
  ASSERT_EQ(sights.size(), 1U);
  EXPECT_NEAR(sights[0].distance, 1.0, 0.02);
  EXPECT_NEAR(degrees(sights[0].left), 99.594, 1.1);
  EXPECT_NEAR(degrees(sights[0].right), 80.406, 1.1);
  EXPECT_GT(sights[0].sigma, 0.0);
}

class ObstacleScanOfCameras : public testing::TestWithParam<CameraCase> {};

TEST_P(ObstacleScanOfCameras, Roundtrip) {
  const omni::Camera camera = GetParam().camera;
  for (const double range : {0.6, 1.1, 2.0, 3.0}) {
    const double azimuth = 3.0 * range;  // all around, also across ±π
    const Vector2d axis = floor_point(camera, azimuth, range);
    const auto sights = scan_obstacles(camera, paint_floor(camera, body_at(camera, axis, 0.22)));
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
  const omni::Camera camera = hyperboloid_camera();
  RandomStream stream = make_stream(5, 1);
  std::uniform_real_distribution<double> range(0.7, 2.6);
  std::uniform_real_distribution<double> azimuth(-kPi, kPi);
  constexpr int kDraws = 12;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const double distance = range(stream);
    const Vector2d axis = floor_point(camera, azimuth(stream), distance);
    Picture picture = paint_floor(camera, body_at(camera, axis, 0.2));
    add_noise(picture, 2.0, stream);
    const auto sights = scan_obstacles(camera, picture);
    ASSERT_EQ(sights.size(), 1U) << distance;
    sum += std::pow((sights[0].distance - (distance - 0.2)) / sights[0].sigma, 2);
  }
  EXPECT_LT(sum / kDraws, 2.0);
  EXPECT_GT(sum / kDraws, 0.005);
}

TEST(ObstacleScan, BareFloor) {
  const omni::Camera camera = hyperboloid_camera();
  EXPECT_TRUE(scan_obstacles(camera, paint_floor(camera, [](const Vector2d&) { return kCarpet; })).empty());
}

TEST(ObstacleScan, NoCarpet) {
  const omni::Camera camera = hyperboloid_camera();
  const Paint on_grey = [](const Vector2d& point) { return point.y() > 1.0 ? kHull : kGrey; };
  EXPECT_TRUE(scan_obstacles(camera, paint_floor(camera, on_grey)).empty());
}

// The own body: dark from below, then carpet all around.
TEST(ObstacleScan, OwnBody) {
  const omni::Camera camera = hyperboloid_camera();
  const Paint paint = [](const Vector2d& point) { return point.norm() < 0.3 ? kHull : kCarpet; };
  EXPECT_TRUE(scan_obstacles(camera, paint_floor(camera, paint)).empty());
}

TEST(ObstacleScan, WhatIsNotDark) {
  const omni::Camera camera = hyperboloid_camera();
  for (const Light3& colour : {kOrange, kYellow, kBlue, kWhite, kGrey}) {
    const Picture picture = paint_floor(camera, body_at(camera, {0.0, 1.2}, 0.2, colour));
    EXPECT_TRUE(scan_obstacles(camera, picture).empty()) << colour.transpose();
  }
}

// Carpet with an eighth of the light is dark, but green.
TEST(ObstacleScan, DeepShadow) {
  const omni::Camera camera = hyperboloid_camera();
  const Picture picture = paint_floor(camera, body_at(camera, {0.0, 1.2}, 0.2, Light3(0.125 * kCarpet)));
  EXPECT_TRUE(scan_obstacles(camera, picture).empty());
}

TEST(ObstacleScan, Narrow) {
  const omni::Camera camera = hyperboloid_camera();
  EXPECT_TRUE(scan_obstacles(camera, paint_floor(camera, body_at(camera, {0.0, 1.2}, 0.01))).empty());
}

TEST(ObstacleScan, TwoBodies) {
  const omni::Camera camera = hyperboloid_camera();
  const Paint near = body_at(camera, {0.0, 1.0}, 0.2);
  const Paint far = body_at(camera, {0.5, 1.6}, 0.2);
  const Picture picture =
      paint_floor(camera, [&](const Vector2d& point) -> Light3 { return near(point).min(far(point)); });
  const auto sights = scan_obstacles(camera, picture);
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
    const omni::Rig& rig = source.dataset().rig;
    source.open();
    int left = 3;
    for (grab::FrameSet images; left > 0 && source.acquire(images); --left) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_TRUE(scan_obstacles(rig, k, images.frames[k].view).empty()) << set << " " << images.index << " " << k;
      }
    }
  }
}

}  // namespace
}  // namespace movis::scan
