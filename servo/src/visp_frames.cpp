#include "visp_frames.h"

#include <visp3/core/vpRotationMatrix.h>
#include <visp3/core/vpTranslationVector.h>

namespace movis::servo {

vpHomogeneousMatrix visp_from(const Pose2& a_from_b) {
  return {vpTranslationVector(a_from_b.x, a_from_b.y, 0.0), vpRotationMatrix(vpThetaUVector(0.0, 0.0, a_from_b.beta))};
}

vpMatrix planar_jacobian() {
  vpMatrix jacobian(6, 3);
  jacobian[0][0] = 1.0;
  jacobian[1][1] = 1.0;
  jacobian[5][2] = 1.0;
  return jacobian;
}

Twist2 twist_from(const vpColVector& joint_velocities) {
  return {joint_velocities[0], joint_velocities[1], joint_velocities[2]};
}

}  // namespace movis::servo
