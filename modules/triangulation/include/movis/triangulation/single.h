#pragma once

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"

namespace movis::triangulation {

// One camera and a ball on the floor: what every single omnidirectional camera does. The viewpoint is h above the
// floor, the ball's radius R is known, its centre is seen at the elevation e and its cone has half the opening γ.
//
//   by elevation  the ray to the centre meets the plane z = R:             ρ = (h − R) / tan(−e)
//   by contact    the cone's lowest ray, δ = −(e − γ) below the horizon, touches the ball close to where it stands. A
//                 line from (0, h) has the distance R from the centre (ρ, R) where ρ sin δ − (h − R) cos δ = R:
//                                                      ρ = (R + (h − R) cos δ)/sin δ = h/tan δ + R tan(δ/2)
// The point is c + ρ (cos φ, sin φ) at z = R. An error of the angle costs ∂ρ/∂e = (h − R)/sin² e there and
// ∂ρ/∂δ = −h/sin² δ + R/(2 cos²(δ/2)) here: far away ρ²/(h − R) and ρ²/h a radian, so the contact is the better of the
// two by h/(h − R), 1.8 for cameras 25 cm high, as long as γ is measured as well as e.
// Source: geometry, derived by hand. Covariance to first order from that of the bearing; the height is taken as known,
// so its row is zero. Valid for a viewpoint higher than the ball's centre.
//
// Statuses: parallel_rays where the ray lies less than min_depression below the horizon; one_camera where the contact
// is asked for and the bearing has no angular radius.
struct SingleOptions {
  double ball_radius = 0.11;        // metres
  double min_depression_deg = 0.2;  // 40 m for a viewpoint 14 cm above the ball's centre
};

SingleOptions read_single_options(const YamlMap& map);

// Throws an Error where the viewpoint is not above the ball's centre.
PointEstimate range_by_elevation(const omni::Camera& camera, const Bearing& bearing, const SingleOptions& options = {});
PointEstimate range_by_contact(const omni::Camera& camera, const Bearing& bearing, const SingleOptions& options = {});

}  // namespace movis::triangulation
