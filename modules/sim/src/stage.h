#pragma once

#include <vector>

#include "hall.h"
#include "movis/control/robot_model.h"
#include "prop.h"

namespace movis::sim {

// The world at one moment, in the field frame.
struct Stage {
  Stage(const Arena& arena, const control::RobotModel& robot, const Look& look);

  void set(const State& state);  // moves robot and ball

  Hall hall;
  std::vector<Prop> props;  // the ball is the last one
  std::vector<Shadow> shadows;

 private:
  Look look_;
  float robot_radius_;
};

}  // namespace movis::sim
