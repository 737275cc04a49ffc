#include "movis/control/limits.h"

#include <algorithm>
#include <cmath>

#include "movis/control/wheels.h"

namespace movis::control {
namespace {

// What scales `size` down to `limit`, or 1.
double fraction(double size, double limit) {
  return size <= limit ? 1.0 : limit / size;
}

// The velocity that is aimed at: within the limits, however the robot moves now.
Twist2 within_speeds(Twist2 twist, const RobotModel& robot) {
  const double slower = fraction(std::hypot(twist.vx, twist.vy), robot.limits.speed);
  twist.vx *= slower;
  twist.vy *= slower;
  twist.omega = std::clamp(twist.omega, -robot.limits.turn_rate, robot.limits.turn_rate);
  if (!robot.wheels) return twist;
  double fastest = 0.0;
  for (const double azimuth : robot.wheels->azimuths) {
    fastest = std::max(fastest, std::abs(wheel_rate(*robot.wheels, azimuth, twist)));
  }
  const double shrink = fraction(fastest, robot.wheels->max_rate);
  return {shrink * twist.vx, shrink * twist.vy, shrink * twist.omega};
}

Twist2 between(const Twist2& from, const Twist2& to, double translation_part, double turn_part) {
  return {from.vx + translation_part * (to.vx - from.vx), from.vy + translation_part * (to.vy - from.vy),
          from.omega + turn_part * (to.omega - from.omega)};
}

// How far on the way from `safe` to `wanted` the wheels can follow, 0…1.
double wheels_follow(const OmniWheels& wheels, const Twist2& safe, const Twist2& wanted) {
  double part = 1.0;
  for (const double azimuth : wheels.azimuths) {
    const double start = wheel_rate(wheels, azimuth, safe);
    const double end = wheel_rate(wheels, azimuth, wanted);
    if (std::abs(end) <= wheels.max_rate) continue;
    const double room = wheels.max_rate - (end < 0.0 ? -start : start);
    part = std::min(part, std::clamp(room / std::abs(end - start), 0.0, 1.0));
  }
  return part;
}

}  // namespace

Twist2 limited(const Twist2& wanted, const Twist2& current, const RobotModel& robot, double seconds) {
  const Twist2 target = within_speeds(wanted, robot);
  const double translation_part =
      fraction(std::hypot(target.vx - current.vx, target.vy - current.vy), robot.limits.acceleration * seconds);
  const double turn_part = fraction(std::abs(target.omega - current.omega), robot.limits.turn_acceleration * seconds);
  const Twist2 each = between(current, target, translation_part, turn_part);
  if (!robot.wheels) return each;

  const double slower_part = std::min(translation_part, turn_part);
  const Twist2 together = between(current, target, slower_part, slower_part);
  const double part = wheels_follow(*robot.wheels, together, each);
  return between(together, each, part, part);
}

double settling_time(const Twist2& wanted, const Twist2& current, const RobotModel& robot) {
  const Twist2 target = within_speeds(wanted, robot);
  return std::max(std::hypot(target.vx - current.vx, target.vy - current.vy) / robot.limits.acceleration,
                  std::abs(target.omega - current.omega) / robot.limits.turn_acceleration);
}

}  // namespace movis::control
