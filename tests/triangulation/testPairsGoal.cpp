#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>

#include "movis/triangulation/pairs.h"
#include "movis_rig.h"

namespace movis::triangulation {
namespace {

constexpr ObjectClass kGoal = ObjectClass::yellow_goal;

// The bearing of a goal by its two edges, as the scan makes it: the azimuth is that midway between them.
Bearing goal_bearing(int camera, double left, double right, double left_sigma = 1e-3, double right_sigma = 1e-3) {
  Bearing bearing;
  bearing.camera = camera;
  bearing.object = kGoal;
  bearing.left = wrap_angle(left);
  bearing.right = wrap_angle(right);
  bearing.azimuth = wrap_angle(right + 0.5 * turn(right, left));
  bearing.left_variance = left_sigma * left_sigma;
  bearing.right_variance = right_sigma * right_sigma;
  bearing.covariance = 0.25 * (bearing.left_variance + bearing.right_variance) * Eigen::Matrix2d::Identity();
  return bearing;
}

std::vector<Bearing> goal_bearings(const omni::Rig& rig, const Vector2d& left, const Vector2d& right) {
  std::vector<Bearing> bearings;
  for (int k = 0; k < static_cast<int>(rig.cameras.size()); ++k) {
    const Vector2d camera = rig.cameras[k].position.head<2>();
    bearings.push_back(goal_bearing(k, azimuth_of(left - camera), azimuth_of(right - camera)));
  }
  return bearings;
}

GoalPoints triangulate_goal(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulate_goal_pairs(rig, bearings, kGoal);
}

// Cameras M1, M2 at (∓0.15, y0), posts at (∓0.85, y0 + 2.4). From M1 the posts lie at (−0.7, 2.4) and (1.0, 2.4), of
// lengths 2.5 and 2.6; the bisector runs along the sum of their unit vectors, (5/13 − 7/25, 12/13 + 24/25) =
// (34, 612)/325: 18 times as steep as wide. M2's is its mirror image, so that they meet at (0, y0 + 18·0.15).
TEST(PairsGoal, StraightAheadByHand) {
  const omni::Rig rig = paper_rig(0.15 / std::cos(radians(30.0)));
  const double y0 = rig.cameras[0].position.y();
  ASSERT_NEAR(rig.cameras[0].position.x(), -0.15, 1e-12);
  const GoalPoints goal = triangulate_goal(rig, goal_bearings(rig, {-0.85, y0 + 2.4}, {0.85, y0 + 2.4}));
  ASSERT_EQ(goal.centre_status, PointStatus::ok);
  ASSERT_EQ(goal.edges_status, PointStatus::ok);
  EXPECT_NEAR(goal.left.x(), -0.85, 1e-12);
  EXPECT_NEAR(goal.left.y(), y0 + 2.4, 1e-12);
  EXPECT_NEAR(goal.right.x(), 0.85, 1e-12);
  EXPECT_NEAR(goal.right.y(), y0 + 2.4, 1e-12);
  EXPECT_NEAR(goal.centre.x(), 0.0, 1e-12);
  EXPECT_NEAR(goal.centre.y(), y0 + 2.7, 1e-12);
}

// A goal that lies across ±180°, where the numbers of its azimuths wrap: the same by a turn of the rig and of the goal.
TEST(PairsGoal, AcrossTheWrapByHand) {
  omni::Rig rig = paper_rig(0.15 / std::cos(radians(30.0)));
  const double y0 = rig.cameras[0].position.y();
  const Eigen::Rotation2Dd quarter(radians(90.0));
  for (omni::Camera& camera : rig.cameras) {
    const Vector2d turned = quarter * camera.position.head<2>();
    camera.position.head<2>() = turned;
  }
  const GoalPoints goal = triangulate_goal(
      rig, goal_bearings(rig, quarter * Vector2d(-0.85, y0 + 2.4), quarter * Vector2d(0.85, y0 + 2.4)));
  ASSERT_EQ(goal.centre_status, PointStatus::ok);
  ASSERT_EQ(goal.edges_status, PointStatus::ok);
  EXPECT_LT((goal.centre - Vector2d(-y0 - 2.7, 0.0)).norm(), 1e-12);
  EXPECT_LT((goal.left - Vector2d(-y0 - 2.4, -0.85)).norm(), 1e-12);
  EXPECT_LT((goal.right - Vector2d(-y0 - 2.4, 0.85)).norm(), 1e-12);
}

// Edges are points and come out as such wherever the goal stands; the centre's bearing is the right direction of the
// middle only from far away, where both posts are equally far.
TEST(PairsGoal, RoundTripAllAround) {
  const omni::Rig rig = paper_rig();
  for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += 10.0) {
    for (const double range : {1.0, 2.0, 4.0}) {
      const Vector2d middle = range * direction(radians(azimuth_deg));
      const Vector2d to_left = 0.4 * direction(radians(azimuth_deg + 90.0));
      const GoalPoints goal = triangulate_goal(rig, goal_bearings(rig, middle + to_left, middle - to_left));
      ASSERT_EQ(goal.centre_status, PointStatus::ok);
      ASSERT_EQ(goal.edges_status, PointStatus::ok);
      EXPECT_LT((goal.left - middle - to_left).norm(), 1e-9);
      EXPECT_LT((goal.right - middle + to_left).norm(), 1e-9);
      EXPECT_LT(std::abs(turn(azimuth_of(middle), azimuth_of(goal.centre))), radians(1.5))
          << azimuth_deg << " " << range;
    }
  }
}

TEST(PairsGoal, NotSeen) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.5, 2.0}, {0.5, 2.0});
  for (Bearing& bearing : bearings) bearing.object = ObjectClass::blue_goal;
  const GoalPoints goal = triangulate_goal(rig, bearings);
  EXPECT_EQ(goal.centre_status, PointStatus::not_seen);
  EXPECT_EQ(goal.edges_status, PointStatus::not_seen);
  EXPECT_TRUE(goal.covariance.isZero(0.0));
}

TEST(PairsGoal, OneCamera) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.5, 2.0}, {0.5, 2.0});
  bearings.resize(1);
  const GoalPoints goal = triangulate_goal(rig, bearings);
  EXPECT_EQ(goal.centre_status, PointStatus::one_camera);
  EXPECT_EQ(goal.edges_status, PointStatus::one_camera);
}

// The cameras at (∓0.17, 0.1) see the right edge in parallel and the left edge not; the centre's parallax lies between.
TEST(PairsGoal, ParallelRaysOfOneEdge) {
  const omni::Rig rig = paper_rig();
  const GoalPoints goal = triangulate_goal(
      rig, {goal_bearing(0, radians(110.0), radians(70.0)), goal_bearing(1, radians(120.0), radians(70.0))});
  EXPECT_EQ(goal.edges_status, PointStatus::parallel_rays);
  EXPECT_EQ(goal.centre_status, PointStatus::ok);
  EXPECT_GT(goal.covariance(0, 0), 0.0);
  // "Rows of a point whose status is not ok are zero": edges_status is the status of both edges.
  EXPECT_TRUE(goal.covariance.bottomRows<4>().isZero(0.0));
  EXPECT_TRUE(goal.covariance.rightCols<4>().isZero(0.0));
}

TEST(PairsGoal, BehindCamera) {
  const omni::Rig rig = paper_rig();
  const GoalPoints goal = triangulate_goal(
      rig, {goal_bearing(0, radians(120.0), radians(100.0)), goal_bearing(1, radians(80.0), radians(60.0))});
  EXPECT_EQ(goal.centre_status, PointStatus::behind_camera);
  EXPECT_EQ(goal.edges_status, PointStatus::behind_camera);
  EXPECT_TRUE(goal.covariance.isZero(0.0));
}

TEST(PairsGoal, RigOfOneCameraThrows) {
  omni::Rig rig = paper_rig();
  rig.cameras.resize(1);
  EXPECT_THROW(triangulate_goal(rig, {}), std::runtime_error);
}

// Straight ahead a goal's edges are points as any other: by hand as in PairsCovariance.EquilateralByHand, with the left
// post at the tip of the triangle and equal variances σ² of its two bearings.
TEST(PairsGoal, EdgeCovarianceByHand) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {0.0, 2.0 * kL}, {0.05, 2.0 * kL});
  bearings.pop_back();
  const GoalPoints goal = triangulate_goal(rig, bearings);
  ASSERT_EQ(goal.edges_status, PointStatus::ok);
  EXPECT_NEAR(goal.covariance(2, 2), 2.0 * kL * kL * 1e-6, 1e-14);
  EXPECT_NEAR(goal.covariance(3, 3), 6.0 * kL * kL * 1e-6, 1e-14);
  EXPECT_NEAR(goal.covariance(2, 3), 0.0, 1e-14);
  EXPECT_TRUE((goal.covariance.block<2, 2>(2, 4).isZero(0.0))) << "edges share no measurement";
}

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d stacked(const GoalPoints& goal) {
  Vector6d points;
  points << goal.centre, goal.left, goal.right;
  return points;
}

// The covariance that many draws of the edges' bearings have, against the one that is stated for the bearings without
// noise. Entries are compared as correlations: they scatter by about 1/√N, 0.007, where nothing is correlated.
// Measured: at most 0.015.
void expect_joint_covariance(const omni::Rig& rig, const std::vector<Bearing>& exact) {
  const GoalPoints at = triangulate_goal(rig, exact);
  ASSERT_EQ(at.centre_status, PointStatus::ok);
  ASSERT_EQ(at.edges_status, PointStatus::ok);
  constexpr int kDraws = 20000;
  RandomStream stream = make_stream(3, 3);
  Vector6d mean = Vector6d::Zero();
  GoalPoints::Covariance scatter = GoalPoints::Covariance::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Bearing> bearings;
    for (const Bearing& b : exact) {
      const double left_sigma = std::sqrt(b.left_variance);
      const double right_sigma = std::sqrt(b.right_variance);
      bearings.push_back(goal_bearing(b.camera, b.left + normal(stream, left_sigma),
                                      b.right + normal(stream, right_sigma), left_sigma, right_sigma));
    }
    const Vector6d error = stacked(triangulate_goal(rig, bearings)) - stacked(at);
    mean += error / kDraws;
    scatter += error * error.transpose() / kDraws;
  }
  scatter -= mean * mean.transpose();
  const Vector6d sigma = scatter.diagonal().cwiseSqrt();
  const GoalPoints::Covariance scale = sigma * sigma.transpose();
  EXPECT_LT((at.covariance.cwiseQuotient(scale) - scatter.cwiseQuotient(scale)).cwiseAbs().maxCoeff(), 0.03)
      << "stated:\n"
      << at.covariance.cwiseQuotient(scale) << "\ndrawn:\n"
      << scatter.cwiseQuotient(scale);
}

// Both edges and the centre by M1 and M2; the left edges are better known than the right ones.
TEST(PairsGoal, JointCovarianceOfOnePair) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, {-0.3, 2.0}, {0.3, 2.0});
  for (Bearing& bearing : bearings) {
    bearing = goal_bearing(bearing.camera, bearing.left, bearing.right, 2e-4, 4e-4);
  }
  expect_joint_covariance(rig, bearings);
}

// A wide goal close by: its edges lie in different sectors, at azimuths 95° and 5°, and the centre between them, so
// that not all three come from one pair. Cameras are shared, and with them the errors of their edges.
TEST(PairsGoal, JointCovarianceOfDifferentPairs) {
  const omni::Rig rig = paper_rig();
  auto bearings = goal_bearings(rig, 1.5 * direction(radians(95.0)), 1.5 * direction(radians(5.0)));
  for (Bearing& bearing : bearings) {
    bearing = goal_bearing(bearing.camera, bearing.left, bearing.right, 4e-4, 4e-4);
  }
  auto turned = bearings;
  turned[2].left += 1e-3;
  turned[2].right += 1e-3;
  const GoalPoints before = triangulate_goal(rig, bearings);
  const GoalPoints after = triangulate_goal(rig, turned);
  ASSERT_EQ(before.left, after.left) << "M3 has no part in the left edge";
  ASSERT_NE(before.right, after.right) << "but in the right one";
  expect_joint_covariance(rig, bearings);
}

}  // namespace
}  // namespace movis::triangulation
