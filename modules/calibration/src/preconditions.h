#pragma once

#include <vector>

#include "terms.h"

// What must hold before a calibration is worth trying. Everything here throws an Error that says what to do.
namespace movis::calibration {

constexpr int kFewestFrames = 8;

void check_rigs(const omni::Rig& nominal, const Sightings& sightings, const RigOptions& options);

// A calibration holds where there were data: all azimuths within a sector of 60° are refused.
void check_directions(std::vector<double> azimuths, const char* what);

// Compares what the sightings say with the cameras in every order: an Error where another order fits far better.
void check_camera_order_by_places(const Drawing& drawing, const Sightings& sightings);
void check_camera_order_by_balls(const Drawing& drawing, const Sightings& sightings);  // at unknown places

}  // namespace movis::calibration
