#include "movis/sim/referee.h"

#include <cmath>

namespace movis::sim {

const char* word(Outcome outcome) {
  switch (outcome) {
    case Outcome::goal:
      return "goal";
    case Outcome::own_goal:
      return "own_goal";
    case Outcome::ball_out:
      return "ball_out";
    case Outcome::robot_out:
      return "robot_out";
    case Outcome::out_of_time:
      return "out_of_time";
  }
  return "";
}

bool time_is_over(const State& state, double duration_s) {
  return state.time_s > duration_s - 1e-9;  // its sum of frame periods is rounded
}

std::optional<Outcome> judge(const State& state, const Field& field, double duration_s) {
  constexpr double kRobotMargin = 1.0;  // metres
  const Eigen::Vector3d& ball = state.ball_in_field;
  const bool in_mouth = std::abs(ball.x()) < field.Fw && ball.z() + kBallRadius < field.goal_height;
  if (in_mouth && ball.y() > field.Fd + kBallRadius) return Outcome::goal;
  if (in_mouth && ball.y() < -field.Fd - kBallRadius) return Outcome::own_goal;
  const bool beyond_side = std::abs(ball.x()) > field.half_width + kBallRadius;
  const bool beyond_end = std::abs(ball.y()) > field.half_length + kBallRadius;
  if (beyond_side || (beyond_end && !in_mouth)) return Outcome::ball_out;
  const Pose2& robot = state.world_from_robot;
  if (std::abs(robot.x) > field.half_width + kRobotMargin || std::abs(robot.y) > field.half_length + kRobotMargin) {
    return Outcome::robot_out;
  }
  if (time_is_over(state, duration_s)) return Outcome::out_of_time;
  return std::nullopt;
}

}  // namespace movis::sim
