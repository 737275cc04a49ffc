#include <gtest/gtest.h>

#include <limits>

#include "control/robots.h"
#include "movis/control/drive.h"
#include "support/temporary_folder.h"

namespace movis::control {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Says what it is told to say, and keeps what it was shown.
class Puppet : public Controller {
 public:
  Command answer;
  std::vector<world::World> shown;
  double time_s = 0.0;
  std::size_t bearings = 0;

  void start() override {}
  Command step(const Observation& observation) override {
    shown.push_back(observation.world);
    time_s = observation.time_s;
    bearings = observation.bearings.size();
    return answer;
  }
  const std::vector<Signal>& signals() const override { return none_; }

 private:
  std::vector<Signal> none_;
};

world::World fresh(double time_s) {
  world::World world;
  world.time_s = time_s;
  world.ball_in_robot = {0.0, 2.0};
  world.pose_age_s = world.ball_age_s = 0.0;
  return world;
}

world::World aged(world::World world, double pose_age_s, double ball_age_s) {
  world.pose_age_s = pose_age_s;
  world.ball_age_s = ball_age_s;
  return world;
}

// A drive whose robot, of plain_robot, goes straight ahead at 1 m/s: 0.25 m/s more with every frame of 0.1 s.
struct Rolling {
  Drive drive{plain_robot(), {}};
  Puppet controller;
  double time_s = 0.0;

  Rolling() {
    drive.start(0.0);
    controller.answer = {{0.0, 1.0, 0.0}, true};
    for (int frame = 0; frame < 10; ++frame) step(fresh(0.0));
  }
  Command step(world::World world) {
    world.time_s = time_s;
    time_s += 0.1;
    return drive.step(controller, {}, world);
  }
};

void expect_braking_to_rest(Rolling& rolling, const world::World& world, DriveStatus status) {
  for (const double expected : {0.75, 0.5, 0.25, 0.0, 0.0}) {
    const Command command = rolling.step(world);
    EXPECT_EQ(rolling.drive.status(), status);
    EXPECT_NEAR(command.velocity.vy, expected, 1e-9);
    EXPECT_FALSE(command.kick);
  }
}

TEST(Drive, LimitsTheChangePerFrame) {
  Drive drive(plain_robot(), {});
  drive.start(0.0);
  Puppet controller;
  controller.answer = {{0.0, 9.0, -9.0}, false};
  for (const auto& [frame, vy, omega] : {std::array{0.0, 0.25, -1.2}, std::array{1.0, 0.5, -2.4},
                                         std::array{2.0, 0.75, -3.6}, std::array{3.0, 1.0, -4.0}}) {
    const Command command = drive.step(controller, {}, fresh(0.1 * frame));
    EXPECT_NEAR(command.velocity.vy, vy, 1e-9);
    EXPECT_NEAR(command.velocity.omega, omega, 1e-9);
  }
}

TEST(Drive, PassesTheKickAndTheBearingsOn) {
  Drive drive(plain_robot(), {});
  drive.start(0.0);
  Puppet controller;
  controller.answer.kick = true;
  EXPECT_TRUE(drive.step(controller, std::vector<Bearing>(3), fresh(0.5)).kick);
  EXPECT_EQ(controller.bearings, 3U);
  EXPECT_EQ(controller.time_s, 0.5);
  EXPECT_EQ(drive.status(), DriveStatus::ok);
}

// By hand: the latency is two frames. At the third, the first command (0.25 m/s, from 0.2 s on) is about to act, the
// second (0.5 m/s) follows at 0.3 s; by 0.4 s, the third's turn, the robot will have ramped to 0.25 and 0.5 m/s: 0.0125
// + 0.0375 m.
TEST(Drive, ShowsTheWorldAsItWillBe) {
  Drive drive(plain_robot(), {});
  drive.start(0.0);
  Puppet controller;
  controller.answer = {{0.0, 1.0, 0.0}, false};
  for (int frame = 0; frame < 3; ++frame) drive.step(controller, {}, fresh(0.1 * frame));
  const world::World& first = controller.shown.front();
  EXPECT_NEAR(first.time_s, 0.2, 1e-12);
  EXPECT_NEAR(first.ball_in_robot.y(), 2.0, 1e-12);
  const world::World& third = controller.shown.back();
  EXPECT_NEAR(third.time_s, 0.4, 1e-12);
  EXPECT_NEAR(third.ball_in_robot.y(), 2.0 - 0.05, 1e-9);
  EXPECT_NEAR(third.world_from_robot.y, 0.05, 1e-9);
}

// One frame without any measurement: the world is carried on, and the robot goes on.
TEST(Drive, LostFrameDoesNotStopTheRobot) {
  Rolling rolling;
  world::World world = fresh(rolling.time_s - 0.1);
  for (int lost = 0; lost < 5; ++lost) {  // up to the 0.5 s of WorldOptions
    world = world::updated(world, rolling.time_s, rolling.drive.motion(world.time_s, rolling.time_s), {}, {});
    world.pose_age_s -= 1e-9;  // five tenths may sum to more than a half
    world.ball_age_s -= 1e-9;
    const Command command = rolling.step(world);
    EXPECT_EQ(rolling.drive.status(), DriveStatus::ok);
    EXPECT_NEAR(command.velocity.vy, 1.0, 1e-9);
    EXPECT_TRUE(command.kick);
  }
}

TEST(Drive, StalePoseStopsTheRobot) {
  Rolling rolling;
  const std::size_t calls = rolling.controller.shown.size();
  expect_braking_to_rest(rolling, aged(fresh(0.0), 0.51, 0.0), DriveStatus::stale_pose);
  EXPECT_EQ(rolling.controller.shown.size(), calls);  // no controller acts on it
}

TEST(Drive, StaleBallStopsTheRobot) {
  Rolling rolling;
  const std::size_t calls = rolling.controller.shown.size();
  expect_braking_to_rest(rolling, aged(fresh(0.0), 0.0, 0.51), DriveStatus::stale_ball);
  EXPECT_EQ(rolling.controller.shown.size(), calls);
}

TEST(Drive, NoWorldAtAllStopsTheRobot) {
  Rolling rolling;
  expect_braking_to_rest(rolling, {}, DriveStatus::stale_pose);
}

// Ages are judged at the time of the images: the 0.2 s of latency that are still to come do not make it stale.
TEST(Drive, LatencyDoesNotMakeTheWorldStale) {
  Rolling rolling;
  rolling.step(aged(fresh(0.0), 0.49, 0.49));
  EXPECT_EQ(rolling.drive.status(), DriveStatus::ok);
  EXPECT_NEAR(rolling.controller.shown.back().pose_age_s, 0.69, 1e-12);
}

TEST(Drive, GoesOnAfterAStaleWorld) {
  Rolling rolling;
  rolling.step(aged(fresh(0.0), 1.0, 0.0));
  EXPECT_NEAR(rolling.step(fresh(0.0)).velocity.vy, 1.0, 1e-9);
  EXPECT_EQ(rolling.drive.status(), DriveStatus::ok);
}

TEST(Drive, CommandThatIsNoNumberStopsTheRobot) {
  for (const Twist2& bad : {Twist2{kNan, 0.0, 0.0}, Twist2{0.0, kInfinity, 0.0}, Twist2{0.0, 1.0, -kInfinity}}) {
    Rolling rolling;
    rolling.controller.answer = {bad, true};
    expect_braking_to_rest(rolling, fresh(0.0), DriveStatus::not_finite);
  }
}

TEST(Drive, GoesOnAfterACommandThatWasNoNumber) {
  Rolling rolling;
  rolling.controller.answer.velocity.vx = kNan;
  EXPECT_NEAR(rolling.step(fresh(0.0)).velocity.vy, 0.75, 1e-9);
  rolling.controller.answer.velocity.vx = 0.0;
  EXPECT_NEAR(rolling.step(fresh(0.0)).velocity.vy, 1.0, 1e-9);
  EXPECT_EQ(rolling.drive.status(), DriveStatus::ok);
}

TEST(Drive, StartStandsStill) {
  Rolling rolling;
  rolling.drive.start(0.0);
  EXPECT_EQ(rolling.drive.motion(0.0, 10.0).y, 0.0);
  EXPECT_NEAR(rolling.drive.step(rolling.controller, {}, fresh(0.0)).velocity.vy, 0.25, 1e-12);
}

TEST(Drive, TimeMustNotFall) {
  Rolling rolling;
  test::expect_error([&] { rolling.drive.step(rolling.controller, {}, fresh(0.5)); }, {"0.5 s", "order of time"});
}

// A controller that wants anything, on a robot that obeys: world, carried by the drive's motion alone, keeps to where
// the robot is, and what the controller is shown is where the robot will be.
TEST(Drive, RoundTripThroughADrivenRobot) {
  RandomStream random = make_stream(1, 0);
  Drive drive(plain_robot(), {});
  drive.start(0.0);
  Puppet controller;
  KinematicRobot robot(plain_robot());
  std::vector<Pose2> driven;
  world::World world = fresh(0.0);
  for (int frame = 0; frame < 50; ++frame) {
    const double time_s = 0.1 * frame;
    robot.advance(time_s);
    driven.push_back(robot.world_from_robot());
    world = world::updated(world, time_s, drive.motion(world.time_s, time_s), {}, {});
    world = aged(world, 0.0, 0.0);
    controller.answer.velocity = draw_twist(random, 3.0, 8.0);
    robot.send(drive.step(controller, {}, world), time_s);
  }
  for (std::size_t frame = 0; frame + 2 < driven.size(); ++frame) {
    const world::World& shown = controller.shown[frame];
    const Pose2& then = driven[frame + 2];  // the latency of two frames
    EXPECT_NEAR(shown.world_from_robot.x, then.x, 5e-6);
    EXPECT_NEAR(shown.world_from_robot.y, then.y, 5e-6);
    EXPECT_NEAR(turn(shown.world_from_robot.beta, then.beta), 0.0, 5e-6);
    const Eigen::Vector2d ball_in_world = shown.world_from_robot * shown.ball_in_robot;
    EXPECT_LT((ball_in_world - Eigen::Vector2d(0.0, 2.0)).norm(), 1e-9);
  }
}

TEST(Drive, StatusWords) {
  EXPECT_STREQ(word(DriveStatus::ok), "ok");
  EXPECT_STREQ(word(DriveStatus::stale_pose), "stale_pose");
  EXPECT_STREQ(word(DriveStatus::stale_ball), "stale_ball");
  EXPECT_STREQ(word(DriveStatus::not_finite), "not_finite");
}

}  // namespace
}  // namespace movis::control
