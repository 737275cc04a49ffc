#pragma once

#include <filesystem>
#include <optional>

#include "movis/triangulation/bound_map.h"

namespace movis::app {

struct BoundArguments {
  std::filesystem::path rig;
  std::filesystem::path out;
  std::optional<std::filesystem::path> page;
  std::optional<double> height;  // of the ball's centre, metres; nothing: it lies on the floor
  bool free = false;             // the table and the page begin with a height that is not known
  triangulation::BoundMapOptions options;
};

// `movis bound`: how well a rig can measure a ball at best, all over the floor. A CSV file, a short table to standard
// output and, if asked for, an HTML page with maps. Throws an Error, and then leaves no file behind.
void bound(BoundArguments arguments);

}  // namespace movis::app
