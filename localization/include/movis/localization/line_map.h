#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "movis/core/field.h"

namespace movis::localization {

// The white lines of a field, to match points with: the distance map of
//   M. Lauer, S. Lange, M. Riedmiller: Calculating the perfect match: an efficient and accurate approach for robot
//   self-localization. RoboCup 2005, LNAI 4020.
// The lines are those of field.yaml: the outer edges of border, penalty and goal areas are given, so the middle of their
// lines lies half a line inside; the middle line; the centre circle; the corner arcs, about the outer corners.
//
// Both axes of the field mirror its lines, so one quarter of it is kept: x and y ≥ 0, and a margin of 2 m around. A cell
// of that lattice stores the distance from its middle to the nearest line's middle, and which lines can be the nearest
// one of any point in it. From these the distance is worked out exactly, not interpolated. Cells measure half a line's
// width, at most 5 cm, and more where a field is so large that it would take more than 200,000 of them.
// Metres, field frame. The domain is the plane; a field with `line: 0` has no lines.
class LineMap {
 public:
  explicit LineMap(const Field& field);

  bool empty() const { return lines_.empty(); }

  // The distance from the middle of the point's cell to the middle of the nearest line: that of the point to 0.71 cells;
  // outside the lattice: that of its border. Without lines: kFar.
  float distance(const Eigen::Vector2d& point_in_field) const;

  // The same exactly, with a sign (which side of the line), and its derivative by the point, a unit vector. Where two
  // lines are equally near, at their junctions and midway between them, it is one of them. Without lines: kFar, and no
  // normal.
  struct Offset {
    double distance = 0.0;
    Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  };
  Offset offset(const Eigen::Vector2d& point_in_field) const;

  static constexpr double kFar = 1e3;

  // Which part of the field lies within so many metres (not below 0) of a line's middle; in steps of 2 cm, up to 1 m.
  double share_within(double metres) const;

  // For the search over all positions (line_match.h), with `step` 1/24 of the half width: the cost
  // 255 d²/(step² + d²) of being d away from a line, in cells of half a step over the whole field and kReach steps
  // around kBeyond steps around it. Cells of the same parity of column and of row lie together, so that moving a point
  // by a step moves it to the next byte: cost[parity_row][parity_column][row][column].
  static constexpr int kBeyond = 2, kReach = 32;
  struct Costs {
    double step = 0.0;
    double left = 0.0, bottom = 0.0;  // of the first cell's corner
    int columns = 0, rows = 0;        // of one parity
    std::vector<std::uint8_t> cost;
    const std::uint8_t* row(int cell_row, int cell_column) const {  // from the cell on, every other cell
      const int plane = 2 * (cell_row & 1) + (cell_column & 1);
      return cost.data() + (static_cast<std::ptrdiff_t>(plane) * rows + cell_row / 2) * columns + cell_column / 2;
    }
  };
  const Costs& costs() const { return costs_; }

 private:
  // In the quarter x, y ≥ 0. An arc is drawn where x and y are at most `from` and `to`: it ends on the border's lines.
  struct Line {
    enum class Shape : std::uint8_t { at_x, at_y, arc } shape;
    double at = 0.0;              // x or y of a straight line; the radius of an arc
    double from = 0.0, to = 0.0;  // along the straight line
    double centre_x = 0.0, centre_y = 0.0;
    bool on_axis = false;  // on the x axis: the sign of its distance does not mirror
  };

  static constexpr int kCandidates = 4;
  static constexpr std::uint8_t kNone = 0xFF;

  void add_areas(const Field& field);
  void fill_cells();
  void fill_costs(const Field& field);
  void fill_shares(const Field& field);
  int cell(double x, double y) const;
  static double distance_to(const Line& line, double x, double y, Eigen::Vector2d& normal);

  std::vector<Line> lines_;
  int columns_ = 0, rows_ = 0;
  double per_metre_ = 0.0;                                         // cells
  std::vector<float> distances_;                                   // row by row
  std::vector<std::array<std::uint8_t, kCandidates>> candidates_;  // nearest first, then kNone
  Costs costs_;
  std::array<double, 51> shares_{};
};

}  // namespace movis::localization
