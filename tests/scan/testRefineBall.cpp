// The direction of a ball, against balls that were rendered at a known place.
#include <gtest/gtest.h>

#include "eye.h"

namespace movis::scan {
namespace {

class EveryCamera : public testing::TestWithParam<CameraCase> {};

INSTANTIATE_TEST_SUITE_P(RefineBall, EveryCamera, testing::ValuesIn(camera_cases()),
                         [](const auto& camera) { return std::string(camera.param.label); });

struct Errors {
  double azimuth_deg = 0.0, elevation_deg = 0.0, radius_deg = 0.0;  // largest
  int balls = 0;
};

void add_error(const omni::Camera& camera, const Ball& ball, const Bearing& bearing, Errors& errors) {
  const double azimuth = turn(azimuth_from(camera, ball.centre.head<2>()), bearing.azimuth);
  const double elevation = bearing.elevation - elevation_from(camera, ball.centre);
  errors.azimuth_deg = std::max(errors.azimuth_deg, degrees(std::abs(azimuth)));
  errors.elevation_deg = std::max(errors.elevation_deg, degrees(std::abs(elevation)));
  // The cone under which a sphere is seen touches it: sin γ = radius / distance.
  const double radius = std::asin(ball.radius / (ball.centre - camera.position).norm());
  errors.radius_deg = std::max(errors.radius_deg, degrees(std::abs(bearing.radius - radius)));
  ++errors.balls;
}

TEST_P(EveryCamera, SeesTheCentreOfABall) {
  Eye eye(GetParam().camera);
  for (const double range : {0.4, 0.6, 1.0, 2.0, 3.0, 4.0}) {
    Errors errors;
    for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 41.2) {
      const Ball ball = ball_at(eye.camera(), radians(azimuth_deg), range);
      const auto bearing = eye.find(ObjectClass::ball, eye.render({{ball}, {}}));
      ASSERT_TRUE(bearing) << azimuth_deg << "° " << range << " m";
      EXPECT_EQ(bearing->flags, 0) << azimuth_deg << "° " << range << " m";
      // Seen from above, the ball's tangents stand asin(r/range) to both sides. Mixed border pixels widen it by less
      // than half a pixel.
      const double half_width = std::asin(ball.radius / range);
      EXPECT_NEAR(turn(bearing->azimuth, bearing->left), half_width, radians(0.15));
      EXPECT_NEAR(turn(bearing->right, bearing->azimuth), half_width, radians(0.15));
      add_error(eye.camera(), ball, *bearing, errors);
    }
    // Measured: at most 0.006°, 0.005° and 0.008°.
    EXPECT_LT(errors.azimuth_deg, 0.01) << range << " m";
    EXPECT_LT(errors.elevation_deg, 0.01) << range << " m";
    EXPECT_LT(errors.radius_deg, 0.02) << range << " m";
  }
}

// A black rectangle, as high as the camera and more, hides everything from `edge` on to the left.
Wall black_to_the_left_of(const omni::Camera& camera, double edge) {
  return {floor_point(camera, edge, 0.15), floor_point(camera, edge + 0.7, 0.15), 0.0, 0.35, kBlack};
}

// Half of the ball is behind something black: the direction is that of the whole ball, from the rest of its outline.
TEST_P(EveryCamera, SeesTheCentreOfAHalfHiddenBall) {
  Eye eye(GetParam().camera);
  for (const double range : {0.4, 0.8, 1.5}) {
    Errors errors;
    for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 41.2) {
      const Ball ball = ball_at(eye.camera(), radians(azimuth_deg), range);
      const Wall body = black_to_the_left_of(eye.camera(), radians(azimuth_deg));
      const auto bearing = eye.find(ObjectClass::ball, eye.render({{ball}, {body}}));
      ASSERT_TRUE(bearing) << azimuth_deg << "° " << range << " m";
      EXPECT_TRUE(bearing->flags & kCutByBody) << azimuth_deg << "° " << range << " m";
      add_error(eye.camera(), ball, *bearing, errors);
    }
    // Measured: at most 0.041°, 0.007° and 0.028°.
    EXPECT_LT(errors.azimuth_deg, 0.08) << range << " m";
    EXPECT_LT(errors.elevation_deg, 0.03) << range << " m";
    EXPECT_LT(errors.radius_deg, 0.06) << range << " m";
  }
}

// The end of a wall stands behind the ball's centre: its two sides have different surroundings.
TEST_P(EveryCamera, SurroundingsHardlyMoveABall) {
  Eye eye(GetParam().camera);
  for (const Light3& colour : {light(240, 240, 240), light(40, 110, 50), kBlue}) {
    Errors errors;
    for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 61.4) {
      const double azimuth = radians(azimuth_deg);
      const Ball ball = ball_at(eye.camera(), azimuth, 1.5);
      const Wall wall{floor_point(eye.camera(), azimuth, 2.0), floor_point(eye.camera(), azimuth + 0.5, 2.0), 0.0, 0.8,
                      colour};
      const auto bearing = eye.find(ObjectClass::ball, eye.render({{ball}, {wall}}));
      ASSERT_TRUE(bearing) << azimuth_deg;
      add_error(eye.camera(), ball, *bearing, errors);
    }
    // Measured: at most 0.005°, 0.003° and 0.004°.
    EXPECT_LT(errors.azimuth_deg, 0.015) << colour.transpose();
    EXPECT_LT(errors.elevation_deg, 0.015) << colour.transpose();
  }
}

struct Nees {
  double azimuth = 0.0, elevation = 0.0;
};

// Balls anywhere from 0.5 m to 4 m, with the camera's noise: the mean of squared errors over stated variances. With
// `hidden`, a share of the ball's width is behind something black.
Nees mean_nees(Eye& eye, int balls, std::uint64_t seed, bool hidden) {
  RandomStream stream = make_stream(seed, 1);
  const auto uniform = [&](double min, double max) { return std::uniform_real_distribution<double>(min, max)(stream); };
  Nees sum;
  for (int i = 0; i < balls; ++i) {
    const double azimuth = uniform(-kPi, kPi);
    const double range = uniform(0.5, hidden ? 2.0 : 4.0);
    Scene scene;
    scene.balls = {ball_at(eye.camera(), azimuth, range)};
    const double edge = azimuth + uniform(-0.3, 0.5) * std::asin(0.11 / range);
    if (hidden) scene.walls = {black_to_the_left_of(eye.camera(), edge)};
    Picture picture = eye.render(scene);
    add_noise(picture, 2.0, stream);
    const auto bearing = eye.find(ObjectClass::ball, picture);
    EXPECT_TRUE(bearing) << azimuth << " " << range;
    if (!bearing) continue;
    const double azimuth_error = turn(azimuth, bearing->azimuth);
    const double elevation_error = bearing->elevation - elevation_from(eye.camera(), scene.balls[0].centre);
    sum.azimuth += azimuth_error * azimuth_error / bearing->covariance(0, 0) / balls;
    sum.elevation += elevation_error * elevation_error / bearing->covariance(1, 1) / balls;
  }
  return sum;
}

// Measured: 0.15 and 0.04. In this world of flat colours the errors of brightness that the covariance allows for are
// not there; on the ray tracer's images the same is 0.8 to 0.9 and 1.4 (docs/accuracy.md).
TEST(RefineBallCovariance, IsConsistent) {
  Eye hyperboloid(tilted(hyperboloid_camera()));
  Eye unified(tilted(unified_camera()));
  const Nees one = mean_nees(hyperboloid, 110, 1, false);
  const Nees two = mean_nees(unified, 110, 2, false);
  const Nees nees{0.5 * (one.azimuth + two.azimuth), 0.5 * (one.elevation + two.elevation)};
  EXPECT_GT(nees.azimuth, 0.05);
  EXPECT_LT(nees.azimuth, 0.6);
  EXPECT_GT(nees.elevation, 0.01);
  EXPECT_LT(nees.elevation, 0.2);
}

// Measured: 1.8 and 0.08.
TEST(RefineBallCovariance, IsConsistentForHiddenBalls) {
  Eye eye(tilted(hyperboloid_camera()));
  const Nees nees = mean_nees(eye, 120, 3, true);
  EXPECT_GT(nees.azimuth, 0.2);
  EXPECT_LT(nees.azimuth, 4.0);
  EXPECT_GT(nees.elevation, 0.02);
  EXPECT_LT(nees.elevation, 0.5);
}

// A ball of three pixels is too little.
TEST(RefineBall, TooFarToBeMeasured) {
  Eye eye(hyperboloid_camera());
  EXPECT_TRUE(eye.find(ObjectClass::ball, eye.render({{ball_at(eye.camera(), 1.0, 6.0)}, {}})));
  EXPECT_FALSE(eye.find(ObjectClass::ball, eye.render({{ball_at(eye.camera(), 1.0, 40.0)}, {}})));
}

// The scan ends in the middle of a ball: its bearing says so and is still that of the whole ball.
TEST(RefineBall, CutByTheDomain) {
  ScanOptions options;
  options.max_elevation_deg = -8.0;  // the ball's centre, (0.25 − 0.11) m below the camera at 1 m
  Eye eye(hyperboloid_camera(), options);
  Errors errors;
  for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 41.2) {
    const Ball ball = ball_at(eye.camera(), radians(azimuth_deg), 1.0);
    const auto bearing = eye.find(ObjectClass::ball, eye.render({{ball}, {}}));
    ASSERT_TRUE(bearing);
    EXPECT_EQ(bearing->flags, kCutByDomain);
    add_error(eye.camera(), ball, *bearing, errors);
  }
  // Measured: 0.005° and 0.012°.
  EXPECT_LT(errors.azimuth_deg, 0.02);
  EXPECT_LT(errors.elevation_deg, 0.03);
}

}  // namespace
}  // namespace movis::scan
