#include "movis/localization/goal_silhouette.h"

#include <cmath>

namespace movis::localization {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Silhouette goal_silhouette(const Field& field, ObjectClass goal, const Eigen::Vector2d& viewpoint_in_field) {
  const double side = goal == ObjectClass::yellow_goal ? 1.0 : -1.0;
  const double width = field.Fw + field.goal_thickness;
  const double back = field.Fd + field.goal_depth;
  // From outside all corners lie within less than 180° of each other: a cross product tells which is farther left.
  Eigen::Vector2d leftmost = Eigen::Vector2d(width, side * field.Fd) - viewpoint_in_field;
  Eigen::Vector2d rightmost = leftmost;
  const auto include = [&](double x, double y) {
    const Eigen::Vector2d corner = Eigen::Vector2d(x, side * y) - viewpoint_in_field;
    if (cross(leftmost, corner) > 0.0) leftmost = corner;
    if (cross(rightmost, corner) < 0.0) rightmost = corner;
  };
  include(-width, field.Fd);
  for (const double sign : {1.0, -1.0}) {
    include(sign * width, back);
    include(sign * field.Fw, back + field.goal_thickness);
  }
  return {std::atan2(leftmost.y(), leftmost.x()), std::atan2(rightmost.y(), rightmost.x()),
          viewpoint_in_field + leftmost, viewpoint_in_field + rightmost};
}

}  // namespace movis::localization
