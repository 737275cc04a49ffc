// Vertical stereo: range from two elevations.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "movis/triangulation/vertical.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

omni::Rig vertical_rig(double baseline, const Vector2d& offset = Vector2d::Zero()) {
  omni::Rig rig;
  rig.cameras = {camera_at(Vector2d::Zero(), 0.0), camera_at(offset, 0.0)};
  rig.cameras[0].name = "V1";
  rig.cameras[1].name = "V2";
  rig.cameras[1].position.z() += baseline;
  return rig;
}

PointEstimate measure(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulate_vertical(rig, bearings, ObjectClass::ball);
}

// By hand: seen level from 0.25 m and 45° down from 1.25 m, the point is 1 m away and 0.25 m high. With t = tan e,
// ρ = b/(t1 − t2), t1 = 0, t2 = −1: ∂ρ/∂t1 = −1, ∂ρ/∂t2 = 1, and dt/de is 1 and 2, so var ρ = σ1² + 4 σ2²; the height
// is z1 + ρ t1 with the derivative ρ = 1 by e1 alone. Both azimuths are averaged: var of the direction is σ²/2.
TEST(Vertical, RightAngledTriangleByHand) {
  const omni::Rig rig = vertical_rig(1.0);
  auto bearings = exact_bearings(rig, {0.0, 1.0, 0.25}, 0.01);
  bearings[1].covariance(1, 1) = 9e-4;
  const PointEstimate point = measure(rig, bearings);
  ASSERT_EQ(point.status, PointStatus::ok);
  EXPECT_FALSE(point.on_floor);
  EXPECT_LT((point.point - Vector3d(0.0, 1.0, 0.25)).norm(), 1e-12);
  EXPECT_NEAR(point.covariance(0, 0), 0.5e-4, 1e-12);
  EXPECT_NEAR(point.covariance(1, 1), 1e-4 + 4.0 * 9e-4, 1e-12);
  EXPECT_NEAR(point.covariance(2, 2), 1e-4, 1e-12);
  EXPECT_NEAR(point.covariance(1, 2), -1e-4, 1e-12);  // ∂ρ/∂e1 = −1, ∂z/∂e1 = 1
}

// Far away ρ = b/(e1 − e2): ∂ρ/∂e = ∓ρ²/b, so var ρ = 2 ρ⁴σ²/b². The paper's three cameras have ρ⁴σ²/(1.5 L²), which is
// the same number for b = √3·L.
TEST(Vertical, FarAwayByHand) {
  const double baseline = std::sqrt(3.0) * kL;
  const omni::Rig rig = vertical_rig(baseline);
  constexpr double kFar = 1000.0;
  const double sigma = 1e-9;
  const PointEstimate point =
      triangulate_vertical(rig, exact_bearings(rig, {kFar, 0.0, kBall}, sigma), ObjectClass::ball, {1e-3});
  ASSERT_EQ(point.status, PointStatus::ok);
  const double expected = std::pow(kFar, 4) * sigma * sigma / (1.5 * kL * kL);
  EXPECT_NEAR(point.covariance(0, 0) / expected, 1.0, 1e-5);
}

TEST(Vertical, FindsPointsAllOver) {
  const omni::Rig rig = vertical_rig(0.346);
  for (double azimuth_deg = -175.0; azimuth_deg < 180.0; azimuth_deg += 10.0) {
    for (const double range : {0.4, 1.0, 3.0, 6.0}) {
      for (const double height : {kBall, 0.5, 1.2}) {
        Vector3d place(0.0, 0.0, height);
        place.head<2>() = range * direction(radians(azimuth_deg));
        EXPECT_LT((measure(rig, exact_bearings(rig, place)).point - place).norm(), 1e-9);
      }
    }
  }
}

// A millimetre's offset is accounted for along the direction exactly, across it to its square: (5 mm)²/2/0.4 m = 0.03
// mm.
TEST(Vertical, ViewpointsNotQuiteAboveOneAnother) {
  const omni::Rig rig = vertical_rig(0.133, {0.003, -0.004});
  for (double azimuth_deg = -175.0; azimuth_deg < 180.0; azimuth_deg += 10.0) {
    for (const double range : {0.4, 1.0, 4.0}) {
      Vector3d place(0.0, 0.0, kBall);
      place.head<2>() = range * direction(radians(azimuth_deg));
      EXPECT_LT((measure(rig, exact_bearings(rig, place)).point - place).norm(), 2e-4) << azimuth_deg << "° " << range;
    }
  }
}

TEST(Vertical, NotSeenAndOneCamera) {
  const omni::Rig rig = vertical_rig(0.346);
  auto bearings = exact_bearings(rig, {1.0, 0.0, kBall});
  EXPECT_EQ(measure(rig, {}).status, PointStatus::not_seen);
  bearings.pop_back();
  EXPECT_EQ(measure(rig, bearings).status, PointStatus::one_camera);
  bearings[0].object = ObjectClass::yellow_goal;
  EXPECT_EQ(measure(rig, bearings).status, PointStatus::not_seen);
}

// 0.2° of parallax at a baseline of 0.346 m: 99 m.
TEST(Vertical, ParallelRays) {
  const omni::Rig rig = vertical_rig(0.346);
  EXPECT_EQ(measure(rig, exact_bearings(rig, {98.0, 0.0, kBall})).status, PointStatus::ok);
  EXPECT_EQ(measure(rig, exact_bearings(rig, {100.0, 0.0, kBall})).status, PointStatus::parallel_rays);
}

TEST(Vertical, RaysThatMeetBehindTheCameras) {
  const omni::Rig rig = vertical_rig(0.346);
  auto bearings = exact_bearings(rig, {2.0, 0.0, kBall});
  std::swap(bearings[0].elevation, bearings[1].elevation);
  EXPECT_EQ(measure(rig, bearings).status, PointStatus::behind_camera);
}

TEST(Vertical, RigThatIsNone) {
  test::expect_error([] { measure(paper_rig(), {}); }, {"two cameras", "has 3"});
  omni::Rig level = vertical_rig(0.0, {0.3, 0.0});
  test::expect_error([&] { measure(level, {}); }, {"V1", "V2", "above one another"});
}

// Azimuths on either side of ±180° average to 180°, not to 0°.
TEST(Vertical, DirectionBehind) {
  const omni::Rig rig = vertical_rig(0.346);
  auto bearings = exact_bearings(rig, {-2.0, 0.0, kBall});
  bearings[0].azimuth = radians(179.5);
  bearings[1].azimuth = radians(-179.5);
  const PointEstimate point = measure(rig, bearings);
  EXPECT_LT((point.point - Vector3d(-2.0, 0.0, kBall)).norm(), 1e-9);
}

// χ² of 3·15000 degrees of freedom: its mean of 1 is known to 0.7 %, so 3 % are four standard deviations.
TEST(Vertical, CovarianceIsConsistent) {
  const omni::Rig rig = vertical_rig(0.346, {0.002, 0.001});
  const double azimuth_sigma = radians(0.02);
  const double elevation_sigma = radians(0.01);
  constexpr double kCorrelation = 0.5;
  RandomStream stream = make_stream(3, 1);
  constexpr int kDraws = 15000;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Vector3d place(0.0, 0.0, uniform(stream, 0.1, 1.0));
    place.head<2>() = uniform(stream, 0.6, 4.0) * direction(uniform(stream, -kPi, kPi));
    auto bearings = exact_bearings(rig, place);
    for (Bearing& bearing : bearings) {
      const double common = normal(stream, 1.0);
      const double other = kCorrelation * common + std::sqrt(1.0 - kCorrelation * kCorrelation) * normal(stream, 1.0);
      bearing.azimuth += azimuth_sigma * common;
      bearing.elevation += elevation_sigma * other;
      const double cross = kCorrelation * azimuth_sigma * elevation_sigma;
      bearing.covariance << azimuth_sigma * azimuth_sigma, cross, cross, elevation_sigma * elevation_sigma;
    }
    const PointEstimate point = measure(rig, bearings);
    const Vector3d error = point.point - place;
    sum += error.dot(point.covariance.inverse() * error) / 3.0;
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 0.03);
}

}  // namespace
}  // namespace movis::triangulation
