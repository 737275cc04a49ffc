#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/omni/rig.h"

namespace movis::experiments {

// From the bearings of a ball, by the rig that is believed.
using Estimator = PointEstimate (*)(const omni::Rig& rig, const std::vector<Bearing>& bearings);

Estimator estimator_of(int system);  // of kSystems

}  // namespace movis::experiments
