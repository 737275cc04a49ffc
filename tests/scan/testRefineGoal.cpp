// The edges of a goal, against upright rectangles that were rendered at a known place.
#include <gtest/gtest.h>

#include "eye.h"

namespace movis::scan {
namespace {

constexpr double kHalfWidth = 0.5;
constexpr double kHeight = 0.45;

// A goal's face before a camera; `skew` turns it about its middle, away from facing the camera.
struct Face {
  Vector2d left, right;

  Face(const omni::Camera& camera, double azimuth, double range, double skew) {
    const Vector2d middle = floor_point(camera, azimuth, range);
    const Vector2d to_left(-std::sin(azimuth + skew), std::cos(azimuth + skew));
    left = middle + kHalfWidth * to_left;
    right = middle - kHalfWidth * to_left;
  }

  Wall wall(const Light3& colour) const { return {right, left, 0.0, kHeight, colour}; }
};

struct EdgeErrors {
  double left, right;  // radians
};

EdgeErrors edge_errors(const omni::Camera& camera, const Face& face, const Bearing& bearing) {
  return {turn(azimuth_from(camera, face.left), bearing.left), turn(azimuth_from(camera, face.right), bearing.right)};
}

class EveryCamera : public testing::TestWithParam<CameraCase> {};

INSTANTIATE_TEST_SUITE_P(RefineGoal, EveryCamera, testing::ValuesIn(camera_cases()),
                         [](const auto& camera) { return std::string(camera.param.label); });

TEST_P(EveryCamera, SeesTheEdgesOfAGoal) {
  Eye eye(GetParam().camera);
  for (const double range : {1.0, 2.0, 3.0, 4.0}) {
    double largest_deg = 0.0;
    bool yellow = false;
    for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 27.3) {
      yellow = !yellow;
      const Face face(eye.camera(), radians(azimuth_deg), range, 0.3);
      const auto bearing = eye.find(yellow ? ObjectClass::yellow_goal : ObjectClass::blue_goal,
                                    eye.render({{}, {face.wall(yellow ? kYellow : kBlue)}}));
      ASSERT_TRUE(bearing) << azimuth_deg << "° " << range << " m";
      EXPECT_EQ(bearing->flags, 0) << azimuth_deg << "° " << range << " m";
      const EdgeErrors errors = edge_errors(eye.camera(), face, *bearing);
      largest_deg = std::max({largest_deg, degrees(std::abs(errors.left)), degrees(std::abs(errors.right))});
      // By definition: midway between the edges, of which each has half of the weight.
      EXPECT_NEAR(turn(bearing->right, bearing->azimuth), turn(bearing->azimuth, bearing->left), 1e-9);
      EXPECT_NEAR(bearing->covariance(0, 0), 0.25 * (bearing->left_variance + bearing->right_variance), 1e-12);
      // The elevation lies within the goal's: its foot to its top.
      EXPECT_GT(bearing->elevation, -std::atan2(0.25, range - 0.2));
      EXPECT_LT(bearing->elevation, std::atan2(kHeight - 0.25, range - 0.2));
    }
    // Measured: at most 0.026°.
    EXPECT_LT(largest_deg, 0.05) << range << " m";
  }
}

// The light of a border pixel is a mixture in proportion to the areas, however bright the goal's surroundings are: an
// edge stays where it is. Behind the goal stands a wall, wider and higher than the goal.
TEST(RefineGoal, BrightnessOfTheSurroundingsDoesNotMoveEdges) {
  Eye eye(hyperboloid_camera());
  for (const double grey : {60.0, 120.0, 180.0, 240.0}) {
    double largest_deg = 0.0;
    for (double azimuth_deg = -180.0; azimuth_deg < 180.0; azimuth_deg += 43.0) {
      const double azimuth = radians(azimuth_deg);
      const Face face(eye.camera(), azimuth, 2.0, 0.0);
      const Wall wall{floor_point(eye.camera(), azimuth - 0.5, 2.6), floor_point(eye.camera(), azimuth + 0.5, 2.6),
                      -0.5, 1.0, light(grey, grey, grey)};
      const auto bearing = eye.find(ObjectClass::yellow_goal, eye.render({{}, {wall, face.wall(kYellow)}}));
      ASSERT_TRUE(bearing) << azimuth_deg;
      const EdgeErrors errors = edge_errors(eye.camera(), face, *bearing);
      largest_deg = std::max({largest_deg, degrees(std::abs(errors.left)), degrees(std::abs(errors.right))});
    }
    EXPECT_LT(largest_deg, 0.05) << "grey level " << grey;  // measured: 0.026°
  }
}

// A sensor unit, six degrees wide, before the middle of the goal: still one goal, with the same edges.
TEST(RefineGoal, BridgesASensorUnit) {
  Eye eye(hyperboloid_camera());
  const Face face(eye.camera(), 0.4, 2.0, 0.0);
  const Wall unit{floor_point(eye.camera(), 0.35, 0.3), floor_point(eye.camera(), 0.45, 0.3), 0.0, 0.6, kBlack};
  const auto whole = eye.find(ObjectClass::yellow_goal, eye.render({{}, {face.wall(kYellow)}}));
  const auto bridged = eye.find(ObjectClass::yellow_goal, eye.render({{}, {face.wall(kYellow), unit}}));
  ASSERT_TRUE(whole && bridged);
  EXPECT_EQ(bridged->flags, 0);
  EXPECT_NEAR(bridged->left, whole->left, radians(0.01));
  EXPECT_NEAR(bridged->right, whole->right, radians(0.01));
}

// An opponent before the left edge: what is seen ends at it, the edge lies behind, and the bearing says so. The right
// edge does not suffer.
TEST(RefineGoal, EdgeHiddenByAnOpponent) {
  Eye eye(hyperboloid_camera());
  const Face face(eye.camera(), 2.0, 2.0, 0.0);
  const Wall opponent{floor_point(eye.camera(), 2.15, 1.0), floor_point(eye.camera(), 2.5, 1.0), 0.0, 0.6, kBlack};
  const auto bearing = eye.find(ObjectClass::yellow_goal, eye.render({{}, {face.wall(kYellow), opponent}}));
  ASSERT_TRUE(bearing);
  EXPECT_EQ(bearing->flags, kCutByObject);
  const EdgeErrors errors = edge_errors(eye.camera(), face, *bearing);
  EXPECT_GT(std::abs(errors.left), radians(3.0));
  EXPECT_LT(std::abs(errors.left), 3.0 * std::sqrt(bearing->left_variance));
  EXPECT_LT(std::abs(errors.right), radians(0.1));
  EXPECT_LT(bearing->right_variance, 0.01 * bearing->left_variance);
}

// Goals anywhere from 1 m to 4 m, with the camera's noise, both colours: the mean of squared errors over stated
// variances, of the edges and of the bearing midway: 0.19 and 0.15, as pixel_sigma allows for more than this noise. A
// standard deviation that is wrong by two falls out.
TEST(RefineGoalCovariance, IsConsistent) {
  double edges = 0.0;
  double middle = 0.0;
  int goals = 0;
  RandomStream stream = make_stream(4, 1);
  const auto uniform = [&](double min, double max) { return std::uniform_real_distribution<double>(min, max)(stream); };
  for (const omni::Camera& camera : {tilted(hyperboloid_camera()), tilted(unified_camera())}) {
    Eye eye(camera);
    for (int i = 0; i < 100; ++i) {
      const Face face(camera, uniform(-kPi, kPi), uniform(1.0, 4.0), uniform(-0.6, 0.6));
      const bool yellow = i % 2 == 0;
      Picture picture = eye.render({{}, {face.wall(yellow ? kYellow : kBlue)}});
      add_noise(picture, 2.0, stream);
      const auto bearing = eye.find(yellow ? ObjectClass::yellow_goal : ObjectClass::blue_goal, picture);
      ASSERT_TRUE(bearing) << i;
      const EdgeErrors errors = edge_errors(camera, face, *bearing);
      edges += 0.5 * (errors.left * errors.left / bearing->left_variance +
                      errors.right * errors.right / bearing->right_variance);
      const double mean = 0.5 * (errors.left + errors.right);
      middle += mean * mean / bearing->covariance(0, 0);
      ++goals;
    }
  }
  EXPECT_GT(edges / goals, 0.07);
  EXPECT_LT(edges / goals, 0.9);
  EXPECT_GT(middle / goals, 0.03);
  EXPECT_LT(middle / goals, 0.5);
}

}  // namespace
}  // namespace movis::scan
