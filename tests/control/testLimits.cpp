#include <gtest/gtest.h>

#include "control/robots.h"
#include "movis/control/limits.h"
#include "movis/control/wheels.h"

namespace movis::control {
namespace {

constexpr double kLong = 100.0;  // seconds; enough for any change

void expect_twist(const Twist2& twist, const Twist2& expected, double tolerance = 1e-12) {
  EXPECT_NEAR(twist.vx, expected.vx, tolerance);
  EXPECT_NEAR(twist.vy, expected.vy, tolerance);
  EXPECT_NEAR(twist.omega, expected.omega, tolerance);
}

double change(const Twist2& from, const Twist2& to) {
  return (to.translation() - from.translation()).norm();
}

void expect_speeds_kept(const Twist2& twist, const RobotModel& robot) {
  EXPECT_LE(twist.translation().norm(), robot.limits.speed + 1e-12);
  EXPECT_LE(std::abs(twist.omega), robot.limits.turn_rate + 1e-12);
  if (robot.wheels) {
    EXPECT_LE(wheel_rates(*robot.wheels, twist).cwiseAbs().maxCoeff(), robot.wheels->max_rate + 1e-9);
  }
}

// By hand: (3, 4) is 5 m/s; at 1.5 m/s in the same direction it is (0.9, 1.2).
TEST(Limits, SpeedKeepsItsDirection) {
  expect_twist(limited({3.0, 4.0, 0.0}, {}, plain_robot(), kLong), {0.9, 1.2, 0.0});
  expect_twist(limited({0.0, 0.0, -10.0}, {}, plain_robot(), kLong), {0.0, 0.0, -4.0});
}

TEST(Limits, WhatIsWithinThemIsKept) {
  expect_twist(limited({0.6, -0.8, 3.0}, {}, plain_robot(), kLong), {0.6, -0.8, 3.0}, 0.0);
}

// By hand: in 0.1 s the translation changes by 0.25 m/s at most, the turn by 1.2 rad/s. From (1, 0) to (0.4, 0.8) is a
// change of (−0.6, 0.8), so it comes to (0.85, 0.2).
TEST(Limits, AccelerationKeepsTheChangesDirection) {
  expect_twist(limited({0.6, 0.8, 0.0}, {}, plain_robot(), 0.1), {0.15, 0.2, 0.0});
  expect_twist(limited({0.4, 0.8, 0.0}, {1.0, 0.0, 0.0}, plain_robot(), 0.1), {0.85, 0.2, 0.0});
  expect_twist(limited({0.0, 0.0, -4.0}, {0.0, 0.0, 4.0}, plain_robot(), 0.1), {0.0, 0.0, 2.8});
}

// Translation and turn do not wait for each other.
TEST(Limits, TurnIsReachedBeforeTheTranslation) {
  expect_twist(limited({0.0, 1.0, 0.5}, {}, plain_robot(), 0.1), {0.0, 0.25, 0.5});
}

TEST(Limits, BrakingEndsAtRest) {
  expect_twist(limited({}, {0.0, 0.2, 1.0}, plain_robot(), 0.1), {}, 0.0);
}

TEST(Limits, NoTimeNoChange) {
  expect_twist(limited({1.0, 1.0, 1.0}, {0.5, 0.0, -1.0}, plain_robot(), 0.0), {0.5, 0.0, -1.0}, 0.0);
}

// A robot that is pushed is faster than its limits: it is brought back no faster than it can brake.
TEST(Limits, FromBeyondTheLimits) {
  expect_twist(limited({3.0, 0.0, 9.0}, {3.0, 0.0, 9.0}, plain_robot(), 0.1), {2.75, 0.0, 7.8});
  expect_twist(limited({3.0, 0.0, 9.0}, {3.0, 0.0, 9.0}, plain_robot(), kLong), {1.5, 0.0, 4.0});
}

TEST(Limits, HugeCommand) {
  expect_twist(limited({0.0, 1e300, 1e300}, {}, plain_robot(), kLong), {0.0, 1.5, 4.0});
}

// By hand, wheels of 20 rad/s: at (0, 1, 4) the wheels turn at 16, −17.32 + 16 and 17.32 + 16 = 33.32 rad/s, so all
// three components shrink by 20/33.32.
TEST(Limits, WheelsShrinkAllComponentsTogether) {
  const double shrink = 20.0 / (10.0 * std::sqrt(3.0) + 16.0);
  expect_twist(limited({0.0, 1.0, 4.0}, {}, wheeled_robot(20.0), kLong), {0.0, shrink, 4.0 * shrink});
}

// By hand: (1.2, 0, 2) asks −24 + 8 = −16, 12 + 8 = 20 and 20 rad/s of the wheels, which they can do. With 1 rad/s²,
// 0.5 s bring the whole translation (1.25 m/s are possible) but only 0.5 rad/s of the turn; at (1.2, 0, 0.5) the first
// wheel would turn at −24 + 2 = −22. It can do (1.1, 0, 0.5): −22 + 2 = −20.
TEST(Limits, WheelsHoldBackTheQuickerOfTranslationAndTurn) {
  RobotModel robot = wheeled_robot(20.0);
  robot.limits.turn_acceleration = 1.0;
  expect_twist(limited({1.2, 0.0, 2.0}, {}, robot, 0.5), {1.1, 0.0, 0.5});
}

TEST(Limits, WheelsThatCanDoAnythingChangeNothing) {
  RandomStream random = make_stream(1, 0);
  for (int draw = 0; draw < 200; ++draw) {
    const Twist2 wanted = draw_twist(random, 3.0, 8.0), current = draw_twist(random, 1.0, 4.0);
    expect_twist(limited(wanted, current, wheeled_robot(1000.0), 0.1), limited(wanted, current, plain_robot(), 0.1));
  }
}

// From rest on, whatever is wanted, every limit is kept at every step.
TEST(Limits, AllKeptOnAnyWay) {
  for (const RobotModel& robot : {plain_robot(), wheeled_robot(20.0), wheeled_robot(5.0)}) {
    RandomStream random = make_stream(2, 0);
    std::uniform_real_distribution<double> duration(0.0, 0.3);
    Twist2 current;
    for (int step = 0; step < 2000; ++step) {
      const Twist2 wanted = draw_twist(random, 3.0, 8.0);
      const double seconds = duration(random);
      const Twist2 next = limited(wanted, current, robot, seconds);
      expect_speeds_kept(next, robot);
      EXPECT_LE(change(current, next), robot.limits.acceleration * seconds + 1e-12);
      EXPECT_LE(std::abs(next.omega - current.omega), robot.limits.turn_acceleration * seconds + 1e-12);
      current = next;
    }
  }
}

// Without wheels, two steps come as far as one of both times: whoever models the robot may choose their length.
TEST(Limits, StepsCompose) {
  const RobotModel robot = plain_robot();
  RandomStream random = make_stream(3, 0);
  for (int draw = 0; draw < 200; ++draw) {
    const Twist2 wanted = draw_twist(random, 3.0, 8.0), current = draw_twist(random, 1.0, 4.0);
    expect_twist(limited(wanted, limited(wanted, current, robot, 0.07), robot, 0.15),
                 limited(wanted, current, robot, 0.22));
  }
}

// By hand: 1.5 m/s at 2.5 m/s² take 0.6 s, 4 rad/s at 12 rad/s² a third of a second.
TEST(Limits, SettlingTime) {
  EXPECT_NEAR(settling_time({3.0, 4.0, 2.0}, {}, plain_robot()), 0.6, 1e-12);
  EXPECT_NEAR(settling_time({0.1, 0.0, 9.0}, {}, plain_robot()), 1.0 / 3.0, 1e-12);
  EXPECT_EQ(settling_time({0.1, 0.2, 0.3}, {0.1, 0.2, 0.3}, plain_robot()), 0.0);
}

TEST(Limits, NothingChangesAfterTheSettlingTime) {
  for (const RobotModel& robot : {plain_robot(), wheeled_robot(20.0), wheeled_robot(5.0)}) {
    RandomStream random = make_stream(4, 0);
    for (int draw = 0; draw < 200; ++draw) {
      const Twist2 wanted = draw_twist(random, 3.0, 8.0);
      const Twist2 current = limited(draw_twist(random, 3.0, 8.0), {}, robot, kLong);
      const double settled = settling_time(wanted, current, robot);
      const Twist2 end = limited(wanted, current, robot, kLong);
      expect_twist(limited(wanted, current, robot, settled * (1.0 + 1e-12)), end, 1e-9);
      const Twist2 before = limited(wanted, current, robot, settled - 0.01);
      EXPECT_GT(change(before, end) + std::abs(before.omega - end.omega), 1e-3);
    }
  }
}

}  // namespace
}  // namespace movis::control
