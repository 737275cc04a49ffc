#pragma once

#include <cstdint>
#include <vector>

#include "movis/control/command_history.h"
#include "movis/control/controller.h"
#include "movis/control/percepts.h"

namespace movis::control {

// What became of a tick's command.
enum class DriveStatus : std::uint8_t {
  ok,
  stale_pose,  // no fix for longer than WorldOptions allows: the robot stops
  stale_ball,
  not_finite,  // the controller returned NaN or infinity: the robot stops
};

const char* word(DriveStatus status);

// Between a controller and a robot, the same for every controller: carries the world to the time at which the command
// will act, stops where the world is stale or the command is no number, and keeps the command within what the robot can
// reach in one frame. A stop is braking within the limits. It ends with the first tick that gives no more cause for it.
//
// An estimate is stale by its age at the time of the images; that the latency is still to come is no fault of it.
class Drive {
 public:
  Drive(const RobotModel& robot, const world::WorldOptions& options);

  void start(double time_s);  // the robot stands still

  // The robot's motion between two instants, by the commands sent: for world::updated.
  Pose2 motion(double from_s, double to_s) const { return history_.motion(from_s, to_s); }

  // The command for the robot, taken as sent at the time of the images. `world` is believed at that time, which must
  // not fall from step to step.
  Command step(Controller& controller, const std::vector<Bearing>& bearings, const world::World& world);

  DriveStatus status() const { return status_; }  // of the last step

 private:
  Command wanted(Controller& controller, const std::vector<Bearing>& bearings, const world::World& world,
                 double acts_s);

  RobotModel robot_;
  world::WorldOptions options_;
  CommandHistory history_;
  DriveStatus status_ = DriveStatus::ok;
};

}  // namespace movis::control
