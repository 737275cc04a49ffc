#include "movis/localization/line_map.h"

#include <algorithm>
#include <cmath>

namespace movis::localization {
namespace {

constexpr double kMargin = 2.0;  // of the lattice around the field, metres
constexpr double kLargestCell = 0.05;
constexpr double kMostCells = 200'000.0;
constexpr double kShareStep = 0.02;  // metres

double cell_size(const Field& field, double area) {
  return std::max(std::min(kLargestCell, 0.5 * field.line), std::sqrt(area / kMostCells));
}

}  // namespace

LineMap::LineMap(const Field& field) {
  const double width = field.half_width + kMargin;
  const double length = field.half_length + kMargin;
  if (field.line > 0.0) {
    const double side = field.half_width - 0.5 * field.line;
    const double end = field.half_length - 0.5 * field.line;
    using Shape = Line::Shape;
    lines_.push_back({Shape::at_x, side, 0.0, end});
    lines_.push_back({Shape::at_y, end, 0.0, side});
    lines_.push_back({Shape::at_y, 0.0, 0.0, side, 0.0, 0.0, true});
    if (field.circle > 0.0) lines_.push_back({Shape::arc, field.circle, side, end});
    if (field.corner_arc > 0.0)
      lines_.push_back({Shape::arc, field.corner_arc, side, end, field.half_width, field.half_length});
    add_areas(field);
  }
  const double cell = cell_size(field, width * length);
  per_metre_ = 1.0 / cell;
  columns_ = static_cast<int>(std::ceil(width / cell));
  rows_ = static_cast<int>(std::ceil(length / cell));
  fill_cells();
  fill_costs(field);
  fill_shares(field);
}

// What reaches beyond the border is not drawn.
void LineMap::add_areas(const Field& field) {
  const double side = field.half_width - 0.5 * field.line;
  const double end = field.half_length - 0.5 * field.line;
  for (const Field::Area& area : {field.penalty_area, field.goal_area}) {
    if (area.depth <= 0.0) continue;
    const double x = 0.5 * (area.width - field.line);
    const double y = field.half_length - area.depth + 0.5 * field.line;
    if (x > 0.0 && x < side) lines_.push_back({Line::Shape::at_x, x, std::max(y, 0.0), end});
    if (y > 0.0 && y < end) lines_.push_back({Line::Shape::at_y, y, 0.0, std::min(x, side)});
  }
}

void LineMap::fill_cells() {
  const double cell = 1.0 / per_metre_;
  const double across = std::sqrt(2.0) * cell;  // from corner to corner
  distances_.reserve(static_cast<std::size_t>(columns_) * rows_);
  candidates_.reserve(distances_.capacity());
  std::vector<std::pair<double, std::uint8_t>> near(lines_.size());
  Eigen::Vector2d normal;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      for (std::size_t i = 0; i < lines_.size(); ++i) {
        const double away = distance_to(lines_[i], (column + 0.5) * cell, (row + 0.5) * cell, normal);
        near[i] = {std::abs(away), static_cast<std::uint8_t>(i)};
      }
      std::sort(near.begin(), near.end());
      std::array<std::uint8_t, kCandidates> candidates;
      candidates.fill(kNone);
      // No other line is nearer to any point of the cell: moving from its middle to there changes each distance by half
      // a diagonal at most.
      for (std::size_t i = 0; i < std::min<std::size_t>(kCandidates, near.size()); ++i)
        if (near[i].first <= near[0].first + across) candidates[i] = near[i].second;
      candidates_.push_back(candidates);
      distances_.push_back(static_cast<float>(near.empty() ? kFar : near[0].first));
    }
  }
}

void LineMap::fill_costs(const Field& field) {
  const double step = field.half_width / 24.0;
  const int around = kBeyond + kReach;
  costs_.step = step;
  costs_.left = -field.half_width - around * step;
  costs_.bottom = -field.half_length - around * step;
  costs_.columns = static_cast<int>(std::ceil(-2.0 * costs_.left / step)) + 1;
  costs_.rows = static_cast<int>(std::ceil(-2.0 * costs_.bottom / step)) + 1;
  costs_.cost.reserve(std::size_t{4} * costs_.columns * costs_.rows);
  for (const int parity_row : {0, 1}) {
    for (const int parity_column : {0, 1}) {
      for (int row = 0; row < costs_.rows; ++row) {
        for (int column = 0; column < costs_.columns; ++column) {
          const Eigen::Vector2d middle(costs_.left + (column + 0.5 * parity_column + 0.25) * step,
                                       costs_.bottom + (row + 0.5 * parity_row + 0.25) * step);
          const double relative = offset(middle).distance / step;
          const double squared = relative * relative;
          costs_.cost.push_back(static_cast<std::uint8_t>(std::lround(255.0 * squared / (1.0 + squared))));
        }
      }
    }
  }
}

void LineMap::fill_shares(const Field& field) {
  const int columns = static_cast<int>(std::ceil(field.half_width * per_metre_));
  const int rows = static_cast<int>(std::ceil(field.half_length * per_metre_));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double away = distances_[row * columns_ + column];
      for (std::size_t i = 0; i < shares_.size(); ++i)
        if (away <= static_cast<double>(i) * kShareStep) shares_[i] += 1.0 / (static_cast<double>(rows) * columns);
    }
  }
}

double LineMap::share_within(double metres) const {
  constexpr double kLast = std::tuple_size_v<decltype(shares_)> - 1.0;
  return shares_[static_cast<std::size_t>(std::min(kLast, std::round(metres / kShareStep)))];
}

// Takes |x| and |y|; what is no number goes to the last cell.
int LineMap::cell(double x, double y) const {
  const int column = static_cast<int>(std::min(columns_ - 1.0, x * per_metre_));
  const int row = static_cast<int>(std::min(rows_ - 1.0, y * per_metre_));
  return row * columns_ + column;
}

float LineMap::distance(const Eigen::Vector2d& point_in_field) const {
  return distances_[cell(std::abs(point_in_field.x()), std::abs(point_in_field.y()))];
}

// With a sign; the normal is its derivative. (x, y) in the quarter.
double LineMap::distance_to(const Line& line, double x, double y, Eigen::Vector2d& normal) {
  if (line.shape == Line::Shape::arc) {
    normal = {x - line.centre_x, y - line.centre_y};
    const double radius = normal.norm();
    // Outside of it, the border is never farther.
    if (x > line.from || y > line.to) return kFar;
    if (radius > 0.0)
      normal /= radius;
    else
      normal = Eigen::Vector2d::UnitX();
    return radius - line.at;
  }
  const bool at_x = line.shape == Line::Shape::at_x;
  const double across = at_x ? x - line.at : y - line.at;
  const double along = at_x ? y : x;
  const double beyond = along - std::clamp(along, line.from, line.to);
  if (beyond == 0.0) {
    normal = at_x ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
    return across;
  }
  const double away = std::copysign(std::sqrt(across * across + beyond * beyond), across);
  normal = at_x ? Eigen::Vector2d(across, beyond) : Eigen::Vector2d(beyond, across);
  normal /= away;
  return away;
}

LineMap::Offset LineMap::offset(const Eigen::Vector2d& point_in_field) const {
  const double x = std::abs(point_in_field.x());
  const double y = std::abs(point_in_field.y());
  Offset nearest{kFar, Eigen::Vector2d::Zero()};
  bool on_axis = false;
  for (const std::uint8_t candidate : candidates_[cell(x, y)]) {
    if (candidate == kNone) break;
    Eigen::Vector2d normal;
    const double distance = distance_to(lines_[candidate], x, y, normal);
    if (!(std::abs(distance) < std::abs(nearest.distance))) continue;
    nearest = {distance, normal};
    on_axis = lines_[candidate].on_axis;
  }
  if (point_in_field.x() < 0.0) nearest.normal.x() = -nearest.normal.x();
  if (point_in_field.y() < 0.0) {
    nearest.normal.y() = -nearest.normal.y();
    if (on_axis) {
      nearest.distance = -nearest.distance;
      nearest.normal = -nearest.normal;
    }
  }
  return nearest;
}

}  // namespace movis::localization
