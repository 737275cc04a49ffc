#pragma once

#include <filesystem>
#include <optional>

#include "movis/calibration/correction_calibration.h"

namespace movis::app {

struct CalibrateCorrectionArguments {
  std::filesystem::path data;
  std::filesystem::path out;
  std::optional<std::filesystem::path> rig, colours, options;
  double place_sigma = calibration::CorrectionOptions{}.place_sigma;  // metres
};

// `movis calibrate correction`: the error correction of a rig from a data set of balls at known places, its truth.csv;
// a table of what it does to standard output. Throws an Error, and then leaves no file behind.
void calibrate_correction(const CalibrateCorrectionArguments& arguments);

}  // namespace movis::app
