#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "movis/control/drive.h"
#include "movis/core/paths.h"
#include "movis/servo/position_based.h"
#include "support/closed_loop.h"

namespace movis::servo {
namespace {

using Eigen::Vector2d;

const std::vector<Bearing> kNoBearings;

control::Task miniature() {
  return {read_field(data_file("fields/paper.yaml")), control::read_robot(data_file("robots/miniature.yaml"))};
}

PbvsOptions options() {
  return read_pbvs_options(data_file("servo/pbvs.yaml"));
}

world::World world_of(const Pose2& world_from_robot, const Vector2d& ball_in_field) {
  world::World world;
  world.world_from_robot = world_from_robot;
  world.pose_age_s = 0.0;
  world.ball_in_robot = inverse(world_from_robot) * ball_in_field;
  world.ball_age_s = 0.0;
  return world;
}

control::Command step(PositionBased& controller, const Pose2& world_from_robot, const Vector2d& ball_in_field) {
  return controller.step({kNoBearings, world_of(world_from_robot, ball_in_field), 0.0});
}

void expect_twist(const Twist2& twist, double vx, double vy, double omega) {
  EXPECT_NEAR(twist.vx, vx, 1e-9);
  EXPECT_NEAR(twist.vy, vy, 1e-9);
  EXPECT_NEAR(twist.omega, omega, 1e-9);
}

void expect_finite(const control::Command& command) {
  EXPECT_TRUE(std::isfinite(command.velocity.vx));
  EXPECT_TRUE(std::isfinite(command.velocity.vy));
  EXPECT_TRUE(std::isfinite(command.velocity.omega));
}

// vpAdaptiveGain's law, as its documentation has it.
double gain(const PbvsOptions& options, double x) {
  const double fall = options.gain_at_zero - options.gain_at_infinity;
  return fall * std::exp(-options.gain_slope / fall * x) + options.gain_at_infinity;
}

// In closed form. Let (px, py) be the desired place and θd the desired heading, both in the robot frame. The features
// are s = −Rᵀ(px, py) with R = R(θd), and θ = −θd; a velocity (v, ω) in the robot frame changes them by ṡ = Rᵀ v and θ̇
// = ω. So L = diag(Rᵀ, 1), which is always regular, and
//   v = −λ R s = λ (px, py),  ω = λ θd.
// By hand: ball at the field's origin, so the shot frame is the field frame. The robot stands at (0.1, −0.8) with β =
// 30° and sees the shooting place (0, −0.36 − gap), which is in sight, at (−0.1, 0.44 − gap) in the field's axes. The
// largest error is θ = π/6 = 0.5236, in absolute value.
TEST(PositionBased, KnownAnswerBehindTheBall) {
  PbvsOptions straight = options();
  straight.gap = 0.0;
  PositionBased controller(miniature(), straight);
  const control::Command command = step(controller, {0.1, -0.8, kPi / 6.0}, {0.0, 0.0});
  const double lambda = gain(straight, kPi / 6.0);
  const double c = std::sqrt(3.0) / 2.0, s = 0.5;  // into the robot frame: turned by −30°
  expect_twist(command.velocity, lambda * (-0.1 * c + 0.44 * s), lambda * (0.1 * s + 0.44 * c), -lambda * kPi / 6.0);
  EXPECT_FALSE(command.kick);
  const auto& signals = controller.signals();
  ASSERT_EQ(signals.size(), 4U);
  EXPECT_NEAR(signals[0].value, 0.1, 1e-12);    // e_x: where the robot is, seen from where it should be
  EXPECT_NEAR(signals[1].value, -0.44, 1e-12);  // e_y
  EXPECT_NEAR(signals[2].value, 30.0, 1e-9);    // e_theta
  EXPECT_NEAR(signals[3].value, degrees(std::atan2(-0.1, 0.8)), 1e-9);
}

// By hand, on the far side: the ball at the origin, the robot at (0, 2ρ) with β = 0, so that the tangent touches after
// 60° and the waypoint lies at ρ/cos λ, 120° − λ before the shooting place, on the side of positive detours (−x).
TEST(PositionBased, KnownAnswerFromTheFarSide) {
  const PbvsOptions far = options();
  PositionBased controller(miniature(), far);
  const double orbit = 0.36 + far.clearance;
  const control::Command command = step(controller, {0.0, 2.0 * orbit, 0.0}, {0.0, 0.0});
  const double radius = orbit / std::cos(far.lead);
  const double left = radians(120.0) - far.lead;
  const Vector2d way = Vector2d(-radius * std::sin(left), -radius * std::cos(left)) - Vector2d(0.0, 2.0 * orbit);
  const double lambda = gain(far, way.cwiseAbs().maxCoeff());
  EXPECT_NEAR(std::abs(command.velocity.vx), lambda * std::abs(way.x()), 1e-9);
  EXPECT_NEAR(command.velocity.vy, lambda * way.y(), 1e-9);
  EXPECT_NEAR(command.velocity.omega, 0.0, 1e-9);
  EXPECT_NEAR(std::abs(controller.signals()[3].value), 180.0, 1e-9);
}

// A robot that does exactly what it is told, at 30 Hz.
struct Walk {
  Pose2 end;
  double nearest = std::numeric_limits<double>::infinity();  // to the ball, before it has come behind it
};

Walk walk(PositionBased& controller, const Pose2& start, const Vector2d& ball, int ticks) {
  Walk walk;
  walk.end = start;
  controller.start();
  for (int i = 0; i < ticks; ++i) {
    walk.end = walk.end * start_from_end(step(controller, walk.end, ball).velocity, 1.0 / 30.0);
    const bool behind = std::abs(controller.signals()[3].value) < 15.0;
    if (!behind) walk.nearest = std::min(walk.nearest, (walk.end.translation() - ball).norm());
  }
  return walk;
}

TEST(PositionBased, IdealRobotComesBehindTheBallFromEverywhere) {
  const Vector2d ball(0.4, 0.3);
  const double heading = std::atan2(0.4, 1.7);  // from the ball to (0, 2), from straight up the field to the left
  PositionBased controller(miniature(), options());
  const double standoff = 0.36 + options().gap;
  const Pose2 expected = Pose2{ball.x(), ball.y(), heading} * Pose2{0.0, -standoff, 0.0};
  for (const double distance : {0.45, 0.7, 1.2, 2.5}) {
    for (int degree = 0; degree < 360; degree += 20) {
      for (const double beta : {0.0, 1.5, kPi, -2.0}) {
        const double azimuth = radians(degree);
        const Vector2d start = ball + distance * Vector2d(std::cos(azimuth), std::sin(azimuth));
        const Walk way = walk(controller, {start.x(), start.y(), beta}, ball, 600);
        EXPECT_LT((way.end.translation() - expected.translation()).norm(), 1e-3) << distance << " m, " << degree << "°";
        EXPECT_LT(std::abs(turn(way.end.beta, heading)), 1e-3) << distance << " m, " << degree << "°";
        EXPECT_GT(way.nearest, 0.37) << distance << " m, " << degree << "°";
      }
    }
  }
}

TEST(PositionBased, RobotExactlyOnTheFarSide) {
  PositionBased controller(miniature(), options());
  const Walk way = walk(controller, {0.0, 1.0, kPi}, {0.0, 0.0}, 600);
  EXPECT_NEAR(way.end.x, 0.0, 1e-3);
  EXPECT_NEAR(way.end.y, -0.36 - options().gap, 1e-3);
}

// Noise of the pose on the far side must not make it change its mind.
TEST(PositionBased, StaysOnTheSideItChose) {
  PositionBased controller(miniature(), options());
  for (int i = 0; i < 20; ++i) {
    const double x = i % 2 == 0 ? 0.03 : -0.03;
    step(controller, {x, 0.6, 0.0}, {0.0, 0.0});
    EXPECT_LT(controller.signals()[3].value, 0.0) << i;
  }
}

TEST(PositionBased, BallAtTheRobotsCentre) {
  PositionBased controller(miniature(), options());
  expect_finite(step(controller, {0.2, -0.5, 1.0}, {0.2, -0.5}));
}

// No direction leads from the ball to the goal: the robot comes behind it as for a shot straight up the field.
TEST(PositionBased, BallOnTheGoalsCentre) {
  PositionBased controller(miniature(), options());
  const Walk way = walk(controller, {0.5, 0.5, 1.0}, {0.0, 2.0}, 600);
  EXPECT_NEAR(way.end.x, 0.0, 1e-3);
  EXPECT_NEAR(way.end.y, 2.0 - 0.36 - options().gap, 1e-3);
  EXPECT_NEAR(way.end.beta, 0.0, 1e-3);
}

TEST(PositionBased, KicksByTheSharedRule) {
  PositionBased controller(miniature(), options());
  EXPECT_TRUE(step(controller, {0.0, 0.0, 0.0}, {0.0, 0.37}).kick);
  EXPECT_FALSE(step(controller, {0.0, 0.0, kPi}, {0.0, -0.37}).kick);
}

TEST(PositionBased, DriveContainsWhatIsNotFinite) {
  const control::Task task = miniature();
  PositionBased controller(task, options());
  control::Drive drive(task.robot, {});
  drive.start(0.0);
  world::World world = world_of({0.0, 0.0, 0.0}, {0.5, 0.5});
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (double* number : {&world.world_from_robot.x, &world.world_from_robot.beta, &world.ball_in_robot.x()}) {
      const double good = std::exchange(*number, bad);
      const control::Command command = drive.step(controller, kNoBearings, world);
      EXPECT_EQ(drive.status(), control::DriveStatus::not_finite);
      EXPECT_FALSE(command.kick);
      expect_twist(command.velocity, 0.0, 0.0, 0.0);
      *number = good;
    }
  }
  drive.step(controller, kNoBearings, world);
  EXPECT_EQ(drive.status(), control::DriveStatus::ok);
}

TEST(PositionBased, ControllersComeAndGoAndShareNothing) {
  const control::Task task = miniature();
  PositionBased kept(task, options());
  const Twist2 first = step(kept, {0.5, -1.0, 0.3}, {0.0, 0.0}).velocity;
  for (int i = 0; i < 500; ++i) {
    PositionBased other(task, options());
    other.start();
    step(other, {-0.01 * i, 1.0, 2.0}, {0.3, 0.0});
    const Twist2 again = step(kept, {0.5, -1.0, 0.3}, {0.0, 0.0}).velocity;
    ASSERT_EQ(again.vx, first.vx);
    ASSERT_EQ(again.vy, first.vy);
    ASSERT_EQ(again.omega, first.omega);
  }
}

TEST(PositionBased, StartForgetsTheSide) {
  PositionBased controller(miniature(), options());
  step(controller, {0.03, 0.6, 0.0}, {0.0, 0.0});
  EXPECT_LT(controller.signals()[3].value, 0.0);
  controller.start();
  step(controller, {-0.03, 0.6, 0.0}, {0.0, 0.0});
  EXPECT_GT(controller.signals()[3].value, 0.0);
}

// The paper's field, the miniature robot, starts that are drawn. The options were tuned with other seeds.
TEST(PositionBased, ShootsFromRandomStarts) {
  const sim::Scenario scenario = sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
  PositionBased controller({*scenario.arena.field, scenario.robot}, options());
  int goals = 0;
  std::vector<double> times;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const test::ClosedLoopRun run = test::run_without_images(scenario, controller, seed);
    goals += run.outcome == sim::Outcome::goal;
    times.push_back(run.time_s);
  }
  EXPECT_GE(goals, 36);
  std::nth_element(times.begin(), times.begin() + 20, times.end());
  EXPECT_LT(times[20], 4.0);
}

}  // namespace
}  // namespace movis::servo
