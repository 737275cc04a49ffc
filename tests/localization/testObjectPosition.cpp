#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "movis/core/angle.h"
#include "movis/core/random.h"
#include "movis/localization/object_position.h"

namespace movis::localization {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

Fix fix_at(const Pose2& world_from_robot, const Matrix3d& covariance) {
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = world_from_robot;
  fix.covariance = covariance;
  return fix;
}

PointEstimate point_at(const Vector2d& in_robot, const Matrix2d& covariance) {
  PointEstimate point;
  point.status = PointStatus::ok;
  point.point << in_robot, 0.11;
  point.covariance.topLeftCorner<2, 2>() = covariance;
  point.covariance(2, 2) = 1.0;  // of the height, which does not count
  return point;
}

// By hand: the robot at (1, 0.5) turned by 90°, the ball 2 m before it: (0, 2) in the robot frame is 2 m to the left of
// it in the field, a = (−2, 0), at (−1, 0.5). A turn moves the ball by (−a_y, a_x) dβ = (0, −2) dβ; the robot's x axis
// is the field's Y axis, its y axis the field's −X axis. With the variances (1, 2, 3)e-4 of the pose, uncorrelated but
// for cov(Y, β) = 0.5e-4, and of the point 4e-4 in x, 9e-4 in y:
//   var X = 1e-4 + 9e-4 = 10e-4
//   var Y = 2e-4 + 2·(−2)·0.5e-4 + (−2)²·3e-4 + 4e-4 = 16e-4,   cov(X, Y) = 0
TEST(ObjectPosition, KnownAnswer) {
  Matrix3d of_pose = Vector3d(1e-4, 2e-4, 3e-4).asDiagonal();
  of_pose(1, 2) = of_pose(2, 1) = 0.5e-4;
  const ObjectPosition ball =
      object_position(fix_at({1.0, 0.5, kPi / 2.0}, of_pose), point_at({0.0, 2.0}, Vector2d(4e-4, 9e-4).asDiagonal()));
  ASSERT_EQ(ball.status, ObjectStatus::ok);
  EXPECT_NEAR(ball.in_field.x(), -1.0, 1e-12);
  EXPECT_NEAR(ball.in_field.y(), 0.5, 1e-12);
  const Matrix2d expected = Vector2d(10e-4, 16e-4).asDiagonal();
  EXPECT_LT((ball.covariance - expected).norm(), 1e-15) << ball.covariance;
}

// A place of the field, put into the robot frame as (5)–(6) have it the other way round, comes back.
TEST(ObjectPosition, RoundTripOverTheField) {
  RandomStream random = make_stream(1, 0);
  std::uniform_real_distribution<double> along(-4.0, 4.0);
  for (int draw = 0; draw < 500; ++draw) {
    const Pose2 robot{along(random), along(random), along(random)};
    const Vector2d place(along(random), along(random));
    const double c = std::cos(robot.beta), s = std::sin(robot.beta);
    const Vector2d arm = place - robot.translation();
    const Vector2d in_robot(c * arm.x() + s * arm.y(), -s * arm.x() + c * arm.y());
    const ObjectPosition object =
        object_position(fix_at(robot, Matrix3d::Identity()), point_at(in_robot, Matrix2d::Identity()));
    ASSERT_EQ(object.status, ObjectStatus::ok);
    EXPECT_LT((object.in_field - place).norm(), 1e-12);
  }
}

TEST(ObjectPosition, NoPoint) {
  const Fix fix = fix_at({}, Matrix3d::Identity());
  for (const PointStatus status : {PointStatus::not_seen, PointStatus::one_camera, PointStatus::parallel_rays,
                                   PointStatus::behind_camera, PointStatus::contradiction}) {
    PointEstimate point = point_at({1.0, 1.0}, Matrix2d::Identity());
    point.status = status;
    EXPECT_EQ(object_position(fix, point).status, ObjectStatus::no_point) << word(status);
    EXPECT_EQ(object_position({}, point).status, ObjectStatus::no_point) << word(status);
  }
}

TEST(ObjectPosition, NoPose) {
  const PointEstimate point = point_at({1.0, 1.0}, Matrix2d::Identity());
  for (const FixStatus status : {FixStatus::no_field, FixStatus::one_goal, FixStatus::ambiguous, FixStatus::bad_fit}) {
    Fix fix = fix_at({}, Matrix3d::Identity());
    fix.status = status;
    EXPECT_EQ(object_position(fix, point).status, ObjectStatus::no_pose) << word(status);
  }
}

// An object under the robot's origin has no arm: the heading's variance, however large, does not move it.
TEST(ObjectPosition, ObjectAtTheOriginOfTheRobot) {
  const Matrix3d of_pose = Vector3d(1e-4, 4e-4, 1e6).asDiagonal();
  const ObjectPosition object =
      object_position(fix_at({0.3, -0.2, 1.0}, of_pose), point_at({0.0, 0.0}, Matrix2d::Zero()));
  ASSERT_EQ(object.status, ObjectStatus::ok);
  EXPECT_EQ(object.in_field, Vector2d(0.3, -0.2));
  EXPECT_LT((object.covariance - of_pose.topLeftCorner<2, 2>()).norm(), 1e-15);
}

TEST(ObjectPosition, NumbersThatAreNotFinite) {
  const Fix fix = fix_at({0.3, -0.2, 1.0}, Matrix3d::Identity());
  const PointEstimate point = point_at({1.0, 1.0}, Matrix2d::Identity());
  ASSERT_EQ(object_position(fix, point).status, ObjectStatus::ok);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Fix bad_fix = fix;
    bad_fix.world_from_robot.beta = bad;
    EXPECT_EQ(object_position(bad_fix, point).status, ObjectStatus::not_finite);
    bad_fix = fix;
    bad_fix.covariance(2, 2) = bad;
    EXPECT_EQ(object_position(bad_fix, point).status, ObjectStatus::not_finite);
    PointEstimate bad_point = point;
    bad_point.point.y() = bad;
    EXPECT_EQ(object_position(fix, bad_point).status, ObjectStatus::not_finite);
    bad_point = point;
    bad_point.covariance(0, 0) = bad;
    EXPECT_EQ(object_position(fix, bad_point).status, ObjectStatus::not_finite);
  }
  PointEstimate far = point;
  far.point.x() = 1e200;  // finite, but its square is not
  const ObjectPosition object = object_position(fix, far);
  EXPECT_EQ(object.status, ObjectStatus::not_finite);
  EXPECT_TRUE(object.in_field.allFinite() && object.covariance.allFinite());
}

// eᵀ C⁻¹ e is χ² of 2 degrees of freedom when C is the covariance of the error e, with mean 2 and variance 4: its mean
// over 20 000 draws has a standard deviation of 0.014, 0.7 %. Pose and point are drawn with correlations of their own.
TEST(ObjectPosition, CovarianceIsConsistent) {
  Matrix3d pose_factor;
  pose_factor << 0.03, 0.0, 0.0, 0.01, 0.02, 0.0, -0.004, 0.006, 0.008;
  Matrix2d point_factor;
  point_factor << 0.015, 0.0, -0.02, 0.03;
  const Pose2 robot{-0.8, 0.4, 2.2};
  const Vector2d in_robot(1.5, -2.0);
  const Vector2d place = robot * in_robot;
  RandomStream random = make_stream(2, 0);
  std::normal_distribution<double> normal;
  constexpr int kDraws = 20000;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Vector3d d = pose_factor * Vector3d(normal(random), normal(random), normal(random));
    const Vector2d measured = in_robot + point_factor * Vector2d(normal(random), normal(random));
    const Fix fix =
        fix_at({robot.x + d.x(), robot.y + d.y(), robot.beta + d.z()}, pose_factor * pose_factor.transpose());
    const ObjectPosition object = object_position(fix, point_at(measured, point_factor * point_factor.transpose()));
    ASSERT_EQ(object.status, ObjectStatus::ok);
    const Vector2d e = object.in_field - place;
    sum += e.dot(object.covariance.ldlt().solve(e));
  }
  EXPECT_NEAR(sum / kDraws, 2.0, 0.06);
}

}  // namespace
}  // namespace movis::localization
