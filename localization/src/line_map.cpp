#include "movis/localization/line_map.h"

namespace movis::localization {

LineMap::LineMap(const Field& /*field*/) {}

float LineMap::distance(const Eigen::Vector2d& point_in_field) const {
  return static_cast<float>(offset(point_in_field).distance);
}

LineMap::Offset LineMap::offset(const Eigen::Vector2d& /*point_in_field*/) const {
  return {};
}

}  // namespace movis::localization
