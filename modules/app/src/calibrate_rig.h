#pragma once

#include <filesystem>
#include <optional>

namespace movis::app {

struct CalibrateRigArguments {
  std::filesystem::path data;
  std::filesystem::path out;
  std::optional<std::filesystem::path> rig, field, colours, options;
  std::optional<double> place_sigma;  // metres; goes before the options'
  bool self = false;                  // even where truth.csv knows the balls' places
};

// `movis calibrate rig`: the individual differences of a rig's cameras, from balls at the known places of the data
// set's truth.csv, or from balls at unknown places and the goals. A rig.yaml with them, and a table to standard output.
// Throws an Error, and then leaves no file behind.
void calibrate_rig(const CalibrateRigArguments& arguments);

}  // namespace movis::app
