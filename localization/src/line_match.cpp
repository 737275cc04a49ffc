#include "movis/localization/line_match.h"

#include <algorithm>
#include <cmath>

#include "line_descent.h"
#include "line_search.h"
#include "movis/core/median.h"

namespace movis::localization {
namespace {

// The same place but for the half turn.
constexpr double kSamePlace = 0.15;   // metres
constexpr double kSameTurn = 0.0524;  // radians, 3°

bool near(const Pose2& a, const Pose2& b) {
  return std::hypot(a.x - b.x, a.y - b.y) < kSamePlace && std::abs(turn(a.beta, b.beta)) < kSameTurn;
}

// At most kMostThinned, in their order.
void keep_evenly(std::vector<LineSample>& points) {
  const std::size_t count = points.size();
  if (count <= kMostThinned) return;
  for (std::size_t i = 0; i < kMostThinned; ++i) points[i] = points[i * count / kMostThinned];
  points.resize(kMostThinned);
}

void take_points(const std::vector<LinePoint>& points, const FieldMap& map, const LineMatchOptions& options,
                 LineMatchScratch& scratch) {
  scratch.points.clear();
  scratch.thinned.clear();
  const double reach = LineMap::kReach * map.lines.costs().step;
  const double square = std::max(map.field.line, reach / 200.0);
  const auto side = static_cast<std::size_t>(std::ceil(2.0 * reach / square));
  scratch.taken.assign(side * side / 64 + 1, 0);
  for (const LinePoint& point : points) {
    if (!point.point.allFinite() || !(point.sigma_on_floor > 0.0 && point.sigma_on_floor <= options.largest_sigma)) {
      continue;
    }
    scratch.points.push_back({point.point.x(), point.point.y(), point.sigma_on_floor});
    if (point.point.norm() >= reach) continue;
    const auto column = static_cast<std::size_t>((point.point.x() + reach) / square);
    const auto row = static_cast<std::size_t>((point.point.y() + reach) / square);
    const std::size_t cell = row * side + column;
    const std::uint64_t bit = std::uint64_t{1} << (cell % 64);
    if ((scratch.taken[cell / 64] & bit) != 0) continue;
    scratch.taken[cell / 64] |= bit;
    scratch.thinned.push_back(scratch.points.back());
  }
  keep_evenly(scratch.thinned);
}

// Within which distance from a line's middle a point may lie on the line.
double tolerance(const LineSample& point, const Field& field) {
  return 0.5 * field.line + 2.0 * point.sigma;
}

double support(const std::vector<LineSample>& points, const FieldMap& map, const Pose2& pose) {
  double sum = 0.0;
  for (const LineSample& point : points) {
    const double limit = tolerance(point, map.field);
    const double distance = map.lines.offset(pose * Eigen::Vector2d(point.x, point.y)).distance;
    sum += limit * limit / (limit * limit + distance * distance);
  }
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

void measure_quality(const FieldMap& map, const Pose2& pose, LineMatchScratch& scratch, LineFit& fit) {
  const double width = map.field.line * map.field.line / 12.0;
  scratch.sizes.clear();
  scratch.spreads.clear();
  double within_15cm = 0.0, within_5cm = 0.0, within_limit = 0.0, by_chance = 0.0;
  for (const LineSample& point : scratch.points) {
    const double distance = std::abs(map.lines.offset(pose * Eigen::Vector2d(point.x, point.y)).distance);
    const double limit = tolerance(point, map.field);
    scratch.sizes.push_back(distance);
    scratch.spreads.push_back(distance / std::sqrt(point.sigma * point.sigma + width));
    if (distance < 0.15) ++within_15cm;
    if (distance < 0.05) ++within_5cm;
    if (distance < limit) ++within_limit;
    by_chance += map.lines.share_within(limit);
  }
  const auto count = static_cast<double>(scratch.points.size());
  fit.median = median_in_place(scratch.sizes);
  fit.spread = kNormalMedian * median_in_place(scratch.spreads);
  fit.points = static_cast<int>(scratch.points.size());
  fit.within_15cm = within_15cm / count;
  fit.within_5cm = within_5cm / count;
  // Where every place of the field is within the limit, points tell nothing.
  fit.on_lines = within_limit > by_chance ? (within_limit - by_chance) / (count - by_chance) : 0.0;
  fit.support = support(scratch.thinned, map, pose);
}

// The pose of least error from `start`, and everything that is told of it.
void finish(std::size_t offered, const FieldMap& map, const Pose2& start, const LineMatchOptions& options,
            LineMatchScratch& scratch, LineFit& fit) {
  const Pose2 pose = settle(scratch.points, map.lines, start, scratch.sizes);
  measure_quality(map, pose, scratch, fit);
  fit.fix.world_from_robot = pose;
  fit.fix.symmetric = true;
  const double f = excess_spread(scratch.points, map.lines, pose, scratch.sizes);
  const auto used = static_cast<double>(scratch.points.size());
  const bool explained = fit.on_lines >= 1.0 - options.outliers && fit.spread <= options.worst_spread &&
                         used >= (1.0 - options.most_left_out) * static_cast<double>(offered);
  if (!explained) {
    fit.fix.status = FixStatus::bad_fit;
  } else if (!line_covariance(scratch.points, map.lines, pose, f, fit.fix.covariance)) {
    fit.fix.status = FixStatus::no_landmark;
  } else {
    fit.fix.covariance *= std::max(1.0, used / options.independent);
    fit.fix.status = FixStatus::ok;
  }
}

// Whether there is anything to match.
bool prepare(const std::vector<LinePoint>& points, const FieldMap& map, const LineMatchOptions& options,
             LineMatchScratch& scratch, LineFit& fit) {
  fit.fix.status = map.lines.empty() ? FixStatus::no_field : FixStatus::no_landmark;
  if (map.lines.empty()) return false;
  take_points(points, map, options, scratch);
  fit.points = static_cast<int>(scratch.points.size());
  return static_cast<int>(scratch.thinned.size()) >= options.fewest_points;
}

}  // namespace

LineFit match_lines(const std::vector<LinePoint>& points, const FieldMap& map, const Pose2& guess,
                    const LineMatchOptions& options, LineMatchScratch& scratch) {
  LineFit fit;
  if (prepare(points, map, options, scratch, fit)) finish(points.size(), map, guess, options, scratch, fit);
  return fit;
}

LineFit find_by_lines(const std::vector<LinePoint>& points, const FieldMap& map, const LineMatchOptions& options,
                      LineMatchScratch& scratch) {
  LineFit fit;
  if (!prepare(points, map, options, scratch, fit)) return fit;
  PlaceList places = search_places(scratch.thinned, map, scratch.scores);
  double best = -1.0;
  Pose2 start;
  for (int i = 0; i < places.count; ++i) {
    Place& place = places.place[i];
    place.pose = settle(scratch.thinned, map.lines, place.pose, scratch.sizes);
    place.support = support(scratch.thinned, map, place.pose);
    if (place.support > best) {
      best = place.support;
      start = place.pose;
    }
  }
  if (start.y > 0.0) start = half_turned(start);
  finish(points.size(), map, start, options, scratch, fit);
  const Pose2& pose = fit.fix.world_from_robot;
  for (int i = 0; i < places.count; ++i) {
    const Place& place = places.place[i];
    if (place.support <= fit.runner_up || near(place.pose, pose) || near(half_turned(place.pose), pose)) continue;
    fit.runner_up = place.support;
    fit.other = place.pose;
  }
  if (fit.fix.status == FixStatus::ok && fit.runner_up > fit.support - options.distinct)
    fit.fix.status = FixStatus::ambiguous;
  return fit;
}

}  // namespace movis::localization
