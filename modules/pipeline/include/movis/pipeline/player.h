#pragma once

#include "movis/control/controller.h"
#include "movis/control/drive.h"
#include "movis/pipeline/pipeline.h"
#include "movis/world/world.h"

// The closed loop:  images → estimate → world → observation → controller → command.
namespace movis::pipeline {

// A robot's eyes, memory and drive. Exchanging the controller is passing another one to play().
struct Player {
  Player(Pipeline vision, const control::RobotModel& robot);

  void start(double time_s);  // of the first images: the robot stands still and knows nothing

  Pipeline vision;
  world::World world;  // as believed at the time of the last images
  control::Drive drive;
};

// One tick: what the robot is to do, now that it sees these images.
control::Command play(Player& player, control::Controller& controller, const grab::FrameSet& images);

}  // namespace movis::pipeline
