#pragma once

#include <Eigen/Core>

#include "movis/control/observation.h"
#include "movis/control/robot_model.h"
#include "movis/core/field.h"

namespace movis::control {

// What approach-and-shoot is about, for whoever controls it: the field and the robot are known, as to any player.
struct Task {
  Field field;
  RobotModel robot;
  double ball_radius = 0.11;  // metres
};

// The quantities that controllers of both kinds reason about. The goal is the yellow one, at +Y. Directions are from
// straight ahead (+y), positive to the left, in (−π, π].
struct Percepts {
  Eigen::Vector2d ball_in_robot = Eigen::Vector2d::Zero();
  double ball_distance = 0.0;  // from the robot's centre, metres
  double ball_direction = 0.0;
  double ball_gap = 0.0;  // between the hulls of robot and ball, metres; 0 in contact, below 0 where estimates overlap

  Eigen::Vector2d target_in_robot = Eigen::Vector2d::Zero();  // the goal's centre, on its line
  double target_distance = 0.0;
  double target_direction = 0.0;

  // The robot's place around the ball: the turn from the direction robot → ball to the direction ball → target, in
  // (−π, π]. 0: the robot stands behind the ball, ready to shoot; ±π: the ball is between robot and own goal.
  double detour = 0.0;
};

Percepts perceive(const Observation& observation, const Task& task);

// The kick rule, one for all controllers: the ball is within the kicker's reach, and straight ahead lies in the window
// of directions in which it rolls between the goal's posts without touching them, two sigma of the kicker's scatter or
// more from either edge, or, where the window is narrower than six sigma, in its middle third. So at least 95 % of the
// kicks pass where the window is six sigma wide or more, and 68 % where it is three.
bool should_kick(const Observation& observation, const Task& task);

}  // namespace movis::control
