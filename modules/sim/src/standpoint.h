#pragma once

#include <Eigen/Core>

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

}  // namespace movis::sim
