#include <limits>

#include "movis/core/angle.h"
#include "movis/sim/episode.h"
#include "physics_scene.h"
#include "support/closed_loop.h"
#include "support/temporary_folder.h"

namespace movis::sim {
namespace {

constexpr double kPeriod = 1.0 / 30.0;

Scenario still_life(const Pose2& robot, const Eigen::Vector2d& ball) {
  Scenario scenario;
  scenario.name = "still life";
  scenario.arena.field = paper_field();
  scenario.robot = exact_robot();
  scenario.robot_start = robot;
  scenario.ball_start = ball;
  return scenario;
}

// Two frames of latency: a command sent at image 0 acts from image 2 on. Until the image 3 the robot then goes
// 2.5 / 2 · (1/30)² = 1.389 mm.
TEST(Episode, CommandsActAfterTheLatency) {
  Episode episode(still_life({0.0, 0.0, 0.0}, {1.0, 1.0}), 1);
  episode.send(drive_at(0.0, 1.0));
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(episode.advance());
    EXPECT_EQ(episode.truth().world_from_robot.y, 0.0);
  }
  EXPECT_TRUE(episode.advance());
  EXPECT_NEAR(episode.truth().world_from_robot.y, 1.25 * kPeriod * kPeriod, 1e-9);
  EXPECT_NEAR(episode.truth().time_s, 3.0 * kPeriod, 1e-12);
}

// v(t) = 2.5 t as the command holds, without being sent again; the ninth period ends at 0.75 m/s.
TEST(Episode, LastCommandHolds) {
  Scenario scenario = still_life({0.0, 0.0, 0.0}, {1.0, 1.0});
  scenario.robot.latency_frames = 0;
  Episode episode(scenario, 1);
  episode.send(drive_at(0.0, 1.0));
  for (int i = 0; i < 9; ++i) episode.advance();
  EXPECT_NEAR(episode.truth().world_from_robot.y, 0.5 * 2.5 * 0.09, 1e-9);
}

TEST(Episode, LastCommandOfAFrameCounts) {
  Episode episode(still_life({0.0, 0.0, 0.0}, {1.0, 1.0}), 1);
  episode.send(drive_at(0.0, -1.0));
  episode.send(drive_at(1.0, 0.0));
  for (int i = 0; i < 6; ++i) episode.advance();
  EXPECT_GT(episode.truth().world_from_robot.x, 0.01);
  EXPECT_EQ(episode.truth().world_from_robot.y, 0.0);
}

TEST(Episode, NonFiniteCommandStopsTheRobot) {
  Scenario scenario = still_life({0.0, 0.0, 0.0}, {1.0, 1.0});
  scenario.robot.latency_frames = 0;
  Episode episode(scenario, 1);
  episode.send(drive_at(0.0, 1.0));
  for (int i = 0; i < 12; ++i) episode.advance();
  const double bad = std::numeric_limits<double>::quiet_NaN();
  test::expect_error([&] { episode.send(drive_at(0.0, 1.0, bad)); }, {"not finite", "stops"});
  for (int i = 0; i < 13; ++i) episode.advance();
  const double resting_y = episode.truth().world_from_robot.y;
  episode.advance();
  EXPECT_NEAR(episode.truth().world_from_robot.y, resting_y, 1e-9);
}

// The kicked ball crosses the line 2.11 m up the field and rebounds from the goal's back, 2 cm further: the goal is
// seen although no image shows the ball there. From 1.39 m it is there 0.72 m / 4 m/s = 0.18 s after the kick, a little
// later as it slows down: v² − 2·0.35·0.72 gives 3.936 m/s, on average 3.968 m/s.
TEST(Episode, KickedIntoTheGoal) {
  Episode episode(still_life({0.0, 1.0, 0.0}, {0.0, 1.39}), 1);
  episode.send({{}, true});
  while (episode.advance()) EXPECT_LT(episode.truth().time_s, 1.0);
  EXPECT_EQ(episode.outcome(), Outcome::goal);
  EXPECT_EQ(episode.kicks(), 1);
  EXPECT_NEAR(episode.truth().time_s, 2.0 * kPeriod + 0.72 / 3.968, 1.0 / 960.0);
  EXPECT_FALSE(episode.advance());
}

TEST(Episode, OutOfTime) {
  Scenario scenario = still_life({0.0, 0.0, 0.0}, {1.0, 1.0});
  scenario.duration_s = 1.0;
  for (const bool with_field : {true, false}) {
    if (!with_field) scenario.arena.field.reset();
    Episode episode(scenario, 1);
    int frames = 0;
    while (episode.advance()) ++frames;
    EXPECT_EQ(frames, 29);
    EXPECT_EQ(episode.outcome(), Outcome::out_of_time);
  }
}

TEST(Episode, RestartsTheSame) {
  Scenario scenario = still_life({0.0, 0.0, 0.0}, {1.0, 1.0});
  scenario.robot_start.reset();
  scenario.ball_start.reset();
  scenario.robot.actuator_sigma = 0.02;
  Episode episode(scenario, 5);
  Eigen::Matrix<double, 6, 2> ends;
  for (const int run : {0, 1}) {
    const State start = episode.truth();
    episode.send(drive_at(0.5, 0.5, 1.0));
    for (int i = 0; i < 30; ++i) episode.advance();
    const State& end = episode.truth();
    ends.col(run) << start.world_from_robot.translation(), start.ball_in_field.head<2>(), end.world_from_robot.x,
        end.world_from_robot.beta;
    episode.restart();
    EXPECT_EQ(episode.truth().time_s, 0.0);
    EXPECT_EQ(episode.outcome(), std::nullopt);
  }
  EXPECT_EQ(ends.col(0), ends.col(1));
}

// Drives straight at the ball, and kicks.
class StraightOn : public control::Controller {
 public:
  void start() override { signals_.clear(); }
  control::Command step(const control::Observation& observation) override {
    const Eigen::Vector2d ball = observation.world.ball_in_robot;
    bearings_ += observation.bearings.size();
    return {{2.0 * ball.x(), 2.0 * ball.y(), 0.0}, true};
  }
  const std::vector<control::Signal>& signals() const override { return signals_; }
  std::size_t bearings() const { return bearings_; }

 private:
  std::vector<control::Signal> signals_;
  std::size_t bearings_ = 0;
};

TEST(Episode, ClosedLoopWithoutImages) {
  Scenario scenario = still_life({0.0, -1.0, 0.0}, {0.0, 0.5});
  scenario.rig.cameras.resize(3);
  StraightOn controller;
  const test::ClosedLoopRun run = test::run_without_images(scenario, controller, 1);
  EXPECT_EQ(run.outcome, Outcome::goal);
  EXPECT_GE(run.kicks, 1);
  EXPECT_LT(run.time_s, 4.0);
  EXPECT_EQ(controller.bearings(), 9 * run.trace.size());  // ball and two goals from three cameras
  EXPECT_NEAR(run.trace.back().world.time_s, run.time_s, kPeriod + 1e-9);

  StraightOn again;
  EXPECT_EQ(test::run_without_images(scenario, again, 1).time_s, run.time_s);
}

}  // namespace
}  // namespace movis::sim
