#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "movis/control/command.h"
#include "movis/control/robot_model.h"
#include "movis/core/random.h"

namespace movis::control {

// The limits of data/robots/miniature.yaml, and its kicker. Its frames are of 0.1 s, which makes hand calculations
// short.
inline RobotModel plain_robot() {
  RobotModel robot;
  robot.radius = 0.25;
  robot.kicker = {0.2, 0.05, 4.0, 0.05, radians(2.0), 0.0};
  robot.limits = {1.5, 2.5, 4.0, 12.0};
  robot.frame_rate = 10.0;
  robot.latency_frames = 2;
  return robot;
}

// Three wheels at 90°, 210°, 330°, 0.2 m from the centre, of radius 0.05 m: at 1 m/s along its own direction a wheel
// turns at 20 rad/s, at 1 rad/s of the robot at 4 rad/s.
inline RobotModel wheeled_robot(double max_rate) {
  RobotModel robot = plain_robot();
  robot.wheels = OmniWheels{{kPi / 2.0, kPi * 7.0 / 6.0, kPi * 11.0 / 6.0}, 0.2, 0.05, max_rate};
  return robot;
}

inline Twist2 draw_twist(RandomStream& random, double speed, double turn_rate) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const double vx = speed * uniform(random), vy = speed * uniform(random);
  return {vx, vy, turn_rate * uniform(random)};
}

// A robot that shares no code with the one under test: integrated in the field's axes, in steps of 50 µs. Commands are
// taken as they are, so they must lie within the speeds.
class KinematicRobot {
 public:
  explicit KinematicRobot(RobotModel robot) : robot_(std::move(robot)) {}

  void send(const Command& command, double time_s) {
    waiting_.push_back({time_s + robot_.latency_frames / robot_.frame_rate, command.velocity});
  }

  void advance(double to_s) {
    while (time_s_ < to_s) {
      while (!waiting_.empty() && waiting_.front().acts_s <= time_s_) {
        wanted_ = waiting_.front().velocity;
        waiting_.pop_front();
      }
      double end_s = std::min(time_s_ + 5e-5, to_s);
      if (!waiting_.empty()) end_s = std::min(end_s, waiting_.front().acts_s);
      step(end_s - time_s_);
      time_s_ = end_s;
    }
  }

  const Pose2& world_from_robot() const { return pose_; }

 private:
  struct Waiting {
    double acts_s;
    Twist2 velocity;
  };

  void step(double seconds) {
    const Twist2 before = velocity_;
    const double dx = wanted_.vx - before.vx, dy = wanted_.vy - before.vy, turn = wanted_.omega - before.omega;
    const double change = std::sqrt(dx * dx + dy * dy), most = robot_.limits.acceleration * seconds;
    velocity_.vx = change > most ? before.vx + dx / change * most : wanted_.vx;
    velocity_.vy = change > most ? before.vy + dy / change * most : wanted_.vy;
    const double turn_most = robot_.limits.turn_acceleration * seconds;
    velocity_.omega = std::abs(turn) > turn_most ? before.omega + std::copysign(turn_most, turn) : wanted_.omega;

    const double vx = (before.vx + velocity_.vx) / 2.0, vy = (before.vy + velocity_.vy) / 2.0;
    const double omega = (before.omega + velocity_.omega) / 2.0;
    const double beta = pose_.beta + omega * seconds / 2.0;
    pose_.x += seconds * (std::cos(beta) * vx - std::sin(beta) * vy);
    pose_.y += seconds * (std::sin(beta) * vx + std::cos(beta) * vy);
    pose_.beta += omega * seconds;
  }

  RobotModel robot_;
  std::deque<Waiting> waiting_;
  double time_s_ = 0.0;
  Twist2 wanted_;
  Twist2 velocity_;
  Pose2 pose_;
};

}  // namespace movis::control
