#include "movis/triangulation/correction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

constexpr double kSigmaOutside = radians(1.0);  // a unit of tan e
constexpr double kLeastScale = 0.5;             // of a radius: no correction that can be read comes near it

double square(double value) {
  return value * value;
}

double sum(const std::vector<double>& coefficients, const CorrectionBasis& basis) {
  double value = 0.0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) value += coefficients[i] * basis[static_cast<int>(i)];
  return value;
}

// One of the two functions of a camera.
struct Function {
  const std::vector<double>& coefficients;
  CorrectionBasis (*basis)(double azimuth, double elevation);

  double operator()(double azimuth, double elevation) const { return sum(coefficients, basis(azimuth, elevation)); }
  double by_azimuth(double azimuth, double elevation) const {
    return ((*this)(azimuth + kStep, elevation) - (*this)(azimuth - kStep, elevation)) / (2.0 * kStep);
  }
  double by_elevation(double azimuth, double elevation) const {
    return ((*this)(azimuth, elevation + kStep) - (*this)(azimuth, elevation - kStep)) / (2.0 * kStep);
  }

  static constexpr double kStep = 1e-4;  // radians; the functions are smooth over degrees
};

void correct(const CameraCorrection& camera, Bearing& bearing) {
  const Function in_azimuth{camera.azimuth, azimuth_basis};
  const Function in_elevation{camera.elevation, elevation_basis};
  const double azimuth = bearing.azimuth;
  const double elevation = std::clamp(bearing.elevation, camera.min_elevation, camera.max_elevation);
  const double outside = bearing.elevation == elevation ? 0.0 : std::tan(bearing.elevation) - std::tan(elevation);
  const double outside_variance = square(kSigmaOutside * outside);
  const double azimuth_variance = square(camera.azimuth_sigma) + outside_variance;
  const double elevation_variance = square(camera.elevation_sigma) + outside_variance;

  bearing.azimuth = wrap_angle(azimuth + in_azimuth(azimuth, elevation));
  bearing.elevation = std::clamp(bearing.elevation + in_elevation(azimuth, elevation), -0.5 * kPi, 0.5 * kPi);
  bearing.left = wrap_angle(bearing.left + in_azimuth(bearing.left, elevation));
  bearing.right = wrap_angle(bearing.right + in_azimuth(bearing.right, elevation));
  bearing.covariance(0, 0) += azimuth_variance;
  bearing.covariance(1, 1) += elevation_variance;
  bearing.left_variance += azimuth_variance;
  bearing.right_variance += azimuth_variance;
  if (bearing.radius <= 0.0) return;
  // Of the azimuthal extent: it is right for a viewpoint that is off, too, where the elevation's derivative is that of
  // balls at different distances (correction.h).
  const double scale = std::max(kLeastScale, 1.0 + in_azimuth.by_azimuth(azimuth, elevation) -
                                                 std::tan(elevation) * in_elevation(azimuth, elevation));
  bearing.radius *= scale;
  // A function of first harmonics has derivatives as large, and as uncertain, as itself.
  bearing.radius_variance = scale * scale * bearing.radius_variance + square(bearing.radius) * azimuth_variance;
  bearing.radius_covariance *= scale;
}

}  // namespace

std::string lens_digest(const omni::Camera& camera) {
  std::string text = fmt::format("{} {} {}", omni::name(camera.model), camera.width, camera.height);
  const auto add = [&](auto... numbers) { ((text += fmt::format(" {:.9g}", numbers)), ...); };
  if (const auto* h = std::get_if<omni::Hyperboloid>(&camera.model)) {
    add(h->a, h->b, h->rim_radius, h->fu, h->fv, h->u0, h->v0);
  } else {
    const auto& u = std::get<omni::UnifiedSphere>(camera.model);
    add(u.xi, u.fu, u.fv, u.u0, u.v0, u.k1, u.k2, u.p1, u.p2, u.skew, u.max_elevation);
  }
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return fmt::format("{:016x}", hash);
}

CorrectionBasis azimuth_basis(double azimuth, double elevation) {
  const double sec = 1.0 / std::cos(elevation);
  const double tan = std::tan(elevation);
  const double c1 = std::cos(azimuth), s1 = std::sin(azimuth);
  const double c2 = c1 * c1 - s1 * s1, s2 = 2.0 * s1 * c1;  // of 2φ
  CorrectionBasis basis;
  basis << 1.0, sec * c1, sec * s1, tan * c1, tan * s1, sec * c2, sec * s2, tan * c2, tan * s2, 0.0, 0.0;
  return basis;
}

CorrectionBasis elevation_basis(double azimuth, double elevation) {
  const double sin = std::sin(elevation);
  const double c1 = std::cos(azimuth), s1 = std::sin(azimuth);
  const double c2 = c1 * c1 - s1 * s1, s2 = 2.0 * s1 * c1;  // of 2φ
  CorrectionBasis basis;
  basis << 1.0, c1, s1, sin, sin * c1, sin * s1, c2, s2, sin * sin, sin * sin * c1, sin * sin * s1;
  return basis;
}

void correct(const Correction& correction, std::vector<Bearing>& bearings) {
  if (correction.cameras.empty()) return;
  for (Bearing& bearing : bearings) {
    if (bearing.camera < 0 || bearing.camera >= static_cast<int>(correction.cameras.size())) {
      throw Error("a bearing is of camera number {}, the correction has {} cameras", bearing.camera,
                  correction.cameras.size());
    }
    correct(correction.cameras[bearing.camera], bearing);
  }
}

}  // namespace movis::triangulation
