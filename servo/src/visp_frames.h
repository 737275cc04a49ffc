#pragma once

#include <visp3/core/vpColVector.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpMatrix.h>

#include "movis/core/pose.h"
#include "movis/core/twist.h"

// The one place where our frames become ViSP's and back. ViSP writes aMb for what is a_from_b here: the pose of b in a.
// Its cMo is then robot_from_object, because the robot frame is both the camera frame c and the end effector's frame e
// (eMc is the identity): what is servoed is a pose in the robot frame, and cameras have been dealt with before.
namespace movis::servo {

vpHomogeneousMatrix visp_from(const Pose2& a_from_b);

// The Jacobian that takes a robot's (vx, vy, ω) to ViSP's twist (vx, vy, vz, ωx, ωy, ωz) of its frame: 6×3.
vpMatrix planar_jacobian();

Twist2 twist_from(const vpColVector& joint_velocities);

}  // namespace movis::servo
