#pragma once

#include <Eigen/Core>
#include <optional>

namespace movis::omni {

struct Projection;

// A pinhole camera looking up at a hyperboloidal mirror.
//   mirror    (z + c)²/a² − r²/b² = 1,  c² = a² + b²,  the sheet around the viewpoint; r² = x² + y²
//   viewpoint the mirror's inner focus, the origin;  camera at the other focus (0, 0, −2c)
// In polar form around its focus the sheet is ρ = (b²/a)/(1 − (c/a) s_z) for a unit ray s, so that the mirrored point
// ρ s is seen at
//   (u, v) = (u0 + fu b² s_x / D,  v0 + fv b² s_y / D),   D = 2ac − (a² + c²) s_z
// which is the unified sphere with ξ = 2ac/(a² + c²) and focal length f b²/(a² + c²).
// Source: S. Baker, S. K. Nayar, IJCV 35(2), 1999; derived by hand from the mirror's equation.
// Domain: the ray meets the mirror within its rim, ρ √(s_x² + s_y²) ≤ rim_radius, with s_z < a/c.
struct Hyperboloid {
  double a = 0.0, b = 0.0;                        // metres
  double rim_radius = 0.0;                        // metres
  double fu = 0.0, fv = 0.0, u0 = 0.0, v0 = 0.0;  // of the pinhole, pixels
};

std::optional<Projection> project_with_jacobian(const Hyperboloid& model, const Eigen::Vector3d& ray_in_camera);
std::optional<Eigen::Vector3d> unproject(const Hyperboloid& model, const Eigen::Vector2d& pixel);

}  // namespace movis::omni
