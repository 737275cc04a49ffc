#include "movis/control/drive.h"

#include <cmath>

#include "movis/control/limits.h"

namespace movis::control {
namespace {

bool finite(const Twist2& twist) {
  return std::isfinite(twist.vx) && std::isfinite(twist.vy) && std::isfinite(twist.omega);
}

DriveStatus freshness(const world::World& world, const world::WorldOptions& options) {
  if (!has_pose(world, options)) return DriveStatus::stale_pose;
  if (!has_ball(world, options)) return DriveStatus::stale_ball;
  return DriveStatus::ok;
}

}  // namespace

const char* word(DriveStatus status) {
  switch (status) {
    case DriveStatus::ok:
      return "ok";
    case DriveStatus::stale_pose:
      return "stale_pose";
    case DriveStatus::stale_ball:
      return "stale_ball";
    case DriveStatus::not_finite:
      return "not_finite";
  }
  return "?";
}

Drive::Drive(const RobotModel& robot, const world::WorldOptions& options)
    : robot_(robot), options_(options), history_(robot) {}

void Drive::start(double time_s) {
  history_.start(time_s);
  status_ = DriveStatus::ok;
}

Command Drive::wanted(Controller& controller, const std::vector<Bearing>& bearings, const world::World& world,
                      double acts_s) {
  status_ = freshness(world, options_);
  if (status_ != DriveStatus::ok) return {};
  const world::World then = carried(world, acts_s, history_.motion(world.time_s, acts_s));
  const Command command = controller.step({bearings, then, world.time_s});
  if (finite(command.velocity)) return command;
  status_ = DriveStatus::not_finite;
  return {};
}

Command Drive::step(Controller& controller, const std::vector<Bearing>& bearings, const world::World& world) {
  const double acts_s = world.time_s + robot_.latency();
  Command command = wanted(controller, bearings, world, acts_s);
  command.velocity = limited(command.velocity, history_.velocity(acts_s), robot_, robot_.frame_period());
  history_.sent(command, world.time_s);
  return command;
}

}  // namespace movis::control
