#include <gtest/gtest.h>

#include "movis/core/random.h"
#include "movis/world/world.h"
#include "support/temporary_folder.h"

namespace movis::world {
namespace {

using Eigen::Vector2d;
using test::expect_error;
using test::TemporaryFolder;

Fix fix_at(const Pose2& world_from_robot) {
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = world_from_robot;
  return fix;
}

Fix no_fix() {
  Fix fix = fix_at({9.0, 9.0, 9.0});  // means nothing
  fix.status = FixStatus::one_goal;
  return fix;
}

PointEstimate ball_at(double x, double y) {
  PointEstimate ball;
  ball.status = PointStatus::ok;
  ball.point = {x, y, 0.11};
  return ball;
}

PointEstimate no_ball() {
  PointEstimate ball = ball_at(9.0, 9.0);  // means nothing
  ball.status = PointStatus::not_seen;
  return ball;
}

// Pose (1, 2, 90°) and the ball 3 m ahead, both measured at 10 s.
World measured_world() {
  World world;
  world.time_s = 9.0;
  return updated(world, 10.0, {}, fix_at({1.0, 2.0, kPi / 2.0}), ball_at(0.0, 3.0));
}

void expect_near(const Vector2d& point, const Vector2d& expected) {
  EXPECT_LT((point - expected).norm(), 1e-12) << point.transpose();
}

TEST(World, KnowsNothingAtFirst) {
  const World world;
  EXPECT_FALSE(has_pose(world, {}));
  EXPECT_FALSE(has_ball(world, {}));
  const World later = updated(world, 1000.0, {0.1, 0.2, 0.3}, no_fix(), no_ball());
  EXPECT_FALSE(has_pose(later, {}));
  EXPECT_FALSE(has_ball(later, {}));
}

TEST(World, TakesWhatIsMeasured) {
  const World world = measured_world();
  EXPECT_EQ(world.time_s, 10.0);
  EXPECT_EQ(world.pose_age_s, 0.0);
  EXPECT_EQ(world.ball_age_s, 0.0);
  expect_near(world.world_from_robot.translation(), {1.0, 2.0});
  EXPECT_EQ(world.world_from_robot.beta, kPi / 2.0);
  expect_near(world.ball_in_robot, {0.0, 3.0});
}

// By hand: with β = 90° the robot's forward is the field's −X, so 1 m forward from (1, 2) is (0, 2), and the ball
// that was 3 m ahead is 2 m ahead. A quarter turn to the left then brings it to the right.
TEST(World, CarriedByAMove) {
  const World ahead = carried(measured_world(), 10.5, {0.0, 1.0, 0.0});
  EXPECT_EQ(ahead.time_s, 10.5);
  expect_near(ahead.world_from_robot.translation(), {0.0, 2.0});
  expect_near(ahead.ball_in_robot, {0.0, 2.0});

  const World turned = carried(ahead, 11.0, {0.0, 0.0, kPi / 2.0});
  expect_near(turned.world_from_robot.translation(), {0.0, 2.0});
  EXPECT_NEAR(turned.world_from_robot.beta, kPi, 1e-12);
  expect_near(turned.ball_in_robot, {2.0, 0.0});
}

// The ball rests, so however the robot moves, it stays where it is in the field.
TEST(World, CarriedBallStaysInTheField) {
  RandomStream random = make_stream(1, 0);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  World world = measured_world();
  for (int move = 0; move < 100; ++move) {
    const double x = uniform(random), y = uniform(random);
    world = carried(world, world.time_s + 0.1, {x, y, kPi * uniform(random)});
    expect_near(world.world_from_robot * world.ball_in_robot, {-2.0, 2.0});
  }
}

// An age is the time since the measurement, so it grows on the way into the future too.
TEST(World, CarriedWorldIsOlder) {
  const World world = carried(measured_world(), 10.25, {});
  EXPECT_EQ(world.pose_age_s, 0.25);
  EXPECT_EQ(world.ball_age_s, 0.25);
}

TEST(World, LostMeasurementsAreCarriedAndAge) {
  World world = updated(measured_world(), 10.25, {0.0, 1.0, 0.0}, no_fix(), ball_at(0.1, 2.1));
  expect_near(world.world_from_robot.translation(), {0.0, 2.0});
  EXPECT_EQ(world.pose_age_s, 0.25);
  expect_near(world.ball_in_robot, {0.1, 2.1});
  EXPECT_EQ(world.ball_age_s, 0.0);

  world = updated(world, 10.5, {0.0, 1.0, 0.0}, fix_at({0.5, 0.5, 0.0}), no_ball());
  expect_near(world.world_from_robot.translation(), {0.5, 0.5});
  EXPECT_EQ(world.pose_age_s, 0.0);
  expect_near(world.ball_in_robot, {0.1, 1.1});
  EXPECT_EQ(world.ball_age_s, 0.25);
}

TEST(World, StaleBeyondTheOldestAge) {
  const WorldOptions options{0.25, 0.5};
  World world = carried(measured_world(), 10.25, {});
  EXPECT_TRUE(has_pose(world, options));
  EXPECT_TRUE(has_ball(world, options));
  world = carried(world, 10.5, {});
  EXPECT_FALSE(has_pose(world, options));
  EXPECT_TRUE(has_ball(world, options));
  world = carried(world, 10.75, {});
  EXPECT_FALSE(has_ball(world, options));
}

TEST(World, SameInstantTwice) {
  const World world = updated(measured_world(), 10.0, {}, no_fix(), no_ball());
  EXPECT_EQ(world.pose_age_s, 0.0);
  expect_near(world.ball_in_robot, {0.0, 3.0});
}

TEST(World, TimeThatRunsBackwards) {
  const World world = measured_world();
  expect_error([&] { carried(world, 9.9, {}); }, {"10 s", "9.9 s", "order of time"});
  expect_error([&] { updated(world, 9.9, {}, no_fix(), no_ball()); }, {"9.9 s"});
  expect_error([&] { carried(world, std::numeric_limits<double>::quiet_NaN(), {}); }, {"nan"});
}

TEST(WorldOptions, ReadStrictly) {
  const TemporaryFolder folder;
  const auto read = [&](const char* text) {
    return read_world_options(YamlMap::read(folder.write("options.yaml", text)));
  };
  const WorldOptions options = read("max_ball_age_s: 0.2\n");
  EXPECT_EQ(options.max_ball_age_s, 0.2);
  EXPECT_EQ(options.max_pose_age_s, WorldOptions().max_pose_age_s);
  expect_error([&] { read("max_ball_age_s: 0.2\nmax_pose_age: 1\n"); }, {"options.yaml:2", "max_pose_age_s"});
  expect_error([&] { read("max_pose_age_s: -0.1\n"); }, {"options.yaml:1", "max_pose_age_s", "out of range"});
}

}  // namespace
}  // namespace movis::world
