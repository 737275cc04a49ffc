#pragma once

#include <Eigen/Core>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/omni/rig.h"

namespace movis::triangulation {

// The Cramér–Rao bound: no unbiased estimator has a smaller covariance than the inverse of the Fisher information. For
// Gaussian noise of known covariance Σ on measurements μ(θ) that is
//   J = (∂μ/∂θ)ᵀ Σ⁻¹ (∂μ/∂θ)
// Source: S. M. Kay, Fundamentals of Statistical Signal Processing: Estimation Theory, 1993, sections 3.7 to 3.9.
// docs/bound.md derives what stands here.
//
// Where the measurements do not determine what is asked for, the bound has infinity on its diagonal and zeros beside
// it: it never has a NaN, and bound.allFinite() tells.

// Of an object's position, from bearings of the given covariances of (azimuth, elevation), and of the angular radius
// where radius_variance is above 0. With d = point − viewpoint, r = |d_xy|, D = |d|, sin γ = R/D, a camera's rows are
//   ∂φ/∂p = (−d_y, d_x, 0)/r²,   ∂e/∂p = (−d_x d_z/r, −d_y d_z/r, r)/D²,   ∂γ/∂p = −tan γ d/D²
// and J = Σ Aᵀ Σ⁻¹ A (+ e_z e_zᵀ/floor_sigma²).
//
// One bearing a camera; only its camera and covariances count. `ball_radius` in metres, needed where a radius_variance
// is given. `floor_sigma` ≥ 0: that the object's height is known to that, metres, 0 exactly; negative: it is not.
// Shape: 3×3, m². A bearing with an infinite variance tells nothing, nor does one straight above or below its camera,
// where there is no azimuth. An Error where a camera is not the rig's or a covariance is not positive definite.
Eigen::Matrix3d position_bound(const omni::Rig& rig, const Eigen::Vector3d& point_in_robot,
                               const std::vector<Bearing>& covariances, double ball_radius, double floor_sigma);

// What the bound of a position says of the place on the floor, as seen from the robot's origin.
struct FloorSigma {
  double distance = 0.0;   // metres
  double direction = 0.0;  // radians
  double position = 0.0;   // root of the mean square of the error on the floor plane, metres
};
FloorSigma floor_sigma_of(const Eigen::Matrix3d& finite_bound, const Eigen::Vector3d& point_in_robot);

// What a camera's picture of a ball is like.
struct Picture {
  double contrast = 120.0;  // grey levels between ball and surroundings; three channels: root of the sum of squares
  double noise = 2.0;       // sigma of one channel of one pixel, grey levels
  double blur_px = 0.6;     // sigma of the lens's blur, pixels; a pixel's own square adds 1/12 px² to its square
};

// Of one camera's bearing of a ball: covariance of (azimuth, elevation, angular radius), rad². A uniform ball lies
// before a uniform background; the background's level is known, the ball's is not: it is a nuisance, eliminated. The
// ball's outline is the image of the cone under which a sphere is seen. A piece ds of it, pixels long, tells its
// displacement along its normal with the information
//   C²/(σ² 2√π s) ds,   s² = blur_px² + 1/12
// With n(ψ) the normal displacements by the three angles and n̄ their mean along the outline,
//   J = C²/(σ² 2√π s) ∮ [f₁ (n − n̄)(n − n̄)ᵀ + f₀ n̄ n̄ᵀ] ds
// f₁ and f₀ → 1 for balls much larger than the blur; they are exact for a disc of any size: f₁ because opposite edges
// run into each other, f₀ also because a small ball's size is hard to tell from its brightness. Only the part of the
// outline that lies within mirror and picture counts. Nothing else hides any of it: the robot's body, other cameras and
// masks are not looked at. Infinite where the camera sees nothing of the ball or is within it, and straight above or
// below. An Error where contrast, noise or the radius is not above 0, or blur_px is negative.
Eigen::Matrix3d bearing_bound(const omni::Camera& camera, const Eigen::Vector3d& ball_in_robot, double ball_radius,
                              const Picture& picture);

}  // namespace movis::triangulation
