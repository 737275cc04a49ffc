#include "movis/triangulation/correction.h"

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

constexpr double kSigmaOutside = radians(1.0);  // a unit of tan e

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
  bearing.elevation += in_elevation(azimuth, elevation);
  bearing.left = wrap_angle(bearing.left + in_azimuth(bearing.left, elevation));
  bearing.right = wrap_angle(bearing.right + in_azimuth(bearing.right, elevation));
  bearing.covariance(0, 0) += azimuth_variance;
  bearing.covariance(1, 1) += elevation_variance;
  bearing.left_variance += azimuth_variance;
  bearing.right_variance += azimuth_variance;
  if (bearing.radius <= 0.0) return;
  const double scale =
      1.0 + 0.5 * (in_azimuth.by_azimuth(azimuth, elevation) + in_elevation.by_elevation(azimuth, elevation));
  bearing.radius *= scale;
  bearing.radius_variance *= scale * scale;
  bearing.radius_covariance *= scale;
}

}  // namespace

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
