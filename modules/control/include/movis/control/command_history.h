#pragma once

#include <cstddef>
#include <vector>

#include "movis/control/command.h"
#include "movis/control/robot_model.h"
#include "movis/core/pose.h"

namespace movis::control {

// The commands that were sent lately, and what they make of the robot. A command sent at time t acts from
// t + latency on, and the velocity follows it within the robot's limits. That is all the robot knows of its motion
// between images, and it is what makes the latency harmless: the controller is shown the world as it will be when its
// command acts.
class CommandHistory {
 public:
  explicit CommandHistory(const RobotModel& robot);

  void start(double time_s);  // forgets everything: the robot stands still, up to this time and until a command acts
  // Throws an Error where times fall. A second command of the same time replaces the first. Allocates nothing.
  void sent(const Command& command, double time_s);

  // The motion from time `from` to `to` by the commands: from_from_to. Both may lie in the future of the last command,
  // which is then taken to hold. Throws an Error where `from` lies further in the past than the last 32 commands.
  Pose2 motion(double from_s, double to_s) const;

  // The velocity at a time; the same limits of time.
  Twist2 velocity(double time_s) const;

 private:
  struct Sent {
    double acts_s;   // from here on
    Twist2 initial;  // the robot's velocity as it begins to act
    Twist2 wanted;
  };
  std::size_t acting(double time_s) const;  // index of the command that acts at a time
  Twist2 velocity(const Sent& sent, double time_s) const;
  Pose2 motion(const Sent& sent, double from_s, double to_s) const;

  RobotModel robot_;
  std::size_t capacity_;
  std::vector<Sent> sent_;  // by time, the oldest first; never empty
  double last_sent_s_ = 0.0;
};

}  // namespace movis::control
