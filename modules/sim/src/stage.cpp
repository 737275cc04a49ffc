#include "stage.h"

#include <algorithm>

namespace movis::sim {
namespace {

Shadow shadow(const Eigen::Vector2d& centre, double radius, double strength) {
  constexpr double kReach = 2.2;  // of a shadow, in radii of what throws it
  return {centre.cast<float>(), static_cast<float>(kReach * radius), static_cast<float>(strength)};
}

}  // namespace

Stage::Stage(const Arena& arena, const control::RobotModel& robot, const Look& look)
    : hall(arena, look), props(props_of(arena, look)), look_(look), robot_radius_(static_cast<float>(robot.radius)) {
  for (const Obstacle& obstacle : arena.obstacles) {
    shadows.push_back(shadow(obstacle.position, obstacle.radius, look.light.shadow));
  }
  shadows.resize(shadows.size() + 2);  // of the robot and the ball
  props.emplace_back();
}

void Stage::set(const State& state) {
  props.back() = ball_prop(state.ball_in_field, look_);
  const double above = std::max(0.0, state.ball_in_field.z() - kBallRadius);  // a ball in the air: wider and paler
  const double wide = kBallRadius + above;
  shadows[shadows.size() - 2] = shadow(state.world_from_robot.translation(), robot_radius_, look_.light.shadow);
  shadows.back() = shadow(state.ball_in_field.head<2>(), wide, look_.light.shadow * kBallRadius / wide);
}

}  // namespace movis::sim
