#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "movis/localization/localizer.h"
#include "movis/triangulation/triangulator.h"

namespace movis::app {

struct TrackArguments {
  std::filesystem::path data;
  std::filesystem::path out;
  std::optional<std::filesystem::path> page;
  std::optional<std::filesystem::path> obstacles;  // CSV
  std::optional<std::filesystem::path> rig, field, colours, correction, options;
  std::string triangulation{triangulation::kDefaultTriangulator};
  std::string localizer{localization::kDefaultLocalizer};
};

// `movis track`: every set of a data set through the pipeline; the estimates to a CSV file, a short table to standard
// output, and, if asked for, an HTML page of what was seen and measured. Throws an Error, and then leaves no file
// behind.
void track(const TrackArguments& arguments);

}  // namespace movis::app
