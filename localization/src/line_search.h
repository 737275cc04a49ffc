#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "movis/core/pose.h"
#include "movis/localization/line_match.h"

namespace movis::localization {

inline constexpr int kMostThinned = 200;  // points that the search takes

// A place that the search found.
struct Place {
  Pose2 pose;
  double support = 0.0;
  int score = 0;  // smaller is better
};

struct PlaceList {
  static constexpr int kMost = 48;
  std::array<Place, kMost> place;
  int count = 0;
};

// The best places that differ, of one half of the field and its surroundings (the other follows by the half turn).
// At most kMostThinned points, within the reach of LineMap::Costs. `scores` is scratch.
PlaceList search_places(const std::vector<LineMatchScratch::Point>& points, const FieldMap& map,
                        std::vector<std::uint16_t>& scores);

}  // namespace movis::localization
