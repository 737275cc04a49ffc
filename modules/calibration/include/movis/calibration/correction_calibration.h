#pragma once

#include <vector>

#include "movis/calibration/rig_calibration.h"
#include "movis/calibration/sightings.h"
#include "movis/triangulation/correction.h"

namespace movis::calibration {

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
// will be corrected. What the functions leave beyond the bearings' own covariance is the correction's azimuth_sigma and
// elevation_sigma.
//
// Sightings that contradict the rest are left out and named. Throws an Error where
// - a camera sees fewer than 12 balls, none in a sector of 150° or all at nearly one distance (2:1);
// - a camera's images are those of another camera;
// - more than a third of the frames, or of one camera's sightings, contradict the rest.
CorrectionFit fit_correction(const Sightings& sightings);

}  // namespace movis::calibration
