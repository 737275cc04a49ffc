#include "movis/control/percepts.h"

#include <algorithm>
#include <cmath>

namespace movis::control {
namespace {

using Eigen::Vector2d;

// From straight ahead, positive to the left. Wrapped, as straight behind may come out as −π.
double direction(const Vector2d& vector_in_robot) {
  return wrap_angle(std::atan2(-vector_in_robot.x(), vector_in_robot.y()));
}

// The directions, as turns from the field's +Y, in which a ball on the field's side of the goal line passes between the
// posts: along its edge it passes a post at a ball's radius.
struct Window {
  double left = 0.0, right = 0.0;  // left < right: there is no such direction
};

Window window_of(const Vector2d& ball, const Task& task) {
  const auto edge = [&](double post_x, double side) {
    const Vector2d to_post = Vector2d(post_x, task.field.Fd) - ball;
    const double clear = std::asin(std::min(1.0, task.ball_radius / to_post.norm()));
    return std::atan2(-to_post.x(), to_post.y()) - side * clear;
  };
  return {edge(-task.field.Fw, 1.0), edge(task.field.Fw, -1.0)};
}

}  // namespace

Percepts perceive(const Observation& observation, const Task& task) {
  const world::World& world = observation.world;
  Percepts percepts;
  percepts.ball_in_robot = world.ball_in_robot;
  percepts.ball_distance = world.ball_in_robot.norm();
  percepts.ball_direction = direction(world.ball_in_robot);
  percepts.ball_gap = percepts.ball_distance - task.robot.radius - task.ball_radius;

  percepts.target_in_robot = inverse(world.world_from_robot) * Vector2d(0.0, task.field.Fd);
  percepts.target_distance = percepts.target_in_robot.norm();
  percepts.target_direction = direction(percepts.target_in_robot);

  percepts.detour = turn(percepts.ball_direction, direction(percepts.target_in_robot - world.ball_in_robot));
  return percepts;
}

bool should_kick(const Observation& observation, const Task& task) {
  const world::World& world = observation.world;
  if (!kicker_reaches(task.robot, world.ball_in_robot, task.ball_radius)) return false;

  const Vector2d ball = world.world_from_robot * world.ball_in_robot;
  if (ball.y() >= task.field.Fd) return false;
  const Window window = window_of(ball, task);
  const double width = window.left - window.right;
  if (width <= 0.0) return false;
  const double ahead = wrap_angle(world.world_from_robot.beta);
  const double room = std::min(window.left - ahead, ahead - window.right);
  return room >= std::min(2.0 * task.robot.kicker.direction_sigma, width / 3.0);
}

}  // namespace movis::control
