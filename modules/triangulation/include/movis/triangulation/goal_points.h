#pragma once

#include <Eigen/Core>

#include "movis/core/status.h"

namespace movis::triangulation {

// A goal's landmarks on the floor plane of the robot frame, metres. `centre` comes from the bearings midway between
// the goal's edges in each camera (the paper's landmark of method 1), `left` and `right` from the bearings of the
// edges themselves (method 2). Left is the larger azimuth: P1 of the yellow goal and Q2 of the blue one, as seen from
// inside the field.
struct GoalPoints {
  PointStatus centre_status = PointStatus::not_seen;
  PointStatus edges_status = PointStatus::not_seen;  // ok: both edges
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d left = Eigen::Vector2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();

  // Of (centre, left, right). The centre comes from the same edges, so the blocks are correlated. Rows of a point
  // whose status is not ok are zero.
  using Covariance = Eigen::Matrix<double, 6, 6>;
  Covariance covariance = Covariance::Zero();
};

struct GoalLandmarks {
  GoalPoints yellow;
  GoalPoints blue;
};

}  // namespace movis::triangulation
