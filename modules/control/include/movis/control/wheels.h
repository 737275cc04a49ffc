#pragma once

#include <Eigen/Core>

#include "movis/control/robot_model.h"
#include "movis/core/twist.h"

namespace movis::control {

// Kinematics of three or more omni wheels (e.g. R. Rojas, A. Gloye Förster, Holonomic control of a robot with an
// omnidirectional drive, KI 20, 2006): wheel i at azimuth αi turns at
//   ωi = (−sin αi · vx + cos αi · vy + distance · ω) / radius
double wheel_rate(const OmniWheels& wheels, double azimuth, const Twist2& twist);

// For all wheels: rates = rates_by_twist · (vx, vy, ω).
Eigen::MatrixX3d rates_by_twist(const OmniWheels& wheels);

Eigen::VectorXd wheel_rates(const OmniWheels& wheels, const Twist2& twist);

// The twist that fits the rates of all wheels best, by least squares: with four wheels one rate is redundant, and its
// contradiction is slip. Throws an Error where there are not as many rates as wheels.
Twist2 twist_of(const OmniWheels& wheels, const Eigen::VectorXd& rates);

}  // namespace movis::control
