#pragma once

#include "movis/control/robot_model.h"
#include "movis/core/twist.h"

namespace movis::control {

// The velocity of a robot that was told `wanted`, `seconds` after it moved at `current`, within its limits: the
// dynamics of the robot wherever it is modelled.
//
// 1. `wanted` is brought within the speeds: the translation keeps its direction, the turn is cut. With wheels, all
//    three components then shrink together until no wheel turns faster than it can.
// 2. The velocity moves straight towards that, translation and turn each as far as its acceleration allows in the
//    time. It never overshoots, and the change keeps its direction: limiting each axis by itself, as
//    vpRobot::saturateVelocities does, would bend the path.
// 3. With wheels, one of the two may be farther on its way than the other, and a wheel too fast in between. Were both
//    only as far as the slower one, no wheel would be, as the velocities that the wheels can do are convex. So the
//    quicker one is held back towards that as much as the wheels need, and no more.
//
// The accelerations are always kept. The speeds are kept where `current` keeps them; else they are approached.
Twist2 limited(const Twist2& wanted, const Twist2& current, const RobotModel& robot, double seconds);

// The time after which limited() changes no more.
double settling_time(const Twist2& wanted, const Twist2& current, const RobotModel& robot);

}  // namespace movis::control
