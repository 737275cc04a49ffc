#include <gtest/gtest.h>

#include "movis/core/random.h"
#include "movis/core/twist.h"

namespace movis {
namespace {

void expect_pose(const Pose2& pose, const Pose2& expected, double tolerance) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(turn(expected.beta, pose.beta), 0.0, tolerance);
}

Twist2 draw_twist(RandomStream& random) {
  std::uniform_real_distribution<double> speed(-2.0, 2.0);
  std::uniform_real_distribution<double> rate(-5.0, 5.0);
  const double vx = speed(random), vy = speed(random);
  return {vx, vy, rate(random)};
}

TEST(Twist, Straight) {
  expect_pose(start_from_end({0.5, -1.0, 0.0}, 3.0), {1.5, -3.0, 0.0}, 1e-15);
}

TEST(Twist, TurnOnTheSpot) {
  expect_pose(start_from_end({0.0, 0.0, -0.5}, 3.0), {0.0, 0.0, -1.5}, 1e-15);
}

// By hand: forward at 1 m/s, turning left at π/2 rad/s, is a circle of radius 2/π about (−2/π, 0). A quarter of it ends
// at (−2/π, 2/π), half at (−4/π, 0), all of it at the start.
TEST(Twist, QuarterHalfAndWholeCircle) {
  const Twist2 twist{0.0, 1.0, kPi / 2.0};
  expect_pose(start_from_end(twist, 1.0), {-2.0 / kPi, 2.0 / kPi, kPi / 2.0}, 1e-15);
  expect_pose(start_from_end(twist, 2.0), {-4.0 / kPi, 0.0, kPi}, 1e-15);
  expect_pose(start_from_end(twist, 4.0), {0.0, 0.0, 0.0}, 1e-15);
}

// By hand: to the right at 1 m/s, turning right at π/2 rad/s, is a circle about (0, −2/π).
TEST(Twist, SidewaysToTheRight) {
  expect_pose(start_from_end({1.0, 0.0, -kPi / 2.0}, 1.0), {2.0 / kPi, -2.0 / kPi, -kPi / 2.0}, 1e-15);
}

TEST(Twist, NoTime) {
  expect_pose(start_from_end({1.0, 2.0, 3.0}, 0.0), {0.0, 0.0, 0.0}, 0.0);
}

// A twist that is kept composes with itself, whatever its turn; kept backwards, it undoes itself.
TEST(Twist, ComposesAndInverts) {
  RandomStream random = make_stream(1, 0);
  std::uniform_real_distribution<double> duration(0.0, 2.0);
  for (int draw = 0; draw < 200; ++draw) {
    const Twist2 twist = draw_twist(random);
    const double first = duration(random), second = duration(random);
    const Pose2 both = start_from_end(twist, first) * start_from_end(twist, second);
    expect_pose(start_from_end(twist, first + second), both, 1e-13);
    expect_pose(start_from_end(twist, -first), inverse(start_from_end(twist, first)), 1e-13);
  }
}

// By hand, to the third order in the angle θ: forward by y, the robot ends at (−y (θ/2 − θ³/24), y (1 − θ²/6)). Where
// the formula changes, nothing may jump.
TEST(Twist, SmallAngles) {
  for (const double angle : {0.0, 1e-300, 1e-9, 0.999999e-6, 1.000001e-6, 1e-5, 1e-3, -0.999999e-6, -1e-3}) {
    const Pose2 pose = start_from_end({0.0, 1.0, angle}, 1.0);
    EXPECT_NEAR(pose.x, -(angle / 2.0 - angle * angle * angle / 24.0), 1e-9) << angle;
    EXPECT_NEAR(pose.y, 1.0 - angle * angle / 6.0, 1e-12) << angle;
    EXPECT_DOUBLE_EQ(pose.beta, angle);
  }
}

}  // namespace
}  // namespace movis
