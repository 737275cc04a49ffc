#pragma once

#include <vector>

#include "movis/omni/rig.h"

namespace movis::scan {

// Azimuths around a middle, in the robot's axes; radians.
struct Sector {
  double azimuth = 0.0;
  double half_width = 0.0;
};

// Where the other sensor units of the rig, cylinders of this radius, stand in a camera's view.
std::vector<Sector> sensor_sectors(const omni::Rig& rig, int camera, double sensor_radius);

}  // namespace movis::scan
