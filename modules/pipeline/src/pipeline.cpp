#include "movis/pipeline/pipeline.h"

#include <chrono>
#include <utility>

#include "movis/core/error.h"

namespace movis::pipeline {
namespace {

using Clock = std::chrono::steady_clock;

void scan_images(Pipeline& pipeline, const grab::FrameSet& images) {
  Estimate& estimate = pipeline.estimate;
  estimate.bearings.clear();
  estimate.lines.clear();
  pipeline.sights.clear();
  for (std::size_t camera = 0; camera < images.frames.size(); ++camera) {
    const grab::Frame& frame = images.frames[camera];
    if (frame.lost()) continue;
    pipeline.scanners[camera].scan(frame.view, frame.time_s, estimate.bearings);
    pipeline.scanners[camera].scan_floor(frame.view, estimate.lines, pipeline.sights);
  }
}

}  // namespace

Pipeline::Pipeline(omni::Rig rig_used, std::optional<Field> field_used, const scan::Colours& colours,
                   const Options& options_used, const localization::Localizer& localizer_used,
                   const triangulation::Triangulator& triangulator_used)
    : rig(std::move(rig_used)), options(options_used), localizer(localizer_used), triangulator(triangulator_used) {
  triangulator.require(rig);
  if (field_used) {
    if (localizer.require != nullptr) localizer.require(*field_used);
    map.emplace(*field_used);
  }
  scanners.reserve(rig.cameras.size());
  for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
    scanners.emplace_back(rig, camera, colours, options.scan, map ? map->field.line : 0.0);
  }
  estimate.lines.reserve(rig.cameras.size() * options.scan.floor.most_line_points);
  estimate.obstacles.reserve(triangulation::kMostObstacles);
  sights.reserve(rig.cameras.size() * scan::kMostSights);
  estimate.bearings.reserve(rig.cameras.size() * kObjectClasses);
}

const Estimate& step(Pipeline& pipeline, const grab::FrameSet& images) {
  if (images.frames.size() != pipeline.rig.cameras.size()) {
    throw Error("a set of {} images came to a rig of {} cameras", images.frames.size(), pipeline.rig.cameras.size());
  }
  const auto start = Clock::now();
  const auto& rig = pipeline.rig;
  const auto& triangulator = pipeline.triangulator;
  const auto& options = pipeline.options.triangulation;
  Estimate& estimate = pipeline.estimate;
  estimate.index = images.index;
  estimate.time_s = images.time_s;

  scan_images(pipeline, images);
  triangulation::hide_covered_edges(pipeline.sights, estimate.bearings);
  triangulation::correct(pipeline.correction, estimate.bearings);
  triangulation::correct(pipeline.correction, estimate.lines);
  triangulation::correct(pipeline.correction, pipeline.sights);
  triangulation::merge_obstacles(rig, pipeline.sights, options.obstacles, estimate.obstacles);
  estimate.ball_in_robot = triangulator.ball(rig, estimate.bearings, options);
  estimate.goals.yellow = triangulator.goal(rig, estimate.bearings, ObjectClass::yellow_goal, options);
  estimate.goals.blue = triangulator.goal(rig, estimate.bearings, ObjectClass::blue_goal, options);
  estimate.fix = Fix{};
  if (pipeline.map) {
    estimate.fix = pipeline.localizer.fix({rig, estimate.bearings, estimate.goals, estimate.lines}, *pipeline.map,
                                          pipeline.options.localization);
  }

  estimate.tick_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  return estimate;
}

}  // namespace movis::pipeline
