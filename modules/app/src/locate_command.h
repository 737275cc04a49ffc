#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace movis::app {

struct LocateArguments {
  std::filesystem::path points, rig, field;
  std::vector<double> guess;          // x, y (metres), beta (degrees); or empty
  std::optional<std::string> camera;  // its name; needed where the rig has several
};

// `movis locate`: the pose from the white-line pixels of one picture, as lines of a name and a value to standard output.
// A status other than ok is an answer too; a file that cannot be used throws an Error.
void locate(const LocateArguments& arguments);

}  // namespace movis::app
