#pragma once

#include <string>
#include <vector>

#include "movis/calibration/sightings.h"
#include "movis/core/field.h"
#include "movis/core/yaml.h"
#include "movis/omni/deviation.h"

namespace movis::calibration {

// The individual differences of a rig's cameras, estimated from what they saw.
//
// Unknowns are nine deviations a camera from the nominal rig (omni/deviation.h), each with a normal prior. The bearing
// of a ball, turned back into its pixel p by the rig with which it was found, has through the candidate camera k(δ) the
// direction (φ, e) in the robot's axes. With the ball's centre at b and the camera's viewpoint at c(δ)
//   r = Σ^(−1/2) (φ(p, δ) − azimuth(b − c(δ)),  e(p, δ) − elevation(b − c(δ)) − ε)
// Σ is the bearing's covariance with the floors below added; ε is a bias that all balls' elevations share, because
// shading moves a ball's outline. A known place w was measured by somebody: b = w + σ_place (s_x, s_y, 0), where s is a
// nuisance of each frame. Minimized is Σ r² + Σ s² + Σ (δ/σ_prior)² + (ε/σ_ε)², by Levenberg and Marquardt, first under
// Cauchy's loss with a falling scale, so that up to about a third of wrong sightings do no harm, then without those.
// A place is wrong where the bearings have the ball more than five sigmas of place and bearings from it. Bearings that
// the own body or the picture's border cuts are left out.
//
// Bearings depend slightly on the rig with which they were found: calibrate, scan again with the result, and calibrate
// once more around the same nominal rig.
struct RigOptions {
  omni::Deviation prior = omni::individual_differences();  // sigma, around the nominal rig
  double place_sigma = 0.002;        // of a known place, x and y each, metres: how exactly it was measured; 0: exact
  double azimuth_floor_deg = 0.005;  // of a ball's direction, beside the bearing's own covariance
  double elevation_floor_deg = 0.02;
  double elevation_bias_deg = 0.05;  // sigma of what all balls' elevations share
  double edge_floor_deg = 0.03;      // of a goal's edge
  double edge_bias_deg = 0.03;       // sigma of what all goals are seen too wide, on either side
  double ball_radius = 0.11;         // metres; where its place is unknown, the ball lies on the floor
};

// The maps `prior` (position, metres; yaw_deg, tilt_deg; focal, relative; principal_point_px) and the numbers above by
// their names; what is left out keeps its default.
RigOptions read_rig_options(const YamlMap& map);

struct RejectedSighting {
  std::int64_t frame = 0;
  int camera = -1;     // -1: the whole frame
  std::string reason;  // for people
};

struct RigCalibration {
  omni::Rig rig;
  std::vector<omni::Deviation> deviation;  // from the nominal rig, by camera
  std::vector<omni::Deviation> sigma;      // of each parameter: what the data and the prior leave
  std::vector<RejectedSighting> rejected;
  double azimuth_rms = 0.0, elevation_rms = 0.0;  // of the balls' residuals that were used, radians
  double edge_rms = 0.0;                          // of the goals' edges that were used, radians; 0: none
  double place_rms = 0.0;  // by what the known places of used balls were off, x and y each, metres; 0: none
  double elevation_bias = 0.0, elevation_bias_sigma = 0.0;  // how much higher than they are balls appear, radians
  int balls = 0, goals = 0;                                 // frames whose ball, whose goals were used
  omni::Deviation prior;                                    // sigma

  // A parameter whose sigma is hardly less than its prior's stays where the drawing has it.
  static constexpr double kDetermined = 0.7;
  bool determined(int camera, int parameter) const { return sigma[camera][parameter] < kDetermined * prior[parameter]; }
};

// From balls at known places, sightings with `ball_in_robot`. Whatever part of a sighting contradicts the rest is left
// out and named. Throws an Error where
// - fewer than eight different places are seen, or all within a sector of 60°;
// - the images look like those of the cameras in another order;
// - more than a third of the frames contradict the rest;
// - a deviation comes out beyond ten of its prior's sigmas: then places and rig do not belong together.
RigCalibration calibrate_rig(const omni::Rig& nominal, const Sightings& sightings, const RigOptions& options = {});

// From balls at unknown places on the floor and the goals of a known field (goal_silhouette.h), seen from unknown
// poses: bundle adjustment over the rig, each frame's pose (x, y, β) and ball (x, y). An edge's residual is its azimuth
// alone. Planar gauge: turning and shifting the whole rig in the robot frame, with all poses and balls the other way,
// changes no bearing. The priors keep the rig as a whole where the drawing has it; a known pose is needed to tell more.
// Scale comes from the field's size, from the baselines and from the cameras' height above the ball's centre. Errors as
// above, and where fewer than eight frames show a ball to two cameras or goals to two cameras.
RigCalibration self_calibrate_rig(const omni::Rig& nominal, const Sightings& sightings, const Field& field,
                                  const RigOptions& options = {});

}  // namespace movis::calibration
