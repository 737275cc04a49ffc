#include <cmath>
#include <limits>

#include "movis/core/angle.h"
#include "physics_scene.h"
#include "support/temporary_folder.h"

namespace movis::sim {
namespace {

using Eigen::Vector2d;

const Vector2d kBallAway(-50.0, -50.0);

control::Command kick_only() {
  return {{}, true};
}

// 2.5 m/s² to 1.5 m/s: 0.6 s and 0.45 m, then 1.5 m/s. Braking is the same backwards.
TEST(PhysicsRobot, StraightLine) {
  Physics physics = make_physics({});
  physics.place(scene({1.0, 0.0, radians(90.0)}, kBallAway));  // forward is −X
  const control::Command forward = drive_at(0.0, 3.0);
  step_frames(physics, 9, forward);
  EXPECT_NEAR(physics.robot_velocity().vy, 0.75, 1e-9);
  EXPECT_NEAR(physics.state().world_from_robot.x, 1.0 - 0.5 * 2.5 * 0.09, 1e-9);
  step_frames(physics, 9, forward);
  EXPECT_NEAR(physics.state().world_from_robot.x, 0.55, 1e-9);
  step_frames(physics, 30, forward);
  EXPECT_NEAR(physics.robot_velocity().vy, 1.5, 1e-9);
  EXPECT_NEAR(physics.state().world_from_robot.x, 0.55 - 1.5, 1e-9);
  step_frames(physics, 30);
  EXPECT_NEAR(physics.state().world_from_robot.x, 0.55 - 1.5 - 0.45, 1e-9);
  EXPECT_NEAR(physics.robot_velocity().vy, 0.0, 1e-9);
  EXPECT_NEAR(physics.state().world_from_robot.y, 0.0, 1e-9);
}

// 12 rad/s² to 4 rad/s: a third of a second and 2/3 rad; in 1 s 2/3 + 4 · 2/3 = 10/3 rad.
TEST(PhysicsRobot, Turn) {
  Physics physics = make_physics({});
  physics.place(scene({0.0, 0.0, 0.0}, kBallAway));
  step_frames(physics, 30, drive_at(0.0, 0.0, -9.0));
  EXPECT_NEAR(physics.robot_velocity().omega, -4.0, 1e-9);
  EXPECT_NEAR(physics.state().world_from_robot.beta, wrap_angle(-10.0 / 3.0), 1e-9);
}

// Forward with 1 m/s and turning with 2 rad/s is a circle of radius 0.5 m, once round in π seconds.
TEST(PhysicsRobot, Circle) {
  Physics physics = make_physics({});
  physics.place(scene({0.0, 0.0, 0.0}, kBallAway));
  const control::Command command = drive_at(0.0, 1.0, 2.0);
  step_frames(physics, 30, command);
  const Pose2 start = physics.state().world_from_robot;
  physics.step(command, kPi / 2.0);
  const Pose2 half = physics.state().world_from_robot;
  EXPECT_NEAR((half.translation() - start.translation()).norm(), 1.0, 1e-9);
  physics.step(command, kPi / 2.0);
  const Pose2 end = physics.state().world_from_robot;
  EXPECT_NEAR((end.translation() - start.translation()).norm(), 0.0, 1e-9);
  EXPECT_NEAR(turn(start.beta, end.beta), 0.0, 1e-9);
}

// The wall stands at X = 2.25 m: the robot's centre stays at 2 m. Away from it the robot drives as from rest.
TEST(PhysicsRobot, StoppedByTheWall) {
  Physics physics = make_physics({paper_field(), Wall{0.5, 0.3}, {}});
  physics.place(scene({0.5, 0.0, 0.0}, {-1.0, 0.0}));
  physics.step(drive_at(1.5, 0.0), 3.0, [](const State& state) {
    EXPECT_LT(state.world_from_robot.x, 2.002);
    return false;
  });
  EXPECT_NEAR(physics.state().world_from_robot.x, 2.0, 1e-3);
  EXPECT_NEAR(physics.robot_velocity().vx, 0.0, 2e-3);
  EXPECT_NEAR(physics.state().world_from_robot.beta, 0.0, 1e-3);
  step_frames(physics, 6, drive_at(-1.5, 0.0));
  EXPECT_NEAR(physics.state().world_from_robot.x, 2.0 - 0.5 * 2.5 * 0.04, 2e-3);
}

// What is commanded is missed by a factor of its own for each component and each call: 2 % of 1 m/s.
TEST(PhysicsRobot, ActuatorNoise) {
  control::RobotModel robot = exact_robot();
  robot.actuator_sigma = 0.02;
  Physics physics = make_physics({}, {}, robot);
  physics.place(scene({0.0, 0.0, 0.0}, kBallAway));
  const int draws = 2000;
  double sum = 0.0;
  double squares = 0.0;
  physics.step(drive_at(0.0, 1.0), 1.0);
  for (int i = 0; i < draws; ++i) {
    physics.step(drive_at(0.0, 1.0), 0.1);  // long enough to reach it
    sum += physics.robot_velocity().vy;
    squares += std::pow(physics.robot_velocity().vy - 1.0, 2);
  }
  EXPECT_NEAR(sum / draws, 1.0, 4.0 * 0.02 / std::sqrt(draws));
  EXPECT_NEAR(std::sqrt(squares / draws), 0.02, 4.0 * 0.02 / std::sqrt(2.0 * draws));
  EXPECT_EQ(physics.robot_velocity().vx, 0.0);  // the noise is relative
}

TEST(PhysicsRobot, NonFiniteCommand) {
  Physics physics = make_physics({});
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    test::expect_error([&] { physics.step(drive_at(0.0, bad), 0.1); }, {"not finite", "controller"});
  }
}

// The first push sends the ball ahead with 1.6 · 0.8 m/s, 0.48 m/s faster than the robot. The robot catches up after
// 2 · 0.48 / 0.35 = 2.7 s and pushes again, with 0.6 of that, and so on: after 2.7 / (1 − 0.6) = 6.9 s the ball rolls
// along with the robot. It is not glued to it: when the robot brakes from 0.8 m/s (0.8² / 5 = 0.128 m), the ball rolls
// on 0.8² / 0.7 = 0.914 m.
TEST(PhysicsRobot, PushesTheBall) {
  Physics physics = make_physics({});
  physics.place(scene({0.0, 0.0, 0.0}, {0.0, 1.0}));
  const auto gap = [&] { return physics.state().ball_in_field.y() - physics.state().world_from_robot.y - 0.36; };
  for (int i = 0; i < 300; ++i) {
    step_frames(physics, 1, drive_at(0.0, 0.8));
    EXPECT_GT(gap(), -0.002);
  }
  EXPECT_NEAR(gap(), 0.0, 2e-3);
  EXPECT_NEAR(physics.state().ball_in_field.x(), 0.0, 1e-3);
  EXPECT_NEAR(physics.ball_velocity().y(), 0.8, 0.01);
  step_frames(physics, 150);
  EXPECT_NEAR(gap(), 0.914 - 0.128, 0.02);
  EXPECT_EQ(physics.ball_velocity().norm(), 0.0);
}

TEST(PhysicsRobot, KicksAlongItsFront) {
  Physics physics = make_physics({}, frictionless_floor());
  physics.place(scene({0.0, 0.0, radians(30.0)}, {-0.195, 0.337}));  // 0.39 m ahead: a gap of 3 cm
  physics.step(kick_only(), 1.0 / 30.0);
  EXPECT_EQ(physics.kicks(), 1);
  EXPECT_NEAR(physics.ball_velocity().x(), -2.0, 1e-9);
  EXPECT_NEAR(physics.ball_velocity().y(), 4.0 * std::cos(radians(30.0)), 1e-9);
  EXPECT_EQ(physics.ball_velocity().z(), 0.0);
}

// 2000 kicks: the mean within four standard errors, the spread too (of a σ from n draws: σ / √(2n)).
TEST(PhysicsRobot, KicksScatter) {
  control::RobotModel robot = exact_robot();
  robot.kicker.speed_sigma = 0.05;
  robot.kicker.direction_sigma = radians(2.0);
  Physics physics = make_physics({}, frictionless_floor(), robot);
  const int draws = 2000;
  Eigen::Array2d sum = Eigen::Array2d::Zero();
  Eigen::Array2d squares = Eigen::Array2d::Zero();
  for (int i = 0; i < draws; ++i) {
    physics.place(scene({0.0, 0.0, 0.0}, {0.0, 0.39}));
    physics.step(kick_only(), 0.01);
    const Vector2d velocity = physics.ball_velocity().head<2>();
    const Eigen::Array2d error(velocity.norm() / 4.0 - 1.0, std::atan2(-velocity.x(), velocity.y()));
    sum += error;
    squares += error.square();
  }
  const Eigen::Array2d sigma(0.05, radians(2.0));
  for (const int i : {0, 1}) {
    EXPECT_NEAR(sum(i) / draws, 0.0, 4.0 * sigma(i) / std::sqrt(draws));
    EXPECT_NEAR(std::sqrt(squares(i) / draws), sigma(i), 4.0 * sigma(i) / std::sqrt(2.0 * draws));
  }
}

// The robot's own 1 m/s forward is added. Sideways nothing is: the kicker's plate only pushes ahead.
TEST(PhysicsRobot, KicksInMotion) {
  Physics physics = make_physics({}, frictionless_floor());
  physics.place(scene({0.0, 0.0, 0.0}, {0.0, 2.0}));
  control::Command forward = drive_at(0.0, 1.0);
  step_frames(physics, 30, forward);  // full speed after 0.2 m
  forward.kick = true;
  for (int i = 0; i < 60 && physics.kicks() == 0; ++i) physics.step(forward, 1.0 / 30.0);
  EXPECT_NEAR(physics.ball_velocity().y(), 5.0, 1e-9);
  EXPECT_NEAR(physics.ball_velocity().x(), 0.0, 1e-9);

  physics.place(scene({0.0, 0.0, 0.0}, {1.0, 0.39}));
  control::Command sideways = drive_at(1.0, 0.0);
  sideways.kick = true;
  for (int i = 0; i < 60 && physics.kicks() == 0; ++i) physics.step(sideways, 1.0 / 30.0);
  EXPECT_NEAR(physics.ball_velocity().y(), 4.0, 1e-9);
  EXPECT_NEAR(physics.ball_velocity().x(), 0.0, 1e-9);
}

// Reach is 5 cm before the hull, so up to 0.41 m, and 10 cm to either side.
TEST(PhysicsRobot, KicksOnlyWithinReach) {
  Physics physics = make_physics({}, frictionless_floor());
  const auto kicks_at = [&](const Vector2d& ball) {
    physics.place(scene({0.0, 0.0, 0.0}, ball));
    physics.step(kick_only(), 0.01);
    return physics.kicks();
  };
  EXPECT_EQ(kicks_at({0.0, 0.409}), 1);
  EXPECT_EQ(kicks_at({0.0, 0.411}), 0);
  EXPECT_EQ(kicks_at({0.099, 0.37}), 1);
  EXPECT_EQ(kicks_at({-0.101, 0.37}), 0);
  EXPECT_EQ(kicks_at({0.0, -0.39}), 0);

  physics.place({0.0, {0.0, 0.0, 0.0}, {0.0, 0.39, kBallRadius + 0.3}});  // in the air
  physics.step(kick_only(), 0.01);
  EXPECT_EQ(physics.kicks(), 0);
}

// Between kicker and wall the ball stays within reach: the hull is 0.26 m from the wall at Y = 2.5 m. One kick a call,
// and one in half a second.
TEST(PhysicsRobot, KickerRecharges) {
  Physics physics = make_physics({paper_field(), Wall{0.5, 0.3}, {}});
  const State trapped = scene({1.2, 2.5 - 0.26 - 0.25, 0.0}, {1.2, 2.5 - 0.13});
  physics.place(trapped);
  step_frames(physics, 14, kick_only());  // 0.467 s
  EXPECT_EQ(physics.kicks(), 1);
  step_frames(physics, 3, kick_only());
  EXPECT_EQ(physics.kicks(), 2);
  physics.place(trapped);
  physics.step(kick_only(), 2.0);
  EXPECT_EQ(physics.kicks(), 1);
}

// Lifted by 30°: up with 4 sin 30° = 2 m/s, along with 4 cos 30°.
TEST(PhysicsRobot, LiftedKick) {
  control::RobotModel robot = exact_robot();
  robot.kicker.lift = radians(30.0);
  Physics physics = make_physics({}, {}, robot);
  physics.place(scene({0.0, 0.0, 0.0}, {0.0, 0.39}));
  physics.step(kick_only(), 2.0 / 9.81);
  EXPECT_NEAR(physics.state().ball_in_field.z() - kBallRadius, 4.0 / 19.62, 1e-9);
  EXPECT_NEAR(physics.state().ball_in_field.y(), 0.39 + 4.0 * std::cos(radians(30.0)) * 2.0 / 9.81, 1e-9);
}

}  // namespace
}  // namespace movis::sim
