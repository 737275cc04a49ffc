#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"
#include "movis/triangulation/goal_points.h"

namespace movis::triangulation {

// All cameras jointly: the maximum likelihood estimate where errors are normal.
//
// Camera k at c_k sees an object at p, o = p − c_k, h = |(o_x, o_y)|, d = |o|, under
//   azimuth    φ_k = atan2(o_y, o_x)                          ∂φ/∂p = (−o_y, o_x, 0)/h²
//   elevation  e_k = atan2(o_z, h) + b_e                      ∂e/∂p = (−o_z o_x/h, −o_z o_y/h, h)/d²
//   radius     γ_k = asin(R/d) + b_γ     (a ball of radius R) ∂γ/∂p = −R/(d² √(d² − R²)) o
// with noise of the bearing's covariance, 3×3 where the radius was measured, else 2×2. Bearings of different cameras
// are independent but for b_e and b_γ, which shading and blur give to all pictures of a ball alike: nuisances of zero
// mean and known sigma, marginalized, so that the point's covariance holds them. A ball that lies on the floor has the
// further measurement z = R ± floor_sigma.
//
// With whitened rows the normal matrix of (p, b) is H; eliminating b leaves S, the information of p, and S⁻¹ is the
// covariance. It starts from the point nearest to all rays, weighted (linear), and takes Gauss–Newton steps until one
// is below 10⁻⁴ sigma. Residuals are taken in the tangent plane of the measured ray, where tan stands for the angle:
// they are exact to third order, and there is no arc function in the loop.
//
// What was measured is tested by χ², with false alarms as rare as a normal variable beyond `test_sigmas`. Readings in
// the order of their simplicity, of which the first that passes is taken:
//   1. all cameras, on the floor: also the floor must agree with the bearings, to `air_sigmas` sigmas of the height
//   2. all cameras, in the air (its centre above the floor plane, that is); or on the floor, without one camera
//   3. in the air, without one camera; or on the floor, without two; and so on
// without one being: without each of them. Readings of one line that pass share the estimate: it is the mean of their
// mixture, weighted by exp(−(χ² − dof)/2), with its covariance, so that a doubt about which camera is wrong shows
// there: χ² is dof on average where a reading is true, and a reading of fewer data must not gain by that. A reading
// that leaves cameras out must have two degrees of freedom left to pass.
//
// If none passes, covariances were too small, or the rig is not the real one. Then the point of all cameras, on the
// floor or else in the air, is taken if its largest residual is below `contradiction_deg`, its covariance multiplied by
// χ²/dof (Birge, Phys. Rev. 40 (1932) 207). Else the status is contradiction.
//
// Valid for rigs of two to eight cameras, in any arrangement: cameras above each other measure by elevation. Where the
// range's sigma is above a third of it the status is parallel_rays; where the solution lies behind a camera,
// behind_camera.
//
// A goal's centre (midway between its edges in each camera), left and right edge are points of the floor plane, by
// azimuths alone. Each of its edges errs by a bias of its own in all cameras alike (edge_bias_deg). It turns the point
// about the rig and hardly shows in the residuals: it counts in the covariance and not in the weights. A camera that
// contradicts the others is left out where there are more than three; with three nothing tells which it is, and the
// covariance is multiplied by χ²/dof, up to `contradiction_deg`.

struct JointOptions {
  double ball_radius = 0.11;         // metres
  bool floor = true;                 // a ball that can lie on the floor does
  bool diameter = true;              // the known diameter tells a distance
  double floor_sigma = 0.003;        // metres: how even the floor is
  double elevation_bias_deg = 0.03;  // one sigma of b_e
  double radius_bias_deg = 0.03;     // one sigma of b_γ
  double edge_bias_deg = 0.07;       // one sigma of what a goal's edge errs by in all cameras alike
  double flagged_factor = 2.0;       // of a flagged bearing's sigmas
  double test_sigmas = 3.7;
  double air_sigmas = 4.0;
  double contradiction_deg = 3.0;
};

// Strict.
JointOptions read_joint_options(const YamlMap& map);

// The object's position in the robot frame from all cameras that see it; floor and diameter are of a ball only. Of two
// bearings of one camera the more certain one counts. A precondition that is broken (a rig of one camera or of more
// than eight, a bearing of a camera that the rig has not) throws.
PointEstimate triangulate_joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                const JointOptions& options = {});

// A goal's centre and edges in the robot frame, each from all cameras that see it.
GoalPoints triangulate_goal_joint(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                                  const JointOptions& options = {});

}  // namespace movis::triangulation
