#pragma once

#include <visp3/vs/vpServo.h>

#include <Eigen/Core>

#include "movis/core/twist.h"

namespace movis::servo {

// One vpServo that drives a robot on the floor, for those who bring ViSP features of their own:
//   (vx, vy, ω) = −λ (L cVe eJe)⁺ e,  e = s − s*,
// with the robot frame as the end effector's (e) and as the camera's (c), so cVe is the identity, and with the 6×3
// Jacobian of a plane as eJe. Features are therefore those of an observer at the robot's origin whose axes are the
// robot's: x right, y forward, z up. F. Chaumette, S. Hutchinson, Visual servo control, part I, IEEE Robotics &
// Automation Magazine 13(4), 2006.
//
// The interaction matrix is computed anew in every step, so that s* may change where it is taken at s*.
class PlanarTask {
 public:
  PlanarTask(vpServo::vpServoIteractionMatrixType interaction, const vpAdaptiveGain& gain);
  ~PlanarTask();
  PlanarTask(const PlanarTask&) = delete;
  PlanarTask& operator=(const PlanarTask&) = delete;

  // The caller owns both features, keeps them alive and updates them before each step.
  void add(vpBasicFeature& feature, vpBasicFeature& desired, unsigned int select = vpBasicFeature::FEATURE_ALL);

  // The velocity that the features ask for. Features must be finite, and there must be one at least.
  Twist2 velocity();

  // e of the last step, the features in the order in which they were added.
  double error(unsigned int component) const { return task_.error[component]; }

 private:
  vpServo task_;
};

}  // namespace movis::servo
