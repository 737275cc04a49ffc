#pragma once

#include <Eigen/Core>

namespace movis {

// What hides the floor from one camera and is neither ball nor goal. Azimuths as of a Bearing.
struct ObstacleSight {
  int camera = -1;     // index into the rig
  double left = 0.0;   // the larger azimuth
  double right = 0.0;  // radians
  double distance = 0.0;  // on the floor, from under the camera's viewpoint to the nearest point of the foot, metres
  double sigma = 0.0;     // of the distance, metres
};

// An obstacle of this instant, from all cameras that see it. Robot frame.
struct Obstacle {
  double azimuth = 0.0;   // of its middle, from the robot's origin, radians
  double distance = 0.0;  // from the robot's origin to the nearest point of the foot, metres
  double width = 0.0;     // metres
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();  // that nearest point, metres
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of `foot`, m²
  int cameras = 0;        // that see it
};

}  // namespace movis
