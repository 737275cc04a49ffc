#pragma once

#include "landmark_fix.h"

namespace movis::localization {

// The circle on which a goal appears under its measured angle; its centre lies on X = 0, (14).
struct GoalCircle {
  double centre_y = 0.0;                         // Y_Pc or Y_Qc
  double radius = 0.0;                           // r_P or r_Q
  GoalGradient gradient = GoalGradient::Zero();  // of centre_y, by the goal's points
};

// Both circles and the Y at which they meet, (12)–(16) and (18).
struct GoalCircles {
  FixStatus status = FixStatus::no_distance;  // ok, no_distance or coinciding_circles
  GoalCircle p;
  GoalCircle q;
  double y_r = 0.0;
  GoalGradient y_by_yellow = GoalGradient::Zero();
  GoalGradient y_by_blue = GoalGradient::Zero();
};

GoalCircles meet_circles(const triangulation::GoalLandmarks& landmarks, const Field& field);

// w: half the distance between the edges that a camera in front of a goal sees, which are its walls' outer sides.
inline double silhouette_half_width(const Field& field) {
  return field.Fw + field.goal_thickness;
}

// The derivative of atan2(y, x) by the point.
inline Eigen::RowVector2d azimuth_gradient(const Eigen::Vector2d& point) {
  return Eigen::RowVector2d(-point.y(), point.x()) / point.squaredNorm();
}

}  // namespace movis::localization
