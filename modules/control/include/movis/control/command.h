#pragma once

#include "movis/core/twist.h"

namespace movis::control {

// What a robot is told to do until the next command comes.
struct Command {
  Twist2 velocity;  // robot frame
  bool kick = false;
};

}  // namespace movis::control
