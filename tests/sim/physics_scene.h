#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "movis/sim/physics.h"

namespace movis::sim {

inline Field paper_field() {
  Field field;
  field.half_width = 1.75;
  field.half_length = 2.0;
  field.line = 0.05;
  field.Fd = 2.0;
  field.Fw = 0.5;
  field.goal_height = 0.5;
  field.goal_depth = 0.25;
  field.goal_thickness = 0.01;
  return field;
}

// The miniature robot, without noise.
inline control::RobotModel exact_robot() {
  control::RobotModel robot;
  robot.radius = 0.25;
  robot.height = 0.11;
  robot.mass = 12.0;
  robot.kicker = {0.20, 0.05, 4.0, 0.0, 0.0, 0.0};
  robot.limits = {1.5, 2.5, 4.0, 12.0};
  robot.frame_rate = 30.0;
  robot.latency_frames = 2;
  return robot;
}

// Nothing slows the ball but contacts.
inline PhysicsOptions frictionless_floor() {
  PhysicsOptions options;
  options.rolling_deceleration = 0.0;
  return options;
}

inline Physics make_physics(const Arena& arena, const PhysicsOptions& options = {},
                            const control::RobotModel& robot = exact_robot(), std::uint64_t seed = 1) {
  return {arena, robot, options, make_stream(seed, 0)};
}

// The ball at rest on the floor.
inline State scene(const Pose2& robot, const Eigen::Vector2d& ball) {
  return {0.0, robot, {ball.x(), ball.y(), kBallRadius}};
}

inline constexpr Pose2 kFarAway{50.0, 50.0, 0.0};  // for the robot, where only the ball matters

inline void step_frames(Physics& physics, int frames, const control::Command& command = {}) {
  for (int i = 0; i < frames; ++i) physics.step(command, 1.0 / 30.0);
}

inline control::Command drive_at(double vx, double vy, double omega = 0.0) {
  return {{vx, vy, omega}, false};
}

}  // namespace movis::sim
