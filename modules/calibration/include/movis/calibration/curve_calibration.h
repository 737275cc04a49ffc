#pragma once

#include <Eigen/Core>
#include <vector>

#include "movis/core/pose.h"
#include "movis/localization/line_match.h"
#include "movis/omni/rig.h"

namespace movis::calibration {

// The curve r = a tan(b ρ) of a `radial` camera and its image centre (u0, v0), from the white-line pixels of one picture
// taken anywhere on a known field: with the robot's unknown pose, the seven numbers that minimize
//   Σ (c_i²/σ_i²) d_i²/(c_i² + d_i²) + (Δa/σ_a)² + (Δb/σ_b)² + (Δu0² + Δv0²)/σ_c²,   c_i² = s² + (3 f σ_i)²
// d_i being the distance from the nearest line's middle, σ_i and f as in line_match.h and line_pixel.h, Δ what is changed
// of the start. s falls from 0.5 m to 0, so that the lines that a wrong curve bends find their own. The start's pose is
// that of find_by_lines; a start that explains the pixels badly will do if it finds the right place.
struct CurveOptions {
  double sigma_a = 0.2, sigma_b = 0.2;  // relative
  double sigma_centre_px = 10.0;
  double most_sigmas = 3.0;  // by more of its σ no parameter may change
};

struct CurveCalibration {
  omni::Camera camera;
  Pose2 world_from_robot;
  int pixels = 0;                // that were used
  localization::LineFit before;  // of the start
  localization::LineFit after;
};

// Throws an Error where the camera's model is not radial, and where the best curve is not to be believed (too few pixels,
// another field, or a start too far off): its status is not ok, a parameter changes by more than `most_sigmas` of its σ,
// or the median distance exceeds √((w/2)² + (p/1.4826)²), w being the line's width and p the median of what a pixel is
// on the floor: more than what fills lines, seen to a pixel, leaves.
CurveCalibration calibrate_curve(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& start,
                                 const localization::FieldMap& map, const CurveOptions& options = {});

// The median distance of pixels on the floor from the nearest line's middle, metres; those that line_match.h leaves out
// of a match left out.
double median_distance(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& camera, const Pose2& pose,
                       const localization::FieldMap& map);

}  // namespace movis::calibration
