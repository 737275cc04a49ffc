#include "line_search.h"

#include <algorithm>
#include <cmath>

namespace movis::localization {
namespace {

constexpr int kHeadings = 120;
static_assert(kMostThinned * 255 <= 65535, "the scores have 16 bits");

// The positions of the lattice: a step apart, from kBeyond steps outside the field's lower left corner on.
struct Positions {
  int columns, rows;
  double left, bottom, step;

  explicit Positions(const FieldMap& map) : step(map.lines.costs().step) {
    left = -map.field.half_width - LineMap::kBeyond * step;
    bottom = -map.field.half_length - LineMap::kBeyond * step;
    columns = static_cast<int>(std::floor(-2.0 * left / step)) + 1;
    rows = static_cast<int>(std::ceil(-bottom / step)) + 1;  // up to y = 0
  }
};

// Adds one row of costs. Apart, so that the compiler sees that nothing overlaps.
void add(std::uint16_t* __restrict scores, const std::uint8_t* __restrict costs, int count) {
  for (int i = 0; i < count; ++i) scores[i] = static_cast<std::uint16_t>(scores[i] + costs[i]);
}

void score_heading(const std::vector<LineMatchScratch::Point>& points, double beta, const LineMap::Costs& costs,
                   const Positions& positions, std::vector<std::uint16_t>& scores) {
  std::fill(scores.begin(), scores.end(), std::uint16_t{0});
  const double cosine = std::cos(beta);
  const double sine = std::sin(beta);
  const double per_metre = 2.0 / costs.step;
  for (const LineMatchScratch::Point& point : points) {
    const double x = positions.left + cosine * point.x - sine * point.y;
    const double y = positions.bottom + sine * point.x + cosine * point.y;
    const int column = static_cast<int>((x - costs.left) * per_metre);
    const int row = static_cast<int>((y - costs.bottom) * per_metre);
    for (int k = 0; k < positions.rows; ++k)
      add(scores.data() + k * positions.columns, costs.row(row + 2 * k, column), positions.columns);
  }
}

bool close(const Place& a, const Place& b, double step) {
  return std::hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y) < 2.5 * step &&
         std::abs(turn(a.pose.beta, b.pose.beta)) < 3.5 * (2.0 * kPi / kHeadings);
}

// Keeps the list sorted, best first, and its places apart from each other.
void insert(PlaceList& list, const Place& place, double step) {
  const auto begin = list.place.begin();
  auto end = begin + list.count;
  for (auto other = begin; other != end; ++other)
    if (other->score <= place.score && close(*other, place, step)) return;
  end = std::remove_if(begin, end, [&](const Place& other) { return close(other, place, step); });
  if (end == list.place.end()) --end;
  auto at = end;
  for (; at != begin && (at - 1)->score > place.score; --at) *at = *(at - 1);
  *at = place;
  list.count = static_cast<int>(end - begin) + 1;
}

// The heading's positions that are better than their neighbours.
void collect(const std::vector<std::uint16_t>& scores, const Positions& positions, double beta, PlaceList& list) {
  for (int row = 0; row < positions.rows; ++row) {
    for (int column = 0; column < positions.columns; ++column) {
      const std::uint16_t* score = scores.data() + row * positions.columns + column;
      if (list.count == PlaceList::kMost && *score >= list.place[PlaceList::kMost - 1].score) continue;
      if ((column > 0 && score[-1] < *score) || (column + 1 < positions.columns && score[1] < *score)) continue;
      if ((row > 0 && score[-positions.columns] < *score) ||
          (row + 1 < positions.rows && score[positions.columns] < *score)) {
        continue;
      }
      Place place;
      place.pose = {positions.left + column * positions.step, positions.bottom + row * positions.step,
                    wrap_angle(beta)};
      place.score = *score;
      insert(list, place, positions.step);
    }
  }
}

}  // namespace

PlaceList search_places(const std::vector<LineMatchScratch::Point>& points, const FieldMap& map,
                        std::vector<std::uint16_t>& scores) {
  const Positions positions(map);
  scores.resize(static_cast<std::size_t>(positions.columns) * positions.rows);
  PlaceList list;
  for (int heading = 0; heading < kHeadings; ++heading) {
    const double beta = heading * (2.0 * kPi / kHeadings);
    score_heading(points, beta, map.lines.costs(), positions, scores);
    collect(scores, positions, beta, list);
  }
  return list;
}

}  // namespace movis::localization
