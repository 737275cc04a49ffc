#pragma once

#include <vector>

#include "movis/calibration/rig_calibration.h"
#include "movis/calibration/sightings.h"
#include "movis/triangulation/correction.h"

namespace movis::calibration {

struct CorrectionOptions {
  // Of a known place, x and y each, metres: how exactly it was measured. 0 lays the errors of places on the functions.
  double place_sigma = 0.0;
};

struct CorrectionFit {
  triangulation::Correction correction;

  // By camera, of the balls that were used, radians: what they were off by before, and what a correction that was
  // fitted to the others leaves of them (cross-validation).
  std::vector<double> azimuth_rms_before, elevation_rms_before;
  std::vector<double> azimuth_rms, elevation_rms;

  std::vector<RejectedSighting> rejected;
};

// Fits the paper's error correction (triangulation/correction.h) to balls at known places, those sightings that have
// `ball_in_robot`: every camera by itself, both angles by themselves, by weighted least squares with as few
// coefficients as ten-fold cross-validation over the frames allows. The balls' centres are to be as high as those that
// will be corrected.
//
// A place's error σ_place moves what a bearing should be, d away along the floor and h above the camera's viewpoint:
//   σ_azimuth = σ_place/d,   σ_elevation = σ_place |h|/(d² + h²)
// Both are added to the bearing's own sigmas, in squares: a place near a camera counts less in azimuth. All cameras of
// a frame share the error of its place; a camera is fitted by itself, so that only the test for contradictions, which
// adds up a frame's cameras, takes for independent what is not, and is somewhat stricter than it says. What the
// functions leave beyond these sigmas is the correction's azimuth_sigma and elevation_sigma.
//
// Sightings that contradict the rest are left out and named. Throws an Error where
// - a camera sees fewer than 12 balls, none in a sector of 150° or all at nearly one distance (2:1);
// - a camera's images are those of another camera;
// - more than a third of the frames, or of one camera's sightings, contradict the rest;
// - a camera would have to be off by more than five sigmas of its individual differences: places or rig are wrong;
// - the fit leaves more than ten times what the bearings' sigmas tell, with 0.02° in azimuth, 0.05° in elevation.
CorrectionFit fit_correction(const Sightings& sightings, const CorrectionOptions& options = {});

}  // namespace movis::calibration
