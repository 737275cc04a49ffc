#include <gtest/gtest.h>

#include "control/robots.h"
#include "movis/control/percepts.h"

namespace movis::control {
namespace {

using Eigen::Vector2d;

Task task() {
  Task task;
  task.field.Fd = 2.0;
  task.field.Fw = 0.5;
  task.robot = plain_robot();
  return task;
}

const std::vector<Bearing>& no_bearings() {
  static const std::vector<Bearing> none;
  return none;
}

Observation seen(const Pose2& world_from_robot, const Vector2d& ball_in_robot) {
  world::World world;
  world.world_from_robot = world_from_robot;
  world.ball_in_robot = ball_in_robot;
  return {no_bearings(), world, 0.0};
}

Percepts perceive(const Pose2& world_from_robot, const Vector2d& ball_in_robot) {
  return perceive(seen(world_from_robot, ball_in_robot), task());
}

// The robot looks along β with the ball before its kicker; the ball is at `ball` in the field.
Observation ready_at(const Vector2d& ball, double beta) {
  const Vector2d ball_in_robot(0.0, 0.37);
  const Vector2d robot = ball - Pose2{0.0, 0.0, beta} * ball_in_robot;
  return seen({robot.x(), robot.y(), beta}, ball_in_robot);
}

bool kicks(const Vector2d& ball, double beta) {
  return should_kick(ready_at(ball, beta), task());
}

// By hand: the robot is at (0.5, 0.3), β = 30°, and the ball at (−0.3, 0.4) before it, to the left: 0.5 m away, at
// atan(3/4) = 0.6435011; the gap is 0.5 − 0.25 − 0.11. The goal is at (−0.5, 1.7) from the robot in field axes: √3.14 m
// away, at atan(0.5/1.7) − π/6 = −0.2375473. Turned by −30° that is (0.4169873, 1.7222432), so ball → goal is
// (0.7169873, 1.3222432), at −atan(0.7169873/1.3222432) = −0.4968742. The detour is −0.4968742 − 0.6435011.
TEST(Percepts, KnownAnswer) {
  const Percepts percepts = perceive({0.5, 0.3, kPi / 6.0}, {-0.3, 0.4});
  EXPECT_NEAR(percepts.ball_distance, 0.5, 1e-12);
  EXPECT_NEAR(percepts.ball_direction, 0.6435011, 1e-7);
  EXPECT_NEAR(percepts.ball_gap, 0.14, 1e-12);
  EXPECT_NEAR(percepts.target_in_robot.x(), 0.4169873, 1e-7);
  EXPECT_NEAR(percepts.target_in_robot.y(), 1.7222432, 1e-7);
  EXPECT_NEAR(percepts.target_distance, 1.7720045, 1e-7);
  EXPECT_NEAR(percepts.target_direction, -0.2375473, 1e-7);
  EXPECT_NEAR(percepts.detour, -1.1403753, 1e-7);
}

TEST(Percepts, DirectionsToAllSides) {
  EXPECT_NEAR(perceive({}, {0.0, 1.0}).ball_direction, 0.0, 1e-15);
  EXPECT_NEAR(perceive({}, {-1.0, 0.0}).ball_direction, kPi / 2.0, 1e-15);
  EXPECT_NEAR(perceive({}, {1.0, 0.0}).ball_direction, -kPi / 2.0, 1e-15);
  EXPECT_EQ(perceive({}, {0.0, -1.0}).ball_direction, kPi);  // never −π
  EXPECT_EQ(perceive({}, {-0.0, -1.0}).ball_direction, kPi);
}

TEST(Percepts, DetourBehindTheBallIsNone) {
  EXPECT_NEAR(perceive({0.0, -1.0, 0.0}, {0.0, 0.5}).detour, 0.0, 1e-15);
  EXPECT_NEAR(perceive({0.0, -1.0, 2.0}, inverse(Pose2{0.0, 0.0, 2.0}) * Vector2d(0.0, 0.5)).detour, 0.0, 1e-12);
}

// The ball lies between the robot and its own goal: half a turn round it, either way.
TEST(Percepts, DetourBeforeTheBallIsHalfATurn) {
  EXPECT_NEAR(perceive({0.0, 1.0, 0.0}, {0.0, -0.5}).detour, kPi, 1e-12);
}

// By hand: the ball lies 1 m to the left at the goal's height along Y... from the ball at (−1, 0), the goal at (0, 2)
// is at −atan(1/2) to the right of +Y; the robot sees the ball at +π/2.
TEST(Percepts, DetourToTheSide) {
  EXPECT_NEAR(perceive({}, {-1.0, 0.0}).detour, -std::atan(0.5) - kPi / 2.0, 1e-12);
  EXPECT_NEAR(perceive({}, {1.0, 0.0}).detour, std::atan(0.5) + kPi / 2.0, 1e-12);
}

// The robot turns on the spot: only directions change.
TEST(Percepts, DetourDoesNotDependOnTheHeading) {
  const Vector2d ball(0.4, 0.7);
  const Percepts percepts = perceive({-0.3, -0.2, 0.0}, inverse(Pose2{-0.3, -0.2, 0.0}) * ball);
  for (const double beta : {0.5, 2.0, kPi, -1.5, -3.0}) {
    const Pose2 pose{-0.3, -0.2, beta};
    const Percepts turned = perceive(pose, inverse(pose) * ball);
    EXPECT_NEAR(turned.ball_distance, percepts.ball_distance, 1e-12);
    EXPECT_NEAR(turned.target_distance, percepts.target_distance, 1e-12);
    EXPECT_NEAR(turned.detour, percepts.detour, 1e-12);
    EXPECT_NEAR(turn(percepts.ball_direction, turned.ball_direction), wrap_angle(-beta), 1e-12);
  }
}

TEST(Percepts, OverlappingEstimatesAreANegativeGap) {
  EXPECT_NEAR(perceive({}, {0.0, 0.3}).ball_gap, -0.06, 1e-12);
}

TEST(Percepts, BallOnTheTargetOrOnTheRobot) {
  EXPECT_TRUE(std::isfinite(perceive({}, {0.0, 2.0}).detour));
  EXPECT_TRUE(std::isfinite(perceive({}, {0.0, 0.0}).detour));
}

TEST(ShouldKick, StraightAtTheGoal) {
  EXPECT_TRUE(kicks({0.0, 0.0}, 0.0));
}

// The field's frame: a robot at (−1, 1) that looks along (1, 1) has β = −45°; along (−1, 1) it is +45°.
TEST(ShouldKick, FromTheSide) {
  EXPECT_TRUE(kicks({-1.0, 1.0}, -kPi / 4.0));
  EXPECT_FALSE(kicks({-1.0, 1.0}, kPi / 4.0));
  EXPECT_TRUE(kicks({1.0, 1.0}, kPi / 4.0));
}

TEST(ShouldKick, NotWithTheBallOutOfReach) {
  EXPECT_FALSE(should_kick(seen({}, {0.0, 0.42}), task()));
  EXPECT_FALSE(should_kick(seen({}, {0.12, 0.34}), task()));
  EXPECT_FALSE(should_kick(seen({}, {0.0, -0.37}), task()));
  EXPECT_TRUE(should_kick(seen({}, {0.0, 0.40}), task()));
}

TEST(ShouldKick, NotAwayFromTheGoal) {
  EXPECT_FALSE(kicks({0.0, 0.0}, kPi));
}

TEST(ShouldKick, NotAlongTheGoalLine) {
  EXPECT_FALSE(kicks({0.0, 1.99}, kPi / 2.0));
  EXPECT_FALSE(kicks({0.0, 1.99}, -kPi / 2.0));
}

TEST(ShouldKick, NotFromBeyondTheGoalLine) {
  EXPECT_FALSE(kicks({0.0, 2.01}, 0.0));
  EXPECT_FALSE(kicks({0.0, 2.01}, kPi));
}

// By hand: two sigma are 4°. From (x, 0), turned by 4° to the right, the right post at (0.5, 2) is passed at a distance
// of (0.5 − x) cos 4° − 2 sin 4°, which is the ball's 0.11 m at x = 0.5 − (0.11 + 0.1395130)/0.9975641 = 0.2498777.
TEST(ShouldKick, RoomForBallAndScatter) {
  EXPECT_TRUE(kicks({0.2497, 0.0}, 0.0));
  EXPECT_FALSE(kicks({0.2501, 0.0}, 0.0));
  EXPECT_TRUE(kicks({-0.2497, 0.0}, 0.0));
  EXPECT_FALSE(kicks({-0.2501, 0.0}, 0.0));
}

// By hand: from (0, −4) the posts stand at ±atan(0.5/6) = ±4.763642°, and the ball needs asin(0.11/√36.25) = 1.046889°
// beside them: a window of ±3.716753°, less than six sigma. Its middle third is ±1.238918°.
TEST(ShouldKick, MiddleThirdFromFarAway) {
  EXPECT_TRUE(kicks({0.0, -4.0}, radians(1.2388)));
  EXPECT_FALSE(kicks({0.0, -4.0}, radians(1.2390)));
  EXPECT_TRUE(kicks({0.0, -4.0}, radians(-1.2388)));
  EXPECT_FALSE(kicks({0.0, -4.0}, radians(-1.2390)));
}

// By hand, at β = 45° from (x, 1.5), which aims at the goal's centre with x = 0.5. Turned to 41°, the right post is
// passed at (0.5 − x) cos 41° + 0.5 sin 41°, which is 0.11 m at x = 0.7888919; turned to 49°, the left one at (0.5 + x)
// cos 49° − 0.5 sin 49°, at x = 0.2428520. The left post is farther along the way, so it needs more room.
TEST(ShouldKick, ObliqueRay) {
  EXPECT_TRUE(kicks({0.7887, 1.5}, kPi / 4.0));
  EXPECT_FALSE(kicks({0.7891, 1.5}, kPi / 4.0));
  EXPECT_TRUE(kicks({0.2431, 1.5}, kPi / 4.0));
  EXPECT_FALSE(kicks({0.2426, 1.5}, kPi / 4.0));
}

// By hand: from (3, 1.5) the left post is seen at atan2(3.5, 0.5) = 81.8699° and the ball needs asin(0.11/√12.5) =
// 1.7829° beside it, the right one at atan2(2.5, 0.5) = 78.6901° and asin(0.11/√6.5) = 2.4728°: there is no window.
TEST(ShouldKick, NeverWithoutRoomForTheBall) {
  for (const double beta_deg : {79.0, 80.0, 81.0, 81.5}) EXPECT_FALSE(kicks({3.0, 1.5}, radians(beta_deg)));
}

// By hand: from (2, 1.5) it is 78.6901° − 2.4728° = 76.2173° and 71.5651° + 3.9893° = 75.5544°: 0.6629° wide. The
// middle third ends at 75.7754° and 75.9963°.
TEST(ShouldKick, MiddleThirdOfANarrowWindow) {
  EXPECT_TRUE(kicks({2.0, 1.5}, radians(75.78)));
  EXPECT_FALSE(kicks({2.0, 1.5}, radians(75.77)));
  EXPECT_TRUE(kicks({2.0, 1.5}, radians(75.99)));
  EXPECT_FALSE(kicks({2.0, 1.5}, radians(76.00)));
}

TEST(ShouldKick, NeverThroughAGoalThatIsTooNarrow) {
  Task narrow = task();
  narrow.field.Fw = 0.1;
  EXPECT_FALSE(should_kick(ready_at({0.0, 1.5}, 0.0), narrow));
}

// Kicks from the rule's very edge, scattered, pass the posts in 97.7 % of the cases, which is two sigma on one side. A
// ball is a disc that must not touch the posts' inner corners.
TEST(ShouldKick, TwoSigmaPassThePosts) {
  RandomStream random = make_stream(1, 0);
  std::normal_distribution<double> scatter(0.0, radians(2.0));
  for (const auto& [x, y, beta] :
       {std::array{0.2498, 0.0, 0.0}, std::array{0.7888, 1.5, kPi / 4.0}, std::array{0.2429, 1.5, kPi / 4.0}}) {
    ASSERT_TRUE(kicks({x, y}, beta));
    int passed = 0;
    constexpr int kKicks = 20000;
    for (int kick = 0; kick < kKicks; ++kick) {
      const double along = beta + scatter(random);
      bool clear = true;
      for (const double post : {-0.5, 0.5}) {  // how far the ball's line passes the post, on the goal's side
        const double beside = (post - x) * std::cos(along) + (2.0 - y) * std::sin(along);
        clear = clear && (post < 0.0 ? -beside : beside) >= 0.11;
      }
      passed += clear ? 1 : 0;
    }
    EXPECT_GT(passed, 0.973 * kKicks);
    EXPECT_LT(passed, 0.981 * kKicks);  // and it does not ask for much more
  }
}

}  // namespace
}  // namespace movis::control
