#include "placement.h"

#include <algorithm>
#include <limits>
#include <map>

#include "movis/core/error.h"
#include "movis/sim/referee.h"
#include "movis/sim/scenario.h"
#include "panels.h"

namespace movis::sim {
namespace {

double drawn(double half_range, RandomStream& random) {
  return std::uniform_real_distribution<double>(-half_range, half_range)(random);
}

// A place up to `margin` from the field's outer lines.
Eigen::Vector2d draw_place(const Field& field, double margin, RandomStream& random) {
  const double x = drawn(std::max(0.0, field.half_width - margin), random);
  const double y = drawn(std::max(0.0, field.half_length - margin), random);
  return {x, y};
}

std::string obstruction(const Scenario& scenario, const Pose2& robot, const Eigen::Vector2d& ball) {
  const double robot_radius = scenario.robot.radius;
  const double gap = scenario.clearance;
  if ((robot.translation() - ball).norm() < robot_radius + kBallRadius + gap) return "the other of robot and ball";
  std::string what;
  if (!scenario.robot_start) what = in_the_way(scenario.arena, robot.translation(), robot_radius, gap);
  if (what.empty() && !scenario.ball_start) what = in_the_way(scenario.arena, ball, kBallRadius, gap);
  return what;
}

State at(const Pose2& robot, const Eigen::Vector2d& ball) {
  return {0.0, robot, {ball.x(), ball.y(), kBallRadius}};
}

}  // namespace

std::string in_the_way(const Arena& arena, const Eigen::Vector2d& position, double radius, double gap) {
  const double room = radius + gap;
  for (std::size_t i = 0; i < arena.obstacles.size(); ++i) {
    const Obstacle& obstacle = arena.obstacles[i];
    if ((position - obstacle.position).norm() < room + obstacle.radius) return fmt::format("obstacles[{}]", i);
  }
  if (!arena.field) return "";
  if (distance(goal_panels(*arena.field), position) < room) return "a goal's walls";
  if (!arena.wall) return "";
  const Eigen::Vector2d inner(arena.field->half_width + arena.wall->distance,
                              arena.field->half_length + arena.wall->distance);
  return (inner - position.cwiseAbs()).minCoeff() < room ? "the wall" : "";
}

State draw_start(const Scenario& scenario, RandomStream& random) {
  constexpr int kTries = 10000;
  if (scenario.robot_start && scenario.ball_start) return at(*scenario.robot_start, *scenario.ball_start);
  if (!scenario.arena.field) {
    throw Error("scenario '{}' has no field to draw a start on; give it a field, or a start for robot and ball",
                scenario.name);
  }
  const Field& field = *scenario.arena.field;
  std::map<std::string, int> obstructions;
  for (int i = 0; i < kTries; ++i) {
    const Eigen::Vector2d place = draw_place(field, scenario.robot.radius, random);
    const double heading = drawn(kPi, random);
    const Pose2 robot = scenario.robot_start.value_or(Pose2{place.x(), place.y(), wrap_angle(heading)});
    const Eigen::Vector2d ball = scenario.ball_start.value_or(draw_place(field, scenario.margin, random));
    const bool over = judge(at(robot, ball), field, std::numeric_limits<double>::infinity()).has_value();
    const std::string what = over ? "an outcome at once" : obstruction(scenario, robot, ball);
    if (what.empty()) return at(robot, ball);
    ++obstructions[what];
  }
  const auto most = std::max_element(obstructions.begin(), obstructions.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  throw Error(
      "scenario '{}': no free place was found for the start in {} tries; in {} of them {} was in the way. Make "
      "clearance "
      "or margin smaller, take something away, or give the start",
      scenario.name, kTries, most->second, most->first);
}

}  // namespace movis::sim
