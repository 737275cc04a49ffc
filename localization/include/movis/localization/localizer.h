#pragma once

#include <string_view>
#include <vector>

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/triangulation/goal_points.h"

namespace movis::localization {

// Every localizer is a function of one instant with this signature, so that comparing them is a table.
using Localizer = Fix (*)(const triangulation::GoalLandmarks&, const Field&);

// A fix farther than this beyond the lines or the goals' backs is not believed, but outside_field. The margin leaves
// room for noise and for a robot that was pushed off the field; metres.
inline constexpr double kOutsideMargin = 1.0;

// The localizer of that name, or nullptr where there is none.
Localizer find_localizer(std::string_view name);

// The names that find_localizer knows, in the order of the paper.
std::vector<std::string_view> localizer_names();

}  // namespace movis::localization
