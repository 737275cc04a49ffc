#include "movis/pipeline/player.h"

#include <utility>

namespace movis::pipeline {

Player::Player(Pipeline vision_used, const control::RobotModel& robot)
    : vision(std::move(vision_used)), drive(robot, vision.options.world) {}

void Player::start(double time_s) {
  world = {};
  world.time_s = time_s;
  drive.start(time_s);
}

control::Command play(Player& player, control::Controller& controller, const grab::FrameSet& images) {
  const Estimate& estimate = step(player.vision, images);
  const Pose2 motion = player.drive.motion(player.world.time_s, estimate.time_s);
  player.world = world::updated(player.world, estimate.time_s, motion, estimate.fix, estimate.ball_in_robot);
  return player.drive.step(controller, estimate.bearings, player.world);
}

}  // namespace movis::pipeline
