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
  for (std::size_t camera = 0; camera < images.frames.size(); ++camera) {
    const grab::Frame& frame = images.frames[camera];
    if (frame.lost()) continue;
    pipeline.scanners[camera].scan(frame.view, frame.time_s, estimate.bearings);
  }
}

// Two cameras above each other, or in one place, have no parallax in azimuth.
void require_baseline(const omni::Rig& rig) {
  constexpr double kShortest = 0.01;  // metres
  for (const omni::Camera& one : rig.cameras) {
    for (const omni::Camera& two : rig.cameras) {
      if ((one.position - two.position).head<2>().norm() >= kShortest) return;
    }
  }
  throw Error(
      "triangulation needs two cameras that stand at least {} m apart on the floor plane; check `position` of "
      "the rig's cameras",
      kShortest);
}

}  // namespace

Pipeline::Pipeline(omni::Rig rig_used, std::optional<Field> field_used, const scan::Colours& colours,
                   const Options& options_used, localization::Localizer localizer_used)
    : rig(std::move(rig_used)), field(field_used), options(options_used), localizer(localizer_used) {
  if (rig.cameras.size() < 2) {
    throw Error("triangulation needs a rig of two or more cameras; this one has {}", rig.cameras.size());
  }
  require_baseline(rig);
  if (localizer == nullptr) throw Error("the pipeline needs a localizer; there is none of that name");
  if (field && field->goals == Field::Goals::white) {
    throw Error("the field's goals are white; the localizers need a yellow and a blue one");
  }
  scanners.reserve(rig.cameras.size());
  for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
    scanners.emplace_back(rig, camera, colours, options.scan);
  }
  estimate.bearings.reserve(rig.cameras.size() * kObjectClasses);
}

const Estimate& step(Pipeline& pipeline, const grab::FrameSet& images) {
  if (images.frames.size() != pipeline.rig.cameras.size()) {
    throw Error("a set of {} images came to a rig of {} cameras", images.frames.size(), pipeline.rig.cameras.size());
  }
  const auto start = Clock::now();
  const auto& rig = pipeline.rig;
  const auto& pairs = pipeline.options.triangulation;
  Estimate& estimate = pipeline.estimate;
  estimate.index = images.index;
  estimate.time_s = images.time_s;

  scan_images(pipeline, images);
  estimate.ball_in_robot = triangulation::triangulate_pairs(rig, estimate.bearings, ObjectClass::ball, pairs);
  estimate.goals.yellow =
      triangulation::triangulate_goal_pairs(rig, estimate.bearings, ObjectClass::yellow_goal, pairs);
  estimate.goals.blue = triangulation::triangulate_goal_pairs(rig, estimate.bearings, ObjectClass::blue_goal, pairs);
  estimate.fix = pipeline.field ? pipeline.localizer(estimate.goals, *pipeline.field) : Fix{};

  estimate.tick_us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  return estimate;
}

}  // namespace movis::pipeline
