#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

namespace movis::omni {

struct Projection;

// A mirror that is known by what it shows of the floor, as teams of robot soccer calibrate theirs: from markings on the
// floor at known distances r (metres, from the point under the viewpoint) and their distances ρ (pixels) from the
// image's centre,
//   r = a tan(b ρ)
// Seen from the viewpoint at the height h above the floor this is a central camera, with φ the angle from straight down
// and α the azimuth of both the ray and the pixel:
//   tan φ = r/h = (a/h) tan(b ρ),   (u, v) = (u0 + ρ cos α, v0 + ρ sin α)
// `height` is the h for which a was measured: a/h belongs to the mirror, and stays when the camera is moved.
// Source: the calibration files of the NuBot team's robots (github.com/nubot-nudt/nubot_ws, omni_vision); inverse and
// Jacobian derived by hand.
// Domain: rays below the horizon, φ < 90°, so b ρ < π/2; ρ ≤ max_radius_px. The camera is upright while a is measured.
struct Radial {
  double a = 0.0;       // metres
  double b = 0.0;       // radians per pixel
  double height = 0.0;  // metres
  double u0 = 0.0, v0 = 0.0;
  double max_radius_px = std::numeric_limits<double>::infinity();
};

std::optional<Projection> project_with_jacobian(const Radial& model, const Eigen::Vector3d& ray_in_camera);
std::optional<Eigen::Vector3d> unproject(const Radial& model, const Eigen::Vector2d& pixel);

}  // namespace movis::omni
