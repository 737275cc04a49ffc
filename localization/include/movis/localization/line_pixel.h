#pragma once

#include <Eigen/Core>
#include <optional>

#include "movis/core/line_point.h"
#include "movis/omni/rig.h"

namespace movis::localization {

// Where a white pixel meets the floor z = 0, as one camera (the index-th of its rig) sees it; nothing for a pixel without
// a ray or whose ray does not go down.
//
// The pixel may lie anywhere on the line's width, and the camera's model is good to about a pixel, so
//   sigma_on_floor = √(line²/12 + p²),   p = 1/s the longest way on the floor that moves the picture by a pixel,
// s being the smaller singular value of ∂pixel/∂(x, y) on the floor. `sigma` is that of the direction: p seen from the
// viewpoint. Metres, radians.
std::optional<LinePoint> line_point(const omni::Camera& camera, int index, const Eigen::Vector2d& pixel, double line);

}  // namespace movis::localization
