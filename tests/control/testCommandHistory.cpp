#include <gtest/gtest.h>

#include "control/robots.h"
#include "movis/control/command_history.h"
#include "support/allocations.h"
#include "support/temporary_folder.h"

namespace movis::control {
namespace {

using test::expect_error;

Command forward(double vy) {
  return {{0.0, vy, 0.0}, false};
}

void expect_pose(const Pose2& pose, const Pose2& expected, double tolerance = 1e-12) {
  EXPECT_NEAR(pose.x, expected.x, tolerance);
  EXPECT_NEAR(pose.y, expected.y, tolerance);
  EXPECT_NEAR(turn(expected.beta, pose.beta), 0.0, tolerance);
}

// The latency of plain_robot is 0.2 s.
CommandHistory history_of(std::initializer_list<std::pair<double, Command>> sent) {
  CommandHistory history(plain_robot());
  history.start(0.0);
  for (const auto& [time_s, command] : sent) history.sent(command, time_s);
  return history;
}

TEST(CommandHistory, StandsStillWithoutCommands) {
  const CommandHistory history = history_of({});
  expect_pose(history.motion(-10.0, 10.0), {}, 0.0);
  EXPECT_EQ(history.velocity(5.0).vy, 0.0);
  expect_pose(CommandHistory(plain_robot()).motion(0.0, 1.0), {}, 0.0);
}

// By hand: 1 m/s sent at 1.0 s acts from 1.2 s on; at 2.5 m/s² it is reached at 1.6 s, after 1/2 · 2.5 · 0.4² = 0.2 m.
TEST(CommandHistory, ActsAfterTheLatencyAndRamps) {
  const CommandHistory history = history_of({{1.0, forward(1.0)}});
  expect_pose(history.motion(0.0, 1.2), {});
  EXPECT_EQ(history.velocity(1.2).vy, 0.0);
  EXPECT_NEAR(history.velocity(1.4).vy, 0.5, 1e-12);
  EXPECT_NEAR(history.velocity(1.6).vy, 1.0, 1e-12);
  expect_pose(history.motion(1.2, 1.6), {0.0, 0.2, 0.0});
  expect_pose(history.motion(1.0, 1.6), {0.0, 0.2, 0.0});
  expect_pose(history.motion(1.2, 1.4), {0.0, 0.05, 0.0});
}

// By hand: to 4 rad/s at 12 rad/s² it takes 1/3 s and 1/2 · 12 / 9 = 2/3 rad.
TEST(CommandHistory, TurnOnTheSpot) {
  const CommandHistory history = history_of({{0.0, {{0.0, 0.0, 4.0}, false}}});
  expect_pose(history.motion(0.2, 0.2 + 1.0 / 3.0), {0.0, 0.0, 2.0 / 3.0});
  expect_pose(history.motion(0.0, 1.2 + 1.0 / 3.0), {0.0, 0.0, 2.0 / 3.0 + 4.0});
}

TEST(CommandHistory, TheLastCommandHolds) {
  const CommandHistory history = history_of({{0.0, forward(1.0)}});
  EXPECT_EQ(history.velocity(1000.0).vy, 1.0);
  expect_pose(history.motion(1.0, 1000.0), {0.0, 999.0, 0.0}, 1e-9);
}

// By hand: 1 m/s acts from 0.2 s on and the stop from 0.4 s on, at 0.5 m/s: 0.05 m on the way up, 0.05 m down, done at
// 0.6 s.
TEST(CommandHistory, StopCutsTheRamp) {
  const CommandHistory history = history_of({{0.0, forward(1.0)}, {0.2, {}}});
  EXPECT_NEAR(history.velocity(0.4).vy, 0.5, 1e-12);
  EXPECT_NEAR(history.velocity(0.6).vy, 0.0, 1e-12);
  expect_pose(history.motion(0.0, 10.0), {0.0, 0.1, 0.0});
}

// By hand: forward at 1 m/s and turning at 1 rad/s is a circle of radius 1 m; half of it ends 2 m to the left.
TEST(CommandHistory, HalfACircle) {
  const CommandHistory history = history_of({{0.0, {{0.0, 1.0, 1.0}, false}}});
  expect_pose(history.motion(1.0, 1.0 + kPi), {-2.0, 0.0, kPi});
}

TEST(CommandHistory, ASecondCommandOfTheSameTimeReplacesTheFirst) {
  const CommandHistory history = history_of({{0.0, forward(1.0)}, {0.5, forward(-1.0)}, {0.5, forward(1.0)}});
  expect_pose(history.motion(0.2, 3.2), history_of({{0.0, forward(1.0)}}).motion(0.2, 3.2));
}

TEST(CommandHistory, NoLatency) {
  RobotModel robot = plain_robot();
  robot.latency_frames = 0;
  CommandHistory history(robot);
  history.sent(forward(1.0), 1.0);
  expect_pose(history.motion(1.0, 1.4), {0.0, 0.2, 0.0});
}

TEST(CommandHistory, KeepsTheRobotsSpeeds) {
  EXPECT_EQ(history_of({{0.0, {{0.0, 9.0, 9.0}, false}}}).velocity(10.0).vy, 1.5);
  EXPECT_EQ(history_of({{0.0, {{0.0, 9.0, 9.0}, false}}}).velocity(10.0).omega, 4.0);
}

TEST(CommandHistory, ComposesAndInverts) {
  RandomStream random = make_stream(1, 0);
  std::uniform_real_distribution<double> uniform(0.0, 2.2);
  CommandHistory history = history_of({});
  for (int frame = 0; frame < 20; ++frame) history.sent({draw_twist(random, 1.0, 4.0), false}, 0.1 * frame);
  for (int draw = 0; draw < 100; ++draw) {
    const double a = uniform(random), b = uniform(random), c = uniform(random);
    expect_pose(history.motion(a, c), history.motion(a, b) * history.motion(b, c), 2e-6);
    expect_pose(history.motion(b, a), inverse(history.motion(a, b)));
  }
}

// A robot that is driven by the same commands ends where the history says, at any time.
TEST(CommandHistory, RoundTripThroughADrivenRobot) {
  RandomStream random = make_stream(2, 0);
  for (const double period : {1.0 / 30.0, 0.1, 0.3}) {
    CommandHistory history = history_of({});
    KinematicRobot robot(plain_robot());
    Pose2 start_from_robot;
    double time_s = 0.0;
    for (int frame = 0; frame < 40; ++frame) {
      const Command command{draw_twist(random, 1.0, 4.0), false};
      history.sent(command, time_s);
      robot.send(command, time_s);
      robot.advance(time_s + period);
      start_from_robot = start_from_robot * history.motion(time_s, time_s + period);
      time_s += period;
      expect_pose(start_from_robot, robot.world_from_robot(), 5e-6);
    }
  }
}

TEST(CommandHistory, TimesMustNotFall) {
  CommandHistory history = history_of({{1.0, {}}});
  expect_error([&] { history.sent({}, 0.9); }, {"0.9 s", "1 s", "order of time"});
  expect_error([&] { history.sent({}, std::numeric_limits<double>::quiet_NaN()); }, {"nan"});
  history.start(0.5);
  expect_error([&] { history.sent({}, 0.4); }, {"0.4 s"});
}

TEST(CommandHistory, StartForgets) {
  CommandHistory history = history_of({{1.0, forward(1.0)}});
  history.start(0.5);
  expect_pose(history.motion(0.0, 10.0), {}, 0.0);
}

// Of 1000 commands, the last 32 that act are known; what was before is an error, not a wrong answer.
TEST(CommandHistory, ForgetsTheDistantPast) {
  CommandHistory history = history_of({});
  for (int frame = 0; frame <= 1000; ++frame) history.sent(forward(1.0), frame);
  expect_pose(history.motion(969.0, 1000.0), {0.0, 31.0, 0.0}, 1e-9);
  expect_error([&] { (void)history.motion(960.0, 1000.0); }, {"960 s", "forgotten"});
  expect_error([&] { (void)history.velocity(0.0); }, {"forgotten"});
}

TEST(CommandHistory, AllocatesNothingInTheLongRun) {
#if defined(MOVIS_COUNTS_ALLOCATIONS)
  CommandHistory history = history_of({});
  double way = 0.0;
  const int allocations = test::allocations_in([&] {
    for (int frame = 0; frame < 1000; ++frame) {
      history.sent(forward(frame % 2), 0.1 * frame);
      way += history.motion(0.1 * frame, 0.1 * frame + 0.2).y;
    }
  });
  EXPECT_EQ(allocations, 0);
  EXPECT_GT(way, 0.0);
#else
  GTEST_SKIP() << "the sanitizer owns malloc; the release and dev presets run this test";
#endif
}

}  // namespace
}  // namespace movis::control
