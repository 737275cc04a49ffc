#include "movis/servo/planar_task.h"

#include "visp_frames.h"

namespace movis::servo {

PlanarTask::PlanarTask(vpServo::vpServoIteractionMatrixType interaction, const vpAdaptiveGain& gain) {
  task_.setServo(vpServo::EYEINHAND_L_cVe_eJe);
  task_.setInteractionMatrixType(interaction, vpServo::PSEUDO_INVERSE);
  task_.setForceInteractionMatrixComputation(true);  // else a matrix at s* is computed once for all times
  task_.setLambda(gain);
}

PlanarTask::~PlanarTask() {
  task_.kill();
}

void PlanarTask::add(vpBasicFeature& feature, vpBasicFeature& desired, unsigned int select) {
  task_.addFeature(feature, desired, select);
}

Twist2 PlanarTask::velocity() {
  // ViSP forgets both after each control law.
  task_.set_cVe(vpVelocityTwistMatrix());
  task_.set_eJe(planar_jacobian());
  return twist_from(task_.computeControlLaw());
}

}  // namespace movis::servo
