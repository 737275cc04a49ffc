#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/world/world.h"

namespace movis::control {

// All that a controller sees, of one tick.
struct Observation {
  const std::vector<Bearing>& bearings;  // of this tick's images
  world::World world;                    // as it will be when the command acts
  double time_s = 0.0;                   // of the images
};

}  // namespace movis::control
