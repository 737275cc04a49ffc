#pragma once

#include <Eigen/Core>

#include "movis/core/bearing.h"
#include "movis/core/field.h"

namespace movis::localization {

// Between which azimuths a goal is seen: of the field's axes, radians in (−π, π]; left is the larger one. And the
// corners of the goal that are seen there, field frame, metres.
struct Silhouette {
  double left = 0.0;
  double right = 0.0;
  Eigen::Vector2d left_corner = Eigen::Vector2d::Zero();
  Eigen::Vector2d right_corner = Eigen::Vector2d::Zero();
};

// A goal is a box without front and top: two side walls outside its inner width 2 Fw and a back wall outside its depth,
// all upright and as thick as the field's goal_thickness. With w = Fw + goal_thickness and s = +1 for the yellow goal,
// −1 for the blue one its outer corners are
//   (±w, s Fd),   (±w, s (Fd + goal_depth)),   (±Fw, s (Fd + goal_depth + goal_thickness))
// and it is seen between the outermost of their azimuths. From before it those are the front posts', from beside it one
// of them is that of a corner at the back.
// Domain: a viewpoint (field frame, metres) outside the box.
Silhouette goal_silhouette(const Field& field, ObjectClass goal, const Eigen::Vector2d& viewpoint_in_field);

}  // namespace movis::localization
