#include <gtest/gtest.h>

#include "movis/core/paths.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/player.h"
#include "movis/sim/simulator.h"

// The closed loop with images that fail.
namespace movis::pipeline {
namespace {

// Drives ahead.
class Cruise : public control::Controller {
 public:
  void start() override {}
  control::Command step(const control::Observation& observation) override {
    ball_age_s = observation.world.ball_age_s;
    return {{0.0, 0.5, 0.0}, false};
  }
  const std::vector<control::Signal>& signals() const override { return signals_; }

  double ball_age_s = 0.0;

 private:
  std::vector<control::Signal> signals_;
};

class Playing : public ::testing::Test {
 protected:
  static sim::Scenario make_scenario() {
    sim::Scenario scenario = sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
    scenario.robot_start = Pose2{0.3, -0.8, 0.1};
    scenario.ball_start = Eigen::Vector2d(0.5, 0.6);
    return scenario;
  }

  // One frame, its images lost if wanted.
  control::Command tick(bool lost) {
    simulator.acquire(images);
    if (lost) {
      for (grab::Frame& frame : images.frames) frame.view = {};
    }
    const control::Command command = play(player, cruise, images);
    simulator.send(command);
    return command;
  }

  sim::Scenario scenario = make_scenario();
  sim::Simulator simulator{scenario, 1};
  Player player{Pipeline(scenario.rig, scenario.arena.field, scan::read_colours(data_file("colours/default.yaml")), {},
                         localization::find_localizer("composed")),
                scenario.robot};
  Cruise cruise;
  grab::FrameSet images;
};

TEST_F(Playing, LostFramesDoNotStopTheRobot) {
  player.start(0.0);
  for (int i = 0; i < 10; ++i) tick(false);
  for (int i = 0; i < 10; ++i) {  // a third of a second
    const control::Command command = tick(true);
    EXPECT_EQ(player.drive.status(), control::DriveStatus::ok) << i;
    EXPECT_NEAR(command.velocity.vy, 0.5, 1e-9) << i;
  }
  // The pose was carried along with the commands: still right, though it was measured 17 cm before.
  const Pose2& truth = simulator.truth().world_from_robot;
  EXPECT_NEAR((player.world.world_from_robot.translation() - truth.translation()).norm(), 0.0, 0.02);
  EXPECT_NEAR(player.world.pose_age_s, 10.0 / 30.0, 1e-9);
}

TEST_F(Playing, StaleEstimateStopsTheRobotUntilItSeesAgain) {
  player.start(0.0);
  for (int i = 0; i < 10; ++i) tick(false);
  control::Command command;
  for (int i = 0; i < 25; ++i) command = tick(true);
  EXPECT_NE(player.drive.status(), control::DriveStatus::ok);
  EXPECT_EQ(command.velocity.vy, 0.0);
  tick(false);
  EXPECT_EQ(player.drive.status(), control::DriveStatus::ok);
}

TEST_F(Playing, BlindFromTheStartStandsStill) {
  player.start(0.0);
  for (int i = 0; i < 5; ++i) {
    const control::Command command = tick(true);
    EXPECT_EQ(command.velocity.vy, 0.0);
    EXPECT_EQ(player.drive.status(), control::DriveStatus::stale_pose);
  }
}

TEST_F(Playing, OneCameraLostIsNoLostFrame) {
  player.start(0.0);
  for (int i = 0; i < 10; ++i) tick(false);
  simulator.acquire(images);
  images.frames[2].view = {};
  simulator.send(play(player, cruise, images));
  EXPECT_EQ(player.world.ball_age_s, 0.0);
  // What the controller sees is of the time when its command acts.
  EXPECT_NEAR(cruise.ball_age_s, scenario.robot.latency(), 1e-9);
}

}  // namespace
}  // namespace movis::pipeline
