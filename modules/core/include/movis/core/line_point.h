#pragma once

#include <Eigen/Core>

namespace movis {

// A point on the middle of a white line, as one camera sees it: the direction in the robot's axes (as of a Bearing) and
// where it meets the floor.
struct LinePoint {
  int camera = -1;         // index into the rig
  double azimuth = 0.0;    // radians
  double elevation = 0.0;  // radians, negative
  double sigma = 0.0;      // of the direction, across the line, radians

  Eigen::Vector2d point = Eigen::Vector2d::Zero();  // on the floor, robot frame, metres
  double sigma_on_floor = 0.0;                      // of the point, across the line, metres
};

}  // namespace movis
