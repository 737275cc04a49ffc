#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "movis/core/field.h"

namespace movis::localization {

// The white lines of a field, to match points with: the distance map of
//   M. Lauer, S. Lange, M. Riedmiller: Calculating the perfect match: an efficient and accurate approach for robot
//   self-localization. RoboCup 2005, LNAI 4020.
// The map is a lattice over the field and a margin around it. A cell stores the distance from its middle to the nearest
// line's middle, and which line that is, so that near a line the distance is exact and smooth instead of interpolated.
// Metres, field frame.
class LineMap {
 public:
  explicit LineMap(const Field& field);

  // The distance to the middle of the nearest line, to half a cell; far outside the lattice: that of its border.
  float distance(const Eigen::Vector2d& point_in_field) const;

  // The same exactly, with a sign (which side of the line), and its derivative by the point, a unit vector.
  struct Offset {
    double distance = 0.0;
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  };
  Offset offset(const Eigen::Vector2d& point_in_field) const;

 private:
  // Straight from `a` to `b`, or the arc around `centre` that lies within the angle.
  struct Line {
    bool is_arc = false;
    Eigen::Vector2d a, b;
    double radius = 0.0, from = 0.0, extent = 0.0;
  };
  std::vector<Line> lines_;
};

}  // namespace movis::localization
