#pragma once

#include <Eigen/Core>
#include <cmath>

#include "movis/core/pose.h"

namespace movis::sim {

// Where an eye is at a moment.
struct Standpoint {
  Eigen::Vector3f origin;  // of the eye, field frame
  Eigen::Vector2f robot;   // field frame
  float cosine, sine;      // of the robot's β

  Eigen::Vector3f to_field(const Eigen::Vector3f& direction_in_robot) const {
    const Eigen::Vector3f& d = direction_in_robot;
    return {cosine * d.x() - sine * d.y(), sine * d.x() + cosine * d.y(), d.z()};
  }
};

inline Standpoint make_standpoint(const Eigen::Vector3f& eye_in_robot, const Pose2& world_from_robot) {
  Standpoint standpoint{{},
                        world_from_robot.translation().cast<float>(),
                        static_cast<float>(std::cos(world_from_robot.beta)),
                        static_cast<float>(std::sin(world_from_robot.beta))};
  standpoint.origin = standpoint.to_field(eye_in_robot);
  standpoint.origin.head<2>() += standpoint.robot;
  return standpoint;
}

}  // namespace movis::sim
