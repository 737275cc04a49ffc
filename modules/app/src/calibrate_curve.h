#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace movis::app {

struct CalibrateCurveArguments {
  std::filesystem::path points, rig, field, out;
  std::optional<std::string> camera;  // its name; needed where the rig has several
  bool holdout = false;
};

// `movis calibrate curve`: a radial camera's curve and image centre from the white-line pixels of one picture. A
// rig.yaml with them, and median distances from the lines to standard output; with `holdout` also those of every second
// pixel, fitted to the others alone. Throws an Error, and then leaves no file behind.
void calibrate_curve(const CalibrateCurveArguments& arguments);

}  // namespace movis::app
