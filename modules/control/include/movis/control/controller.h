#pragma once

#include <string>
#include <vector>

#include "movis/control/command.h"
#include "movis/control/observation.h"

namespace movis::control {

// A number of a controller's inside that is worth a curve: a behaviour's weight, a task's error.
struct Signal {
  std::string name;  // e.g. "approach", "e_x"
  std::string unit;  // "" for a weight of 0…1, else e.g. "m", "°"
  double value = 0.0;
};

// Drives the robot to the ball and shoots. Called once a tick, and only with a world whose pose and ball are fresh.
class Controller {
 public:
  virtual ~Controller() = default;

  virtual void start() = 0;  // a new episode: forgets the last one
  virtual Command step(const Observation& observation) = 0;

  // Of the last step; the same names and units in the same order every time, from the beginning on.
  virtual const std::vector<Signal>& signals() const = 0;
};

}  // namespace movis::control
