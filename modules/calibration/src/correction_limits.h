#pragma once

#include <string>
#include <vector>

#include "correction_points.h"
#include "movis/calibration/sightings.h"
#include "movis/core/angle.h"
#include "smooth_fit.h"

// What a correction is not for: where the places, or the rig, are not what they are said to be.
namespace movis::calibration {

inline constexpr double kAzimuthFloor = radians(0.02);  // of what functions and bearings leave
inline constexpr double kElevationFloor = radians(0.05);

// The points of one camera, as its nine deviations from the drawing (omni/deviation.h) explain them: linear least
// squares with the individual differences as the prior. Throws an Error where one comes out
// beyond five of its sigmas, and that beyond doubt.
void refuse_beyond_differences(const Sightings& sightings, const std::vector<CorrectionPoint>& points);

// Throws an Error where what the fit leaves is more than ten times what the samples' variances and the floor tell.
void refuse_poor_fit(const std::string& camera, const char* angle, const std::vector<double>& left,
                     const std::vector<SmoothSample>& samples, double floor);

}  // namespace movis::calibration
