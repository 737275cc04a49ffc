#pragma once

#include <string>
#include <vector>

#include "movis/calibration/rig_calibration.h"

namespace movis::app {

// What became of every parameter of every camera, for people.
std::string rig_table(const calibration::RigCalibration& result);

// The same as comments of the rig file, a line for each camera.
std::vector<std::string> rig_comments(const calibration::RigCalibration& result);

}  // namespace movis::app
