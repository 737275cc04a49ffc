#pragma once

#include <optional>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/field.h"
#include "movis/core/pose.h"
#include "movis/omni/rig.h"

namespace movis::calibration {

// A pose of the robot from the goals' edges in its cameras, by search over the field: a start for a better estimate. At
// every place of a lattice each edge proposes the heading that makes it fit, and the heading that most edges agree with
// counts. Nothing where there are fewer than four edges.
std::optional<Pose2> search_pose(const omni::Rig& rig, const std::vector<Bearing>& goals, const Field& field);

}  // namespace movis::calibration
