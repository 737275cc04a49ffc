#pragma once

#include <Eigen/Core>
#include <vector>

#include "movis/calibration/rig_calibration.h"
#include "movis/calibration/sightings.h"
#include "smooth_fit.h"

namespace movis::calibration {

// A ball at a known place, seen by one camera: what its bearing would have to be corrected by.
struct CorrectionPoint {
  int frame = 0;  // index into the sightings
  int camera = 0;
  double azimuth = 0.0, elevation = 0.0;  // measured
  SmoothSample in_azimuth, in_elevation;
  double azimuth_of_place = 0.0, elevation_of_place = 0.0;  // sigmas, radians: the part of the place's error
};

// Of every bearing of a ball at a known place. Those that the own body, the picture's border or another object cut are
// left out; those near another sensor unit count with three times their standard deviation. `place_sigma`, metres, is
// added to the variances.
std::vector<CorrectionPoint> correction_points(const Sightings& sightings, double place_sigma);

// Throws an Error where a camera's azimuths are those of another camera.
void refuse_swapped_cameras(const Sightings& sightings, const std::vector<CorrectionPoint>& points);

// Takes out what contradicts the rest, whole frames where two cameras or more do or all that see the ball, and names
// it. It starts from the fit to a few frames that leaves the least median over all frames (P. J. Rousseeuw, JASA 79,
// 1984), drawn at random but always the same. Throws an Error where more than a third of the frames, or of one camera's
// points, contradict the rest.
std::vector<RejectedSighting> reject_outliers(const Sightings& sightings, std::vector<CorrectionPoint>& points);

}  // namespace movis::calibration
