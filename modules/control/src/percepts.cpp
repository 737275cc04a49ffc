#include "movis/control/percepts.h"

#include <cmath>

namespace movis::control {
namespace {

using Eigen::Vector2d;

// From straight ahead, positive to the left. Wrapped, as straight behind may come out as −π.
double direction(const Vector2d& vector_in_robot) {
  return wrap_angle(std::atan2(-vector_in_robot.x(), vector_in_robot.y()));
}

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// Whether a ball on the field's side of the goal line passes between the posts when it rolls along a direction, given
// as its turn from the field's +Y.
bool passes_posts(const Vector2d& ball, double direction_in_field, const Task& task) {
  const Vector2d along(-std::sin(direction_in_field), std::cos(direction_in_field));
  const Vector2d left_post(-task.field.Fw, task.field.Fd);
  const Vector2d right_post(task.field.Fw, task.field.Fd);
  return cross(along, left_post - ball) >= task.ball_radius && cross(right_post - ball, along) >= task.ball_radius;
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
  const double ahead = world.world_from_robot.beta;
  if (!passes_posts(ball, ahead, task)) return false;

  const double scatter = 2.0 * task.robot.kicker.direction_sigma;
  if (passes_posts(ball, ahead + scatter, task) && passes_posts(ball, ahead - scatter, task)) return true;
  const double on_goal_line = ball.x() - std::tan(ahead) * (task.field.Fd - ball.y());
  return std::abs(on_goal_line) <= task.field.Fw / 3.0;
}

}  // namespace movis::control
