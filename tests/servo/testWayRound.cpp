#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "movis/servo/way_round.h"

namespace movis::servo {
namespace {

using Eigen::Vector2d;

constexpr WayRound kWay{0.36, 0.48, radians(40.0)};

Vector2d place(double distance, double detour) {
  return distance * Vector2d(-std::sin(detour), -std::cos(detour));
}

void expect_point(const Vector2d& point, const Vector2d& expected) {
  EXPECT_NEAR(point.x(), expected.x(), 1e-12);
  EXPECT_NEAR(point.y(), expected.y(), 1e-12);
}

double distance_to_origin(const Vector2d& from, const Vector2d& to) {
  const Vector2d way = to - from;
  const double part = way.isZero(0.0) ? 0.0 : std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from + part * way).norm();
}

// By hand: from the ball's right (+x), the robot looks along −x at the ball, and the goal lies a quarter turn to the
// right of that: −90°. From the far side the turn is half a turn, counted as +180°.
TEST(WayRound, Detour) {
  EXPECT_NEAR(detour_of({0.0, -1.0}), 0.0, 1e-15);
  EXPECT_NEAR(detour_of({1.0, 0.0}), -kPi / 2.0, 1e-15);
  EXPECT_NEAR(detour_of({-1.0, 0.0}), kPi / 2.0, 1e-15);
  EXPECT_NEAR(std::abs(detour_of({0.0, 1.0})), kPi, 1e-15);
  EXPECT_EQ(detour_of({0.0, 0.0}), 0.0);
}

// By hand, with a circle of 0.48 m: from 0.96 m the tangent touches after acos(0.5) = 60°. 40° beyond, the tangent is
// 0.48/cos 40° from the ball. From the far side, 180°, the point lies 180° − 100° = 80° before the shooting place.
TEST(WayRound, KnownAnswer) {
  expect_point(waypoint_in_shot(kWay, 0.96, kPi), place(0.48 / std::cos(radians(40.0)), radians(80.0)));
  expect_point(waypoint_in_shot(kWay, 0.96, -kPi), place(0.48 / std::cos(radians(40.0)), radians(-80.0)));
}

TEST(WayRound, WaypointLiesOnTheTangent) {
  for (const double distance : {0.48, 0.5, 0.7, 1.3, 3.0}) {
    const double detour = radians(170.0);
    const Vector2d from = place(distance, detour);
    const Vector2d way = waypoint_in_shot(kWay, distance, detour) - from;
    const Vector2d normal = Vector2d(-way.y(), way.x()).normalized();
    EXPECT_NEAR(std::abs(normal.dot(from)), kWay.orbit, 1e-9) << distance;
  }
}

// On the circle the way is along the circle; inside it, it is outwards.
TEST(WayRound, LeavesNoCircleInwards) {
  const double detour = radians(150.0);
  for (const double distance : {0.48, 0.42, 0.36}) {
    const Vector2d from = place(distance, detour);
    const double outwards = from.normalized().dot(waypoint_in_shot(kWay, distance, detour) - from);
    EXPECT_NEAR(outwards, kWay.orbit - distance, 1e-12);
  }
}

TEST(WayRound, StraightWhereTheShootingPlaceIsInSight) {
  for (const double distance : {0.5, 0.8, 2.0}) {
    const double in_sight = std::acos(kWay.orbit / distance);
    for (const double part : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
      const Vector2d waypoint = waypoint_in_shot(kWay, distance, part * in_sight);
      expect_point(waypoint, {0.0, -0.36});
      EXPECT_GE(distance_to_origin(place(distance, part * in_sight), waypoint), 0.36 - 1e-12);
    }
  }
}

// The field of directions has one rest, the shooting place, and following it never meets the ball.
TEST(WayRound, FollowedFromEverywhereItEndsBehindTheBallAndNeverTouchesIt) {
  for (double distance = 0.36; distance < 4.0; distance *= 1.3) {
    for (int degree = -180; degree <= 180; degree += 15) {
      Vector2d robot = place(distance, radians(degree));
      double nearest = robot.norm();
      for (int i = 0; i < 4000; ++i) {
        robot += 0.01 * (waypoint_in_shot(kWay, robot.norm(), detour_of(robot)) - robot);
        nearest = std::min(nearest, robot.norm());
      }
      EXPECT_LT((robot - Vector2d(0.0, -0.36)).norm(), 1e-6) << distance << " m, " << degree << "°";
      EXPECT_GT(nearest, 0.36 - 1e-3) << distance << " m, " << degree << "°";
    }
  }
}

TEST(WayRound, RobotAtTheBallsCentre) {
  expect_point(waypoint_in_shot(kWay, 0.0, 0.0), {0.0, -0.36});
}

TEST(WayRound, TheLongerWayIsKept) {
  const double detour = radians(200.0);  // 160° the other way
  const Vector2d waypoint = waypoint_in_shot(kWay, 0.48, detour);
  expect_point(waypoint, place(0.48 / std::cos(radians(40.0)), radians(160.0)));
}

// By hand, with posts at (±0.5, ±2) and walls 0.25 m behind them, at 0.27 m.
TEST(WayRound, ClearOfGoals) {
  Field field;
  field.Fd = 2.0;
  field.Fw = 0.5;
  field.goal_depth = 0.25;
  expect_point(clear_of_goals({0.3, 1.2}, field, 0.27), {0.3, 1.2});
  expect_point(clear_of_goals({0.5, -1.9}, field, 0.27), {0.5, -1.73});         // before a post
  expect_point(clear_of_goals({-0.7, 2.1}, field, 0.27), {-0.77, 2.1});         // beside a wall
  expect_point(clear_of_goals({-0.44, -1.92}, field, 0.27), {-0.338, -1.784});  // 0.1 m from a post: (0.6, 0.8)
  expect_point(clear_of_goals({0.5, 2.1}, field, 0.27), {0.23, 2.1});           // on a wall
}

}  // namespace
}  // namespace movis::servo
