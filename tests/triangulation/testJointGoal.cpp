#include <gtest/gtest.h>

#include <Eigen/LU>

#include "movis/triangulation/joint.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

constexpr ObjectClass kGoal = ObjectClass::yellow_goal;

using Vector6d = Eigen::Matrix<double, 6, 1>;

// The bearing of a goal by its two edges, as the scan makes it: the azimuth is that midway between them.
Bearing goal_bearing(int camera, double left, double right, double sigma = 1e-4) {
  Bearing bearing;
  bearing.camera = camera;
  bearing.object = kGoal;
  bearing.left = wrap_angle(left);
  bearing.right = wrap_angle(right);
  bearing.azimuth = wrap_angle(right + 0.5 * turn(right, left));
  bearing.left_variance = bearing.right_variance = sigma * sigma;
  bearing.covariance = 0.5 * sigma * sigma * Eigen::Matrix2d::Identity();
  return bearing;
}

std::vector<Bearing> goal_bearings(const omni::Rig& rig, const Vector2d& left, const Vector2d& right,
                                   double sigma = 1e-4) {
  std::vector<Bearing> bearings;
  for (int k = 0; k < static_cast<int>(rig.cameras.size()); ++k) {
    const Vector2d camera = rig.cameras[k].position.head<2>();
    bearings.push_back(goal_bearing(k, azimuth_of(left - camera), azimuth_of(right - camera), sigma));
  }
  return bearings;
}

GoalPoints joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, const JointOptions& options = {}) {
  return triangulate_goal_joint(rig, bearings, kGoal, options);
}

Vector6d stacked(const GoalPoints& goal) {
  Vector6d points;
  points << goal.centre, goal.left, goal.right;
  return points;
}

// With two cameras there is nothing to share: the rays' intersections, by hand in testPairsGoal.cpp. Cameras M1, M2 at
// (∓0.15, y0), posts at (∓0.85, y0 + 2.4): the bisectors are 18 times as steep as wide, and meet at (0, y0 + 18·0.15).
TEST(JointGoal, TwoCamerasByHand) {
  const omni::Rig rig = paper_rig(0.15 / std::cos(radians(30.0)));
  const double y0 = rig.cameras[0].position.y();
  auto bearings = goal_bearings(rig, {-0.85, y0 + 2.4}, {0.85, y0 + 2.4});
  bearings.pop_back();
  const GoalPoints goal = joint(rig, bearings);
  ASSERT_EQ(goal.centre_status, PointStatus::ok);
  ASSERT_EQ(goal.edges_status, PointStatus::ok);
  EXPECT_LT((goal.centre - Vector2d(0.0, y0 + 2.7)).norm(), 1e-9);
  EXPECT_LT((goal.left - Vector2d(-0.85, y0 + 2.4)).norm(), 1e-9);
  EXPECT_LT((goal.right - Vector2d(0.85, y0 + 2.4)).norm(), 1e-9);
}

// The left post at the tip of the equilateral triangle: var x = 2 L² σ² and var y = 6 L² σ² of independent azimuths
// (testPairsCovariance.cpp). A bias s of both azimuths turns both rays alike: the tip moves by 2L s (cos 120° + cos
// 240°, sin 120° − sin 60°) = (−2L s, 0). So var x grows by 4 L² s².
TEST(JointGoal, EdgeBiasByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {0.0, 2.0 * kL}, {0.05, 2.0 * kL}, 1e-3);
  bearings.pop_back();
  JointOptions options;
  for (const double bias_deg : {0.0, 0.1}) {
    options.edge_bias_deg = bias_deg;
    const GoalPoints goal = joint(rig, bearings, options);
    ASSERT_EQ(goal.edges_status, PointStatus::ok);
    const double bias = radians(bias_deg);
    EXPECT_NEAR(goal.covariance(2, 2), 2.0 * kL * kL * 1e-6 + 4.0 * kL * kL * bias * bias, 1e-12);
    EXPECT_NEAR(goal.covariance(3, 3), 6.0 * kL * kL * 1e-6, 1e-12);
    EXPECT_TRUE((goal.covariance.block<2, 2>(2, 4).isZero(0.0))) << "edges share no measurement";
  }
}

TEST(JointGoal, RoundTripAllAround) {
  const omni::Rig rig = paper_rig();
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 10.0) {
    for (const double range : {1.0, 2.0, 4.0}) {
      const Vector2d middle = range * direction(radians(azimuth_deg));
      const Vector2d to_left = 0.4 * direction(radians(azimuth_deg + 90.0));
      const GoalPoints goal = joint(rig, goal_bearings(rig, middle + to_left, middle - to_left));
      ASSERT_EQ(goal.centre_status, PointStatus::ok);
      ASSERT_EQ(goal.edges_status, PointStatus::ok);
      EXPECT_LT((goal.left - middle - to_left).norm(), 1e-8);
      EXPECT_LT((goal.right - middle + to_left).norm(), 1e-8);
      EXPECT_LT(std::abs(turn(azimuth_of(middle), azimuth_of(goal.centre))), radians(1.5));
    }
  }
}

TEST(JointGoal, NotSeen) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.5, 2.0}, {0.5, 2.0});
  for (Bearing& bearing : bearings) bearing.object = ObjectClass::blue_goal;
  const GoalPoints goal = joint(rig, bearings);
  EXPECT_EQ(goal.centre_status, PointStatus::not_seen);
  EXPECT_EQ(goal.edges_status, PointStatus::not_seen);
  EXPECT_TRUE(goal.covariance.isZero(0.0));
}

TEST(JointGoal, OneCamera) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.5, 2.0}, {0.5, 2.0});
  bearings.resize(1);
  EXPECT_EQ(joint(rig, bearings).centre_status, PointStatus::one_camera);
  bearings.push_back(bearings[0]);  // twice by the same camera
  EXPECT_EQ(joint(rig, bearings).edges_status, PointStatus::one_camera);
}

TEST(JointGoal, ParallelRaysOfOneEdge) {
  const GoalPoints goal = joint(
      paper_rig(), {goal_bearing(0, radians(70.0), radians(60.0)), goal_bearing(1, radians(70.0), radians(80.0))});
  EXPECT_EQ(goal.edges_status, PointStatus::parallel_rays);
  EXPECT_TRUE(goal.covariance.bottomRows<4>().isZero(0.0));
}

// Their parallax, 0.02°, is far below three of their sigmas.
TEST(JointGoal, NearlyParallelRays) {
  const GoalPoints goal = joint(paper_rig(), {goal_bearing(0, radians(70.0), radians(69.99), 1e-3),
                                              goal_bearing(1, radians(70.02), radians(70.01), 1e-3)});
  EXPECT_EQ(goal.edges_status, PointStatus::parallel_rays);
}

TEST(JointGoal, BehindCamera) {
  const GoalPoints goal = joint(
      paper_rig(), {goal_bearing(0, radians(120.0), radians(100.0)), goal_bearing(1, radians(80.0), radians(60.0))});
  EXPECT_EQ(goal.centre_status, PointStatus::behind_camera);
  EXPECT_EQ(goal.edges_status, PointStatus::behind_camera);
  EXPECT_TRUE(goal.covariance.isZero(0.0));
}

// Three cameras cannot tell which of them is wrong.
TEST(JointGoal, ThreeCamerasContradictEachOther) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.5, 2.0}, {0.5, 2.0});
  bearings[2].right -= radians(8.0);
  EXPECT_EQ(joint(rig, bearings).edges_status, PointStatus::contradiction);
}

// An edge that an opponent hides in one of four cameras.
TEST(JointGoal, OutlierIsLeftOut) {
  const omni::Rig rig = regular_rig(4);
  const Vector2d left(-0.5, 2.0), right(0.5, 2.0);
  for (int hidden = 0; hidden < 4; ++hidden) {
    auto bearings = goal_bearings(rig, left, right);
    bearings[hidden].left -= radians(2.0);
    const GoalPoints goal = joint(rig, bearings);
    ASSERT_EQ(goal.edges_status, PointStatus::ok);
    EXPECT_LT((goal.left - left).norm(), 1e-8) << hidden;
    EXPECT_LT((goal.right - right).norm(), 1e-8) << hidden;
  }
}

// A hidden edge of one camera of three, known as such: flagged, with half of the goal's width as its sigma.
TEST(JointGoal, HiddenEdgeHasNoSay) {
  const omni::Rig rig = paper_rig();
  const Vector2d left(-0.5, 2.0), right(0.5, 2.0);
  auto bearings = goal_bearings(rig, left, right);
  bearings[1].left -= radians(10.0);
  bearings[1].left_variance = std::pow(radians(5.0), 2);
  bearings[1].flags = kCutByObject;
  const GoalPoints goal = joint(rig, bearings);
  ASSERT_EQ(goal.edges_status, PointStatus::ok);
  EXPECT_LT((goal.left - left).norm(), 1e-3);
}

TEST(JointGoal, RigsThatCannotBeUsedThrow) {
  omni::Rig rig = paper_rig();
  rig.cameras.resize(1);
  test::expect_error([&] { joint(rig, {}); }, {"two or more cameras"});
  test::expect_error([&] { joint(paper_rig(), {goal_bearing(3, 1.0, 0.0)}); }, {"camera number 3"});
}

// Errors with a common part for each edge, all around: the covariance holds them, of both edges, and of the centre with
// the left edge that it depends on. Four degrees of freedom each; the mean of 10⁴ draws scatters by 0.007. As midway
// bearings do not meet in a point, the centre is compared with what exact bearings give.
TEST(JointGoal, NeesOfThePoints) {
  const omni::Rig rig = paper_rig();
  JointOptions options;
  options.edge_bias_deg = 0.02;
  constexpr int kDraws = 10000;
  constexpr double kSigma = 2e-4;
  RandomStream stream = make_stream(1, 6);
  double edges = 0.0, centre_and_left = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double azimuth = uniform(stream, -kPi, kPi);
    const Vector2d middle = uniform(stream, 2.0, 4.0) * direction(azimuth);
    const Vector2d to_left = 0.4 * direction(azimuth + 0.5 * kPi);
    const auto exact = goal_bearings(rig, middle + to_left, middle - to_left, kSigma);
    const double left_bias = normal(stream, radians(options.edge_bias_deg));
    const double right_bias = normal(stream, radians(options.edge_bias_deg));
    std::vector<Bearing> bearings;
    for (const Bearing& b : exact) {
      bearings.push_back(goal_bearing(b.camera, b.left + left_bias + normal(stream, kSigma),
                                      b.right + right_bias + normal(stream, kSigma), kSigma));
    }
    const GoalPoints goal = joint(rig, bearings, options);
    ASSERT_EQ(goal.centre_status, PointStatus::ok);
    ASSERT_EQ(goal.edges_status, PointStatus::ok);
    const Vector6d error = stacked(goal) - stacked(joint(rig, exact, options));
    edges += error.tail<4>().dot(goal.covariance.bottomRightCorner<4, 4>().inverse() * error.tail<4>()) / 4.0 / kDraws;
    centre_and_left +=
        error.head<4>().dot(goal.covariance.topLeftCorner<4, 4>().inverse() * error.head<4>()) / 4.0 / kDraws;
  }
  EXPECT_NEAR(edges, 1.0, 0.03);
  EXPECT_NEAR(centre_and_left, 1.0, 0.03);
}

}  // namespace
}  // namespace movis::triangulation
