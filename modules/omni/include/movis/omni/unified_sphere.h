#pragma once

#include <Eigen/Core>
#include <optional>

namespace movis::omni {

struct Projection;

// The unified sphere model of central catadioptric cameras with lens distortion.
// Source: J. P. Barreto, H. Araujo, ICCV 2001; C. Mei, P. Rives, ICRA 2007 (equations 1–5); the parameters are those
// of cv::omnidir. For a unit ray s in the camera frame, with the mirror's axis up and the image centre looking down:
//   m  = (s_x, s_y) / (ξ − s_z)
//   ρ² = m_x² + m_y²,  k = 1 + k1 ρ² + k2 ρ⁴
//   m' = k m + (2 p1 m_x m_y + p2 (ρ² + 2 m_x²),  p1 (ρ² + 2 m_y²) + 2 p2 m_x m_y)
//   (u, v) = (fu (m'_x + skew m'_y) + u0,  fv m'_y + v0)
// A calibration with the optical axis as +z, as OpenCV's, has s_z with the other sign.
// Domain: s_z < min(ξ, 1/ξ) (an image point per ray), up to `max_elevation` where it is given, and a distortion that
// is still growing outwards.
struct UnifiedSphere {
  double xi = 1.0;
  double fu = 0.0, fv = 0.0, u0 = 0.0, v0 = 0.0;  // pixels
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0;
  double skew = 0.0;
  double max_elevation = 1.5707963267948966;  // radians above the horizontal plane of the camera
};

std::optional<Projection> project_with_jacobian(const UnifiedSphere& model, const Eigen::Vector3d& ray_in_camera);
std::optional<Eigen::Vector3d> unproject(const UnifiedSphere& model, const Eigen::Vector2d& pixel);

}  // namespace movis::omni
