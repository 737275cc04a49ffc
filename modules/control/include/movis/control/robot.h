#pragma once

#include "movis/control/command.h"

namespace movis::control {

// A robot that can be driven: a real one, or the simulator's.
class Robot {
 public:
  virtual ~Robot() = default;

  // Takes effect after the robot's latency, and holds until the next one. Throws an Error for a velocity that is not
  // finite, or where the robot cannot be reached; it then stops by itself.
  virtual void send(const Command& command) = 0;
};

}  // namespace movis::control
