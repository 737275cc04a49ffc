#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "movis/core/field.h"
#include "movis/core/line_point.h"
#include "movis/core/pose.h"
#include "movis/core/random.h"

// A large field with every kind of line, and white points on it, made without the code under test.
namespace movis::test {

inline Field large_field() {
  Field field;
  field.half_width = 6.0;
  field.half_length = 9.0;
  field.circle = 2.0;
  field.line = 0.125;
  field.Fd = 9.0;
  field.Fw = 1.0;
  field.goals = Field::Goals::white;
  field.penalty_area = {2.25, 6.5};
  field.goal_area = {0.75, 3.5};
  field.corner_arc = 0.75;
  return field;
}

inline bool in_frame(double x, double y, double half_width, double from_y, double to_y, double line) {
  const bool outer = std::abs(x) <= half_width && y >= from_y && y <= to_y;
  const bool inner = std::abs(x) < half_width - line && y > from_y + line && y < to_y - line;
  return outer && !inner;
}

// Whether a point of large_field() is white: what its rectangles and circles paint.
inline bool is_white(const Field& f, double x, double y) {
  if (std::abs(x) > f.half_width || std::abs(y) > f.half_length) return false;
  const double h = 0.5 * f.line;
  if (in_frame(x, y, f.half_width, -f.half_length, f.half_length, f.line) || std::abs(y) < h) return true;
  if (std::abs(std::hypot(x, y) - f.circle) < h) return true;
  if (std::abs(std::hypot(std::abs(x) - f.half_width, std::abs(y) - f.half_length) - f.corner_arc) < h) return true;
  for (const Field::Area& area : {f.penalty_area, f.goal_area})
    if (in_frame(x, std::abs(y), 0.5 * area.width, f.half_length - area.depth, f.half_length, f.line)) return true;
  return false;
}

inline LinePoint seen_point(const Pose2& world_from_robot, const Eigen::Vector2d& in_world, double sigma) {
  LinePoint point;
  point.point = inverse(world_from_robot) * in_world;
  point.sigma_on_floor = sigma;
  return point;
}

// White points all around the robot, as pixels fill the lines' width, with `noise` (metres) on top; the share `stray` of
// them lies anywhere instead.
inline std::vector<LinePoint> white_points(const Field& field, const Pose2& world_from_robot, int count, double range,
                                           double noise, double stray, RandomStream& random) {
  std::uniform_real_distribution<double> anywhere(-range, range), share(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<LinePoint> points;
  while (static_cast<int>(points.size()) < count) {
    const bool strays = share(random) < stray;
    for (;;) {
      const Eigen::Vector2d in_robot(anywhere(random), anywhere(random));
      const Eigen::Vector2d in_world = world_from_robot * in_robot;
      if (in_robot.norm() > range || (!strays && !is_white(field, in_world.x(), in_world.y()))) continue;
      LinePoint point;
      point.point = in_robot + noise * Eigen::Vector2d(normal(random), normal(random));
      point.sigma_on_floor = std::sqrt(field.line * field.line / 12.0 + noise * noise);
      points.push_back(point);
      break;
    }
  }
  return points;
}

}  // namespace movis::test
