// The joint estimate against the Cramér–Rao bound, and its covariance against what many draws really do.
#include <gtest/gtest.h>

#include "joint_draws.h"

namespace movis::triangulation {
namespace {

constexpr int kDraws = 10000;
const std::vector<int> kAll{0, 1, 2};

Consistency draw_many(const Noise& noise, const JointOptions& options, std::uint64_t seed,
                      const Heights& heights = {}) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(seed, 4);
  JointOptions of_bound = options;
  of_bound.floor = options.floor && heights.highest == 0.0;
  Consistency sum;
  for (int i = 0; i < kDraws; ++i) {
    const Draw draw = draw_ball(rig, noise, options, stream, heights);
    const PointEstimate estimate = triangulate_joint(rig, draw.bearings, ObjectClass::ball, options);
    EXPECT_EQ(estimate.status, PointStatus::ok);
    sum.add(estimate, draw.ball, place_bound(rig, kAll, draw.ball, noise, of_bound));
  }
  return sum;
}

// The mean of N draws of χ²/dof scatters by √(2/(dof N)): 0.01 for the floor plane and 0.008 for the point, N = 10000.
// The sum of squares is that of a few hundred far places, and scatters by some 2 %.
void expect_consistent(const Consistency& sum) {
  EXPECT_EQ(sum.measured, kDraws);
  EXPECT_LE(sum.efficiency(), 1.05);
  EXPECT_GE(sum.efficiency(), 0.95);  // better than the bound: then the bound is wrong
  EXPECT_GT(sum.mean_nees_floor(), 0.97);
  EXPECT_LT(sum.mean_nees_floor(), 1.03);
  EXPECT_GT(sum.mean_nees_point(), 0.97);
  EXPECT_LT(sum.mean_nees_point(), 1.03);
}

TEST(JointConsistency, OnTheFloor) {
  const Consistency sum = draw_many({}, {}, 1);
  expect_consistent(sum);
  EXPECT_GT(sum.on_floor, 0.999 * kDraws);
}

TEST(JointConsistency, WithoutTheFloor) {
  JointOptions options;
  options.floor = false;
  const Consistency sum = draw_many({}, options, 2);
  expect_consistent(sum);
  EXPECT_EQ(sum.on_floor, 0);
}

TEST(JointConsistency, InTheAir) {
  const Consistency sum = draw_many({}, {}, 3, {0.2, 1.0});
  expect_consistent(sum);
  EXPECT_LT(sum.on_floor, 0.001 * kDraws);
}

TEST(JointConsistency, WithTheDiameter) {
  Noise noise;
  noise.radius = radians(0.02);
  expect_consistent(draw_many(noise, {}, 4));
}

TEST(JointConsistency, DiameterInTheAir) {
  Noise noise;
  noise.radius = radians(0.02);
  expect_consistent(draw_many(noise, {}, 5, {0.2, 1.0}));
}

// All three angles of a camera are correlated with each other.
TEST(JointConsistency, CorrelatedAngles) {
  Noise noise;
  noise.radius = radians(0.015);
  noise.correlation = 0.6;
  expect_consistent(draw_many(noise, {}, 6));
  noise.correlation = -0.4;
  expect_consistent(draw_many(noise, {}, 7));
  noise.radius = 0.0;
  noise.correlation = 0.8;
  expect_consistent(draw_many(noise, {}, 8));
}

// Elevations that all err by the same 0.3° or so.
TEST(JointConsistency, LargeCommonBiases) {
  JointOptions options;
  options.elevation_bias_deg = 0.3;
  options.radius_bias_deg = 0.2;
  Noise noise;
  noise.radius = radians(0.02);
  expect_consistent(draw_many(noise, options, 9));
}

TEST(JointConsistency, OfTwoCamerasAndOfFive) {
  for (const int cameras : {2, 5}) {
    const omni::Rig rig = regular_rig(cameras);
    std::vector<int> all(cameras);
    for (int i = 0; i < cameras; ++i) all[i] = i;
    RandomStream stream = make_stream(10, 4);
    Consistency sum;
    while (sum.measured < kDraws) {
      const Draw draw = draw_ball(rig, {}, {}, stream);
      if (std::abs(draw.ball.y()) < std::abs(draw.ball.x()) && cameras == 2) continue;  // along the baseline
      const PointEstimate estimate = triangulate_joint(rig, draw.bearings, ObjectClass::ball);
      ASSERT_EQ(estimate.status, PointStatus::ok);
      sum.add(estimate, draw.ball, place_bound(rig, all, draw.ball, {}, {}));
    }
    expect_consistent(sum);
  }
}

// One of three cameras sees something else, five degrees away and more. The bound is that of the two that are left.
TEST(JointConsistency, OutliersAreLeftOut) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(11, 4);
  Consistency sum;
  for (int i = 0; i < kDraws; ++i) {
    Draw draw = draw_ball(rig, {}, {}, stream);
    const int wrong = i % 3;
    const double by = radians(uniform(stream, 5.0, 60.0));
    Bearing& bearing = draw.bearings[wrong];
    bearing.azimuth = wrap_angle(bearing.azimuth + (i % 2 == 0 ? by : -by));
    const PointEstimate estimate = triangulate_joint(rig, draw.bearings, ObjectClass::ball);
    if (estimate.status != PointStatus::ok) continue;
    sum.add(estimate, draw.ball, place_bound(rig, {(wrong + 1) % 3, (wrong + 2) % 3}, draw.ball, {}, {}));
  }
  EXPECT_GT(sum.measured, 0.999 * kDraws);
  EXPECT_LE(sum.efficiency(), 1.10);
  EXPECT_GT(sum.mean_nees_floor(), 0.95);
  EXPECT_LT(sum.mean_nees_floor(), 1.05);
}

// Of five cameras two: the rejection goes on.
TEST(JointConsistency, TwoOutliersOfFive) {
  const omni::Rig rig = regular_rig(5);
  RandomStream stream = make_stream(12, 4);
  Consistency sum;
  for (int i = 0; i < kDraws / 4; ++i) {
    Draw draw = draw_ball(rig, {}, {}, stream);
    draw.bearings[1].azimuth += radians(uniform(stream, 5.0, 60.0));
    draw.bearings[3].azimuth -= radians(uniform(stream, 5.0, 60.0));
    const PointEstimate estimate = triangulate_joint(rig, draw.bearings, ObjectClass::ball);
    if (estimate.status != PointStatus::ok) continue;
    sum.add(estimate, draw.ball, place_bound(rig, {0, 2, 4}, draw.ball, {}, {}));
  }
  EXPECT_GT(sum.measured, 0.99 * kDraws / 4);
  EXPECT_LE(sum.efficiency(), 1.15);
}

// A ball at a height h above the floor that is too much for all cameras, and not for two, their heights being vaguer.
// Four readings are left: in the air by all cameras, with χ² = 0 and 6 − 3 degrees of freedom; on the floor without
// camera k, with 4 + 1 − 3 of them. Bearings are exact, so all that the latter do not explain is the floor, known to φ: of
// bearings that leave the height z the variance s², χ² = h²/(s² + φ²). It pulls the ball away by C e_z h/φ², C being
// the covariance with the floor. They share by exp(−(χ² − dof)/2): exp(1.5) to exp(1 − χ²/2).
TEST(JointConsistency, ReadingsShareByWhatTheyDoNotExplain) {
  const omni::Rig rig = paper_rig();
  JointOptions options;
  options.elevation_bias_deg = 0.0;
  options.floor_sigma = 0.0003;
  options.air_sigmas = 1.5;
  JointOptions no_floor = options;
  no_floor.floor = false;
  const Vector3d below(0.5, 1.5, options.ball_radius);
  const double floor_variance = options.floor_sigma * options.floor_sigma;
  const auto height_variance = [&](const std::vector<int>& cameras) {
    return floor_variance + place_bound(rig, cameras, below, {}, no_floor)(2, 2);
  };
  const double height = 1.55 * std::sqrt(height_variance(kAll));
  double weights = std::exp(1.5);
  Vector3d expected = Vector3d::Zero();
  for (const std::vector<int>& two : {std::vector<int>{0, 1}, {0, 2}, {1, 2}}) {
    const double chi2 = height * height / height_variance(two);
    ASSERT_LT(chi2, 1.5 * 1.5);
    const double weight = std::exp(1.0 - 0.5 * chi2);
    weights += weight;
    expected -= weight * height / floor_variance * place_bound(rig, two, below, {}, options).col(2);
  }
  expected /= weights;

  const Vector3d ball = below + height * Vector3d::UnitZ();
  std::vector<Bearing> bearings = exact_bearings(rig, ball);
  for (Bearing& bearing : bearings) bearing.covariance = covariance_of({}).topLeftCorner<2, 2>();
  const PointEstimate estimate = triangulate_joint(rig, bearings, ObjectClass::ball, options);
  ASSERT_EQ(estimate.status, PointStatus::ok);
  EXPECT_FALSE(estimate.on_floor);  // the heaviest
  EXPECT_LT((estimate.point - ball - expected).norm(), 0.02 * expected.norm());
}

// One degree is too little to tell everywhere which of three cameras is wrong: the doubt has to show. Believing the
// wrong one, or all, would give a NEES of hundreds: 1° is 100 sigma.
TEST(JointConsistency, DoubtShowsInTheCovariance) {
  const omni::Rig rig = paper_rig();
  RandomStream stream = make_stream(13, 4);
  Consistency sum;
  for (int i = 0; i < kDraws; ++i) {
    Draw draw = draw_ball(rig, {}, {}, stream);
    draw.bearings[i % 3].azimuth += radians(i % 2 == 0 ? 1.0 : -1.0);
    const PointEstimate estimate = triangulate_joint(rig, draw.bearings, ObjectClass::ball);
    ASSERT_EQ(estimate.status, PointStatus::ok);
    sum.add(estimate, draw.ball, place_bound(rig, kAll, draw.ball, {}, {}));
  }
  EXPECT_LT(sum.mean_nees_floor(), 5.0);
}

}  // namespace
}  // namespace movis::triangulation
