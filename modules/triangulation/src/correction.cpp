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

// What a camera's functions are evaluated at, and the variances of what they leave there.
struct Place {
  Place(const CameraCorrection& camera, double azimuth_seen, double elevation_seen)
      : in_azimuth{camera.azimuth, azimuth_basis},
        in_elevation{camera.elevation, elevation_basis},
        azimuth(azimuth_seen),
        elevation(std::clamp(elevation_seen, camera.min_elevation, camera.max_elevation)) {
    const double outside = elevation_seen == elevation ? 0.0 : std::tan(elevation_seen) - std::tan(elevation);
    const double outside_variance = square(kSigmaOutside * outside);
    azimuth_variance = square(camera.azimuth_sigma) + outside_variance;
    elevation_variance = square(camera.elevation_sigma) + outside_variance;
  }

  Function in_azimuth, in_elevation;
  double azimuth, elevation;
  double azimuth_variance, elevation_variance;
};

void correct(const CameraCorrection& camera, Bearing& bearing) {
  const Place place(camera, bearing.azimuth, bearing.elevation);
  const auto& [in_azimuth, in_elevation, azimuth, elevation, azimuth_variance, elevation_variance] = place;

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

// The distance on the floor, from under the viewpoint.
double floor_distance(double height, double elevation) {
  constexpr double kFarthest = 20.0;  // metres
  const double steepness = std::tan(-elevation);
  return steepness * kFarthest > height ? height / steepness : kFarthest;
}

void correct(const CameraCorrection& camera, LinePoint& line) {
  const Place place(camera, line.azimuth, line.elevation);
  line.azimuth = wrap_angle(line.azimuth + place.in_azimuth(place.azimuth, place.elevation));
  line.elevation += place.in_elevation(place.azimuth, place.elevation);
  const double distance = floor_distance(camera.position.z(), line.elevation);
  line.point = camera.position.head<2>() + distance * Eigen::Vector2d(std::cos(line.azimuth), std::sin(line.azimuth));
  const double metres_per_radian = line.sigma_on_floor / line.sigma;
  line.sigma = std::sqrt(square(line.sigma) +
                         std::max(place.azimuth_variance * square(std::cos(line.elevation)), place.elevation_variance));
  line.sigma_on_floor = metres_per_radian * line.sigma;
}

void correct(const CameraCorrection& camera, ObstacleSight& sight) {
  const double height = camera.position.z();
  const double elevation = -std::atan2(height, sight.distance);
  const Place left(camera, sight.left, elevation);
  const Place right(camera, sight.right, elevation);
  const double middle = sight.right + 0.5 * turn(sight.right, sight.left);
  const Place place(camera, middle, elevation);
  sight.left = wrap_angle(sight.left + left.in_azimuth(left.azimuth, left.elevation));
  sight.right = wrap_angle(sight.right + right.in_azimuth(right.azimuth, right.elevation));
  sight.distance = floor_distance(height, elevation + place.in_elevation(place.azimuth, place.elevation));
  const double metres_per_radian = height + square(sight.distance) / height;
  sight.sigma = std::sqrt(square(sight.sigma) + square(metres_per_radian) * place.elevation_variance);
}

// All of one instant, each with its camera's correction.
template <typename Seen>
void correct_all(const Correction& correction, const char* what, std::vector<Seen>& all) {
  if (correction.cameras.empty()) return;
  for (Seen& seen : all) {
    if (seen.camera < 0 || seen.camera >= static_cast<int>(correction.cameras.size())) {
      throw Error("{} is of camera number {}, the correction has {} cameras", what, seen.camera,
                  correction.cameras.size());
    }
    correct(correction.cameras[seen.camera], seen);
  }
}

}  // namespace

std::string lens_digest(const omni::Camera& camera) {
  std::string text = fmt::format("{} {} {}", omni::name(camera.model), camera.width, camera.height);
  const auto add = [&](auto... numbers) { ((text += fmt::format(" {:.9g}", numbers)), ...); };
  if (const auto* h = std::get_if<omni::Hyperboloid>(&camera.model)) {
    add(h->a, h->b, h->rim_radius, h->fu, h->fv, h->u0, h->v0);
  } else if (const auto* r = std::get_if<omni::Radial>(&camera.model)) {
    add(r->a / r->height, r->b, r->u0, r->v0, r->max_radius_px);
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
  correct_all(correction, "a bearing", bearings);
}

void correct(const Correction& correction, std::vector<LinePoint>& lines) {
  correct_all(correction, "a line point", lines);
}

void correct(const Correction& correction, std::vector<ObstacleSight>& sights) {
  correct_all(correction, "a sight of an obstacle", sights);
}

}  // namespace movis::triangulation
