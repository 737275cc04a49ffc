#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/field.h"
#include "movis/core/line_point.h"
#include "movis/core/obstacle.h"
#include "movis/core/status.h"
#include "movis/grab/image_source.h"
#include "movis/localization/localizer.h"
#include "movis/omni/rig.h"
#include "movis/scan/scanner.h"
#include "movis/triangulation/correction.h"
#include "movis/triangulation/goal_points.h"
#include "movis/triangulation/triangulator.h"
#include "movis/world/world.h"

// The one data path:  images → scan → bearings → triangulation → points in the robot frame → localization → fix.
namespace movis::pipeline {

struct Options {
  scan::ScanOptions scan;
  triangulation::Options triangulation;
  localization::Options localization;
  world::WorldOptions world;
};

// Reads options.yaml strictly: the maps `scan`, `triangulation`, `localization` and `world`, each optional; what is left out keeps its
// default.
Options read_options(const std::filesystem::path& file);

// What one instant tells. The vectors are reused from tick to tick.
struct Estimate {
  std::int64_t index = 0;
  double time_s = 0.0;
  std::vector<Bearing> bearings;
  std::vector<LinePoint> lines;
  std::vector<Obstacle> obstacles;
  PointEstimate ball_in_robot;
  triangulation::GoalLandmarks goals;  // robot frame
  Fix fix;
  double tick_us = 0.0;  // from the first pixel to the fix
};

// Everything that step() needs, made once. Changing the localizer or the triangulator is changing function pointers.
struct Pipeline {
  Pipeline(omni::Rig rig, std::optional<Field> field, const scan::Colours& colours, const Options& options,
           const localization::Localizer& localizer,
           const triangulation::Triangulator& triangulator =
               triangulation::find_triangulator(triangulation::kDefaultTriangulator));

  omni::Rig rig;
  std::optional<localization::FieldMap> map;  // of the field; without one no pose is sought
  Options options;
  localization::Localizer localizer;
  triangulation::Triangulator triangulator;
  triangulation::Correction correction;  // of the bearings that the scan finds; without cameras: none
  std::vector<scan::Scanner> scanners;   // one a camera
  std::vector<ObstacleSight> sights;     // of the last step, of all cameras
  Estimate estimate;                     // of the last step
};

// One tick. Allocates nothing after the first. The result is pipeline.estimate.
const Estimate& step(Pipeline& pipeline, const grab::FrameSet& images);

}  // namespace movis::pipeline
