#pragma once

#include <vector>

#include "terms.h"

// From the adjustment to what is reported.
namespace movis::calibration {

RigUnknowns add_rig_unknowns(Adjustment& adjustment, std::size_t cameras);

// Whether all of a frame's ball, or all of its goals, was left out.
struct FrameVerdicts {
  std::vector<bool> ball, goals;  // by frame
};

// Leaves out what contradicts the rest and solves again without it, until nothing changes. A ball that two cameras
// contradict is left out as a whole, and so is a frame's goals when most of their edges are wrong.
FrameVerdicts solve_without_outliers(Adjustment& adjustment, std::size_t frames);

// A camera that contradicts the others in more than a third of its sightings, those frames that are wrong as a whole
// not counted; the worst first.
struct CameraVerdict {
  int camera = 0;
  std::size_t sightings = 0;
  std::vector<std::int64_t> left_out;  // frames, one for each sighting
};

std::vector<CameraVerdict> contradicting_cameras(const Adjustment& adjustment, const FrameVerdicts& verdicts,
                                                 const Sightings& sightings);
[[noreturn]] void throw_contradiction(const CameraVerdict& verdict, const omni::Rig& nominal);

// Rig, deviations, sigmas, residuals. Throws an Error where a deviation is beyond belief.
RigCalibration outcome(const Adjustment& adjustment, const RigUnknowns& unknowns, const omni::Rig& nominal,
                       const RigOptions& options);

// "3, 7, 12 and 4 more", of frames
std::string listed(const std::vector<std::int64_t>& frames);

}  // namespace movis::calibration
