#include <gtest/gtest.h>

#include <limits>

#include "joint_draws.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

constexpr double kPaperBaseline = 1.7320508075688772 * kL;  // √3 L, the side of the triangle

PointEstimate joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, const JointOptions& options = {}) {
  return triangulate_joint(rig, bearings, ObjectClass::ball, options);
}

JointOptions bearings_alone() {
  JointOptions options;
  options.floor = false;
  options.elevation_bias_deg = 0.0;
  options.radius_bias_deg = 0.0;
  return options;
}

Bearing bearing_at(int camera, double azimuth_deg, double elevation_deg) {
  Bearing bearing;
  bearing.camera = camera;
  bearing.azimuth = radians(azimuth_deg);
  bearing.elevation = radians(elevation_deg);
  bearing.covariance = 1e-6 * Eigen::Matrix2d::Identity();
  return bearing;
}

// λ1 = 60° and λ2 = 120° close an equilateral triangle over the baseline √3 L: the ball lies at (0, 2L), √3 L from both
// cameras, and 14 cm below them it lies on the floor.
TEST(Joint, EquilateralByHand) {
  const double elevation_deg = degrees(std::atan(-0.14 / kPaperBaseline));
  const PointEstimate ball =
      joint(paper_rig(), {bearing_at(0, 60.0, elevation_deg), bearing_at(1, 120.0, elevation_deg)});
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_TRUE(ball.on_floor);
  EXPECT_NEAR(ball.point.x(), 0.0, 1e-9);
  EXPECT_NEAR(ball.point.y(), 2.0 * kL, 1e-9);
  EXPECT_NEAR(ball.point.z(), 0.11, 1e-9);
}

// The same level with the viewpoints. Turning ray 1 by ε moves the tip by 2L ε along ray 2 (testPairsCovariance.cpp):
// of azimuths with σ², var x = 2 L² σ² and var y = 6 L² σ². The height is the mean of two √3 L e, each of variance 3 L²
// σ², and a common bias s of the elevations moves both by √3 L s.
TEST(Joint, CovarianceByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = exact_bearings(rig, {0.0, 2.0 * kL, kHeight}, 0.01);
  bearings.pop_back();
  JointOptions options = bearings_alone();
  const PointEstimate ball = joint(rig, bearings, options);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_FALSE(ball.on_floor);
  const Vector3d variances = kL * kL * 1e-4 * Vector3d(2.0, 6.0, 1.5);
  EXPECT_LT((ball.covariance - Matrix3d(variances.asDiagonal())).norm(), 1e-9);
  options.elevation_bias_deg = 1.0;
  const double bias = 3.0 * kL * kL * std::pow(radians(1.0), 2);
  EXPECT_NEAR(joint(rig, bearings, options).covariance(2, 2), variances.z() + bias, 1e-9);
}

// A floor at the viewpoints' height, so to speak: information adds up, 1/var z = 1/(1.5 L² σ²) + 1/f².
TEST(Joint, FloorByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = exact_bearings(rig, {0.0, 2.0 * kL, kHeight}, 0.01);
  bearings.pop_back();
  JointOptions options = bearings_alone();
  options.floor = true;
  options.ball_radius = kHeight;
  options.floor_sigma = 0.002;
  const PointEstimate ball = joint(rig, bearings, options);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_TRUE(ball.on_floor);
  EXPECT_NEAR(1.0 / ball.covariance(2, 2), 1.0 / (1.5 * kL * kL * 1e-4) + 1.0 / 4e-6, 1e-3);
}

// sin γ = R/d: along the ray, γ falls by R/(d √(d² − R²)) a metre. The rays' directions are (±1/2, √3/2, 0), d = √3 L:
// y gains the information 2 (3/4) R²/(d² (d² − R²) σ²), beside 1/(6 L² σ²) of the azimuths. With a common bias s of the
// radii, whose mean alone tells y, the variance of that mean grows from σ²/2 to σ²/2 + s².
TEST(Joint, DiameterByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = exact_bearings(rig, {0.0, 2.0 * kL, kHeight}, 0.01);
  bearings.pop_back();
  const double d = kPaperBaseline;
  for (Bearing& bearing : bearings) {
    bearing.radius = std::asin(kBall / d);
    bearing.radius_variance = 1e-4;
  }
  JointOptions options = bearings_alone();
  const double slope2 = kBall * kBall / (d * d * (d * d - kBall * kBall));
  const double of_azimuths = 1.0 / (6.0 * kL * kL * 1e-4);
  const PointEstimate ball = joint(rig, bearings, options);
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_LT((ball.point - Vector3d(0.0, 2.0 * kL, kHeight)).norm(), 1e-9);
  EXPECT_NEAR(1.0 / ball.covariance(1, 1), of_azimuths + 0.75 * slope2 / 0.5e-4, 1e-6 * of_azimuths);
  options.radius_bias_deg = 1.0;
  const double with_bias = 0.5e-4 + std::pow(radians(1.0), 2);
  EXPECT_NEAR(1.0 / joint(rig, bearings, options).covariance(1, 1), of_azimuths + 0.75 * slope2 / with_bias,
              1e-6 * of_azimuths);
  options.diameter = false;
  EXPECT_NEAR(1.0 / joint(rig, bearings, options).covariance(1, 1), of_azimuths, 1e-6 * of_azimuths);
}

// Far away a camera ℓ beside the line of sight sees the object turned by ℓ/ρ: ∂φ/∂ρ = ℓ/ρ². Of three cameras on a
// circle of radius L the ℓ add up to 0 and their squares to 1.5 L², from every direction: the range has the variance
// ρ⁴ σ² / (1.5 L²).
TEST(Joint, TriangleMeasuresRangeAlikeAllAround) {
  const omni::Rig rig = paper_rig();
  constexpr double kSigma = 1e-5;
  constexpr double kRange = 20.0;
  const double expected = std::pow(kRange, 4) * kSigma * kSigma / (1.5 * kL * kL);
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 7.0) {
    const Vector2d sight = direction(radians(azimuth_deg));
    auto bearings = exact_bearings(rig, {kRange * sight.x(), kRange * sight.y(), kBall}, kSigma);
    for (Bearing& bearing : bearings) bearing.covariance(1, 1) = 0.01;  // next to nothing
    const PointEstimate ball = joint(rig, bearings, bearings_alone());
    ASSERT_EQ(ball.status, PointStatus::ok);
    const double variance = sight.dot(ball.covariance.topLeftCorner<2, 2>() * sight);
    EXPECT_NEAR(variance, expected, 0.03 * expected) << azimuth_deg;  // the next order is L/ρ = 0.01
  }
}

// Onto the pixels of tilted, turned and shifted cameras of unequal heights and back, over 8 m × 8 m.
TEST(Joint, RoundTripThroughTheCameras) {
  omni::Rig rig = paper_rig();
  rig.cameras[0].position += Vector3d(0.01, -0.005, 0.02);
  rig.cameras[0].tilt_x = radians(2.0);
  rig.cameras[1].tilt_y = radians(-3.0);
  rig.cameras[2].yaw += radians(5.0);
  int measured = 0;
  for (double x = -4.0; x <= 4.0; x += 0.5) {
    for (double y = -4.0; y <= 4.0; y += 0.5) {
      const Vector3d point(x, y, kBall);
      std::vector<Bearing> bearings;
      for (int k = 0; k < 3; ++k) {
        const auto pixel = project(rig.cameras[k], point);
        if (!pixel) continue;
        const auto ray = unproject(rig.cameras[k], *pixel);
        ASSERT_TRUE(ray);
        bearings.push_back(bearing_at(k, degrees(std::atan2(ray->y(), ray->x())), degrees(std::asin(ray->z()))));
      }
      if (bearings.size() < 2) continue;
      const PointEstimate ball = joint(rig, bearings);
      ASSERT_EQ(ball.status, PointStatus::ok) << x << " " << y;
      EXPECT_LT((ball.point - point).norm(), 1e-7) << x << " " << y;
      ++measured;
    }
  }
  EXPECT_GE(measured, 288);  // all 289 but the one under the robot
}

TEST(Joint, BallInTheAirIsMeasuredInThreeDimensions) {
  const omni::Rig rig = paper_rig();
  for (const double height : {0.2, 0.5, 1.0}) {
    for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 15.0) {
      for (const double range : {0.6, 1.5, 4.0}) {
        const Vector2d at = range * direction(radians(azimuth_deg));
        const Vector3d point(at.x(), at.y(), kBall + height);
        const PointEstimate ball = joint(rig, exact_bearings(rig, point, radians(0.01)));
        ASSERT_EQ(ball.status, PointStatus::ok);
        EXPECT_FALSE(ball.on_floor);
        EXPECT_LT((ball.point - point).norm(), 1e-6) << height << " " << azimuth_deg << " " << range;
      }
    }
  }
}

// No parallax in azimuth: (2, 1) by the elevations alone, seen from 0.25 m and 0.5 m above the floor.
TEST(Joint, CamerasAboveEachOther) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0), camera_at({0.0, 0.0}, 0.0)};
  rig.cameras[1].position.z() = 0.5;
  const Vector3d point(2.0, 1.0, kBall);
  const auto bearings = exact_bearings(rig, point, 1e-4);
  for (const JointOptions& options : {JointOptions{}, bearings_alone()}) {
    const PointEstimate ball = joint(rig, bearings, options);
    ASSERT_EQ(ball.status, PointStatus::ok);
    EXPECT_LT((ball.point - point).norm(), 1e-8);
  }
}

TEST(Joint, NotSeen) {
  EXPECT_EQ(joint(paper_rig(), {}).status, PointStatus::not_seen);
  auto goal = exact_bearings(paper_rig(), {0.0, 2.0, kBall});
  for (Bearing& bearing : goal) bearing.object = ObjectClass::yellow_goal;
  EXPECT_EQ(joint(paper_rig(), goal).status, PointStatus::not_seen);
}

TEST(Joint, OneCamera) {
  auto bearings = exact_bearings(paper_rig(), {0.0, 2.0, kBall});
  bearings.resize(1);
  EXPECT_EQ(joint(paper_rig(), bearings).status, PointStatus::one_camera);
  bearings.push_back(bearings[0]);  // twice by the same camera
  EXPECT_EQ(joint(paper_rig(), bearings).status, PointStatus::one_camera);
}

TEST(Joint, OfTwoBearingsOfOneCameraTheMoreCertainOneCounts) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(1.0, 2.0, kBall);
  auto bearings = exact_bearings(rig, point);
  Bearing vague = bearings[1];
  vague.azimuth += 0.5;
  vague.covariance *= 100.0;
  bearings.push_back(vague);
  std::swap(bearings[1], bearings[3]);
  EXPECT_LT((joint(rig, bearings).point - point).norm(), 1e-8);
}

// Without a floor, level rays that are parallel; with one, rays above the horizon do not meet it either.
TEST(Joint, ParallelRays) {
  const std::vector<Bearing> level{bearing_at(0, 90.0, 0.0), bearing_at(1, 90.0, 0.0)};
  EXPECT_EQ(joint(paper_rig(), level, bearings_alone()).status, PointStatus::parallel_rays);
  // Two cameras on a line with the object, level with it: neither angle has a parallax.
  const omni::Rig two = regular_rig(2);
  EXPECT_EQ(joint(two, exact_bearings(two, {3.0, 0.0, kHeight}), bearings_alone()).status, PointStatus::parallel_rays);
}

// On the line through two cameras a ball on the floor is measured by its elevations.
TEST(Joint, OnTheBaselineTheFloorHelps) {
  const omni::Rig rig = regular_rig(2);
  const Vector3d point(3.0, 0.0, kBall);
  const PointEstimate ball = joint(rig, exact_bearings(rig, point, radians(0.02)));
  ASSERT_EQ(ball.status, PointStatus::ok);
  EXPECT_LT((ball.point - point).norm(), 1e-6);
  EXPECT_GT(ball.covariance(0, 0), std::pow(0.02, 2));  // and it says how badly
}

// The rays part in front of M1 (at the left) and M2.
TEST(Joint, BehindCamera) {
  EXPECT_EQ(joint(paper_rig(), {bearing_at(0, 100.0, 0.0), bearing_at(1, 80.0, 0.0)}, bearings_alone()).status,
            PointStatus::behind_camera);
}

// M1 sees a ball at (0, 0.6), 15° below the horizon, M2 another one at (0.3, 4), 2° below it. Their azimuths cross 1 m
// away, where the one ray is 25 cm below the other.
TEST(Joint, TwoCamerasContradictEachOther) {
  const omni::Rig rig = paper_rig();
  const PointEstimate ball =
      joint(rig, {exact_bearing(rig, 0, {0.0, 0.6, kBall}), exact_bearing(rig, 1, {0.3, 4.0, kBall})});
  EXPECT_EQ(ball.status, PointStatus::contradiction);
}

TEST(Joint, ThreeCamerasOutvoteOne) {
  const omni::Rig rig = paper_rig();
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 10.0) {
    const Vector2d at = 2.0 * direction(radians(azimuth_deg));
    const Vector3d point(at.x(), at.y(), kBall);
    for (int wrong = 0; wrong < 3; ++wrong) {
      auto bearings = exact_bearings(rig, point, radians(0.01));
      bearings[wrong] = exact_bearing(rig, wrong, {-at.y(), at.x(), kBall}, radians(0.01));  // another ball
      const PointEstimate ball = joint(rig, bearings);
      ASSERT_EQ(ball.status, PointStatus::ok) << azimuth_deg << " " << wrong;
      EXPECT_LT((ball.point - point).norm(), 1e-5) << azimuth_deg << " " << wrong;
    }
  }
}

// Errors of 0.3° where 0.01° was stated, as of a rig that is not calibrated: there is a point all the same, with a
// covariance that holds its error. 2.5 m and 0.3°: ρ²σ/(1.22 L) is 13 cm; with 0.01° it would be 0.4 cm.
TEST(Joint, CovarianceGrowsWhereAllDisagree) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(1, 5);
  constexpr int kDraws = 1000;
  int held = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Vector2d at = 2.5 * direction(uniform(stream, -kPi, kPi));
    const Vector3d point(at.x(), at.y(), kBall);
    auto bearings = exact_bearings(rig, point, radians(0.01));
    for (Bearing& bearing : bearings) {
      bearing.azimuth += normal(stream, radians(0.3));
      bearing.elevation += normal(stream, radians(0.3));
    }
    const PointEstimate ball = joint(rig, bearings);
    ASSERT_EQ(ball.status, PointStatus::ok);
    const Vector2d error = (ball.point - point).head<2>();
    EXPECT_LT(error.norm(), 1.0);
    held += error.dot(ball.covariance.topLeftCorner<2, 2>().inverse() * error) < 9.0 ? 1 : 0;
  }
  EXPECT_GT(held, 0.5 * kDraws);  // without the factor, of χ² with 2 degrees of freedom below 9/30²: 0.5 %
}

// A flagged bearing counts as one of `flagged_factor` times its sigmas.
TEST(Joint, FlaggedBearingsWeighLess) {
  const omni::Rig rig = paper_rig();
  auto flagged = exact_bearings(rig, {1.0, 2.0, kBall});
  auto vague = flagged;
  flagged[1].flags = kNearSensor;
  JointOptions options;
  options.flagged_factor = 2.0;
  vague[1].covariance *= 4.0;
  const Matrix3d expected = joint(rig, vague, options).covariance;
  EXPECT_LT((joint(rig, flagged, options).covariance - expected).norm(), 1e-9 * expected.norm());
}

TEST(Joint, RigsThatCannotBeUsedThrow) {
  omni::Rig one_camera = paper_rig();
  one_camera.cameras.resize(1);
  test::expect_error([&] { joint(one_camera, {}); }, {"two or more cameras", "1"});
  test::expect_error([&] { joint(regular_rig(9), {}); }, {"up to 8 cameras", "9", "pairs"});
  auto bearings = exact_bearings(paper_rig(), {0.0, 2.0, kBall});
  bearings[1].camera = 3;
  test::expect_error([&] { joint(paper_rig(), bearings); }, {"camera number 3", "3 cameras"});
}

// Whatever the bearings are, the answer is finite or not ok.
TEST(Joint, NeverNaN) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(2, 5);
  int solved = 0;
  for (int i = 0; i < 20000; ++i) {
    auto bearings =
        exact_bearings(rig, {std::round(uniform(stream, -4.0, 4.0)), std::round(uniform(stream, -4.0, 4.0)), kBall});
    for (int camera = i % 4; camera < 3; ++camera) {  // from none to all
      bearings[camera] = bearing_at(camera, 15.0 * std::round(uniform(stream, -12.0, 12.0)),
                                    15.0 * std::round(uniform(stream, -6.0, 6.0)));
    }
    for (Bearing& bearing : bearings) {
      if (i % 3 == 0) bearing.covariance.setZero();
      if (i % 5 == 0) bearing.radius = uniform(stream, 0.0, 1.6);
      if (i % 7 == 0) bearing.azimuth = std::numeric_limits<double>::quiet_NaN();
    }
    const PointEstimate ball = joint(rig, bearings, i % 2 == 0 ? JointOptions{} : bearings_alone());
    if (ball.status != PointStatus::ok) continue;
    ++solved;
    ASSERT_TRUE(ball.point.allFinite() && ball.covariance.allFinite()) << i;
  }
  EXPECT_GT(solved, 3000);
}

TEST(JointOptions, AreReadStrictly) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_joint_options(YamlMap::read(folder.write("options.yaml", text)));
  };
  const JointOptions options = read("ball_radius: 0.1\nfloor: false\nelevation_bias_deg: 0.2\n");
  EXPECT_DOUBLE_EQ(options.ball_radius, 0.1);
  EXPECT_FALSE(options.floor);
  EXPECT_TRUE(options.diameter);
  EXPECT_DOUBLE_EQ(options.elevation_bias_deg, 0.2);
  EXPECT_DOUBLE_EQ(read("{}\n").floor_sigma, JointOptions{}.floor_sigma);
  test::expect_error([&] { read("floor_sigmas: 1\n"); }, {"options.yaml:1", "floor_sigmas", "floor_sigma"});
  test::expect_error([&] { read("floor_sigma: 0\n"); }, {"options.yaml:1", "floor_sigma", "range"});
  test::expect_error([&] { read("floor: maybe\n"); }, {"options.yaml:1", "floor", "true"});
}

}  // namespace
}  // namespace movis::triangulation
