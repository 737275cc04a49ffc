#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/field.h"
#include "movis/core/line_point.h"
#include "movis/localization/line_map.h"
#include "movis/omni/rig.h"
#include "movis/triangulation/goal_points.h"

namespace movis::localization {

// What one instant tells of the robot's place.
struct Instant {
  const omni::Rig& rig;
  const std::vector<Bearing>& bearings;
  const triangulation::GoalLandmarks& goals;  // triangulated from the bearings, robot frame
  const std::vector<LinePoint>& lines;
};

// The field and what is worked out of it once.
struct FieldMap {
  explicit FieldMap(const Field& known) : field(known), lines(known) {}

  Field field;
  LineMap lines;
};

}  // namespace movis::localization
