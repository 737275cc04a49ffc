#include "movis/servo/way_round.h"

#include <algorithm>
#include <cmath>

namespace movis::servo {

double detour_of(const Eigen::Vector2d& robot_in_shot) {
  if (robot_in_shot.isZero(0.0)) return 0.0;
  return std::atan2(-robot_in_shot.x(), -robot_in_shot.y());
}

Eigen::Vector2d waypoint_in_shot(const WayRound& way, double distance, double detour) {
  const double to_tangent = distance > way.orbit ? std::acos(way.orbit / distance) : 0.0;
  const double beyond = std::clamp(std::abs(detour) - to_tangent, 0.0, way.lead);
  const double left = std::max(std::abs(detour) - to_tangent - way.lead, 0.0);

  const double outer = way.orbit / std::cos(way.lead);
  const double radius = way.standoff + (outer - way.standoff) * beyond / way.lead;
  return radius * Eigen::Vector2d(-std::copysign(std::sin(left), detour), -std::cos(left));
}

Eigen::Vector2d clear_of_goals(const Eigen::Vector2d& place, const Field& field, double room) {
  const double depth = std::clamp(std::abs(place.y()), field.Fd, field.Fd + field.goal_depth);
  const Eigen::Vector2d wall(std::copysign(field.Fw, place.x()), std::copysign(depth, place.y()));
  const Eigen::Vector2d offset = place - wall;
  const double distance = offset.norm();
  if (distance >= room) return place;
  const Eigen::Vector2d into_the_mouth(-std::copysign(1.0, place.x()), 0.0);
  return wall + room * (distance > 0.0 ? Eigen::Vector2d(offset / distance) : into_the_mouth);
}

}  // namespace movis::servo
