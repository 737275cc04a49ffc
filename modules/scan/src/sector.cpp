#include "movis/scan/sector.h"

#include <algorithm>
#include <cmath>

namespace movis::scan {

std::vector<Sector> sensor_sectors(const omni::Rig& rig, int camera, double sensor_radius) {
  std::vector<Sector> sectors;
  for (int other = 0; other < static_cast<int>(rig.cameras.size()); ++other) {
    const Eigen::Vector2d towards = (rig.cameras[other].position - rig.cameras[camera].position).head<2>();
    if (other == camera || towards.norm() < 1e-6) continue;  // itself, or one above the other
    const double reach = std::min(1.0, sensor_radius / towards.norm());
    sectors.push_back({std::atan2(towards.y(), towards.x()), std::asin(reach)});
  }
  return sectors;
}

}  // namespace movis::scan
