#include "movis/calibration/correction_calibration.h"

#include <algorithm>
#include <cmath>

#include "correction_limits.h"
#include "correction_points.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/random.h"

namespace movis::calibration {
namespace {

constexpr int kFewest = 12;                    // places a camera
constexpr double kWidestGap = radians(150.0);  // without a ball
constexpr double kLeastSpread = 2.0;           // of the distances, farthest to nearest
constexpr int kFolds = 10;
constexpr int kFreeAzimuth = 5, kFreeElevation = 6;  // what first-order effects need
constexpr double kStartSigma = radians(0.02);

// Which fold each frame belongs to: evenly filled, at random (a lattice's rows must not become folds), always the same.
std::vector<int> folds_of(std::size_t frames) {
  std::vector<int> order(frames);
  for (std::size_t i = 0; i < frames; ++i) order[i] = static_cast<int>(i);
  RandomStream random = make_stream(1, 0x666f6c64U);
  for (std::size_t i = frames; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  std::vector<int> folds(frames);
  for (std::size_t i = 0; i < frames; ++i) folds[order[i]] = static_cast<int>(i) % kFolds;
  return folds;
}

void require_places(const std::string& camera, const std::vector<CorrectionPoint>& points) {
  if (static_cast<int>(points.size()) < kFewest) {
    throw Error("{} has {} balls at known places to be corrected by; it needs {}, and 40 are better", camera,
                points.size(), kFewest);
  }
  std::vector<double> azimuths;
  double nearest = 0.0, farthest = 0.0;  // as |tan| of the elevation, height over distance
  for (const CorrectionPoint& point : points) {
    azimuths.push_back(point.azimuth);
    const double slope = std::abs(std::tan(point.elevation + point.in_elevation.value));  // where it stands
    nearest = std::max(nearest, slope);
    farthest = farthest == 0.0 ? slope : std::min(farthest, slope);
  }
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths.front() + 2.0 * kPi - azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) gap = std::max(gap, azimuths[i] - azimuths[i - 1]);
  if (gap > kWidestGap) {
    throw Error("{} sees no ball in {:.0f}° of its round; place balls in all directions around the robot", camera,
                degrees(gap));
  }
  if (nearest < kLeastSpread * farthest) {
    throw Error(
        "{} sees all balls at nearly one distance, the farthest {:.1f} times as far as the nearest; place them "
        "near and far",
        camera, nearest / std::max(farthest, 1e-9));
  }
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// Where places err, what they scatter hides from the choice of an order that terms are missing, which stay in every
// corrected bearing: then all of the first order are fitted.
template <std::size_t n>
SmoothFit fit_angle(const std::vector<SmoothSample>& samples, const std::array<int, n>& orders, int free,
                    bool exact_places) {
  const auto least = exact_places ? orders.begin() : std::find(orders.begin(), orders.end(), free);
  return fit_smooth_order(samples, {least, orders.end()}, free, kStartSigma);
}

// What is left beyond the samples' variances has the coefficients' errors in it, but is too rough to show them where
// the variances are large.
double sigma_of(const SmoothFit& fit, const std::vector<SmoothSample>& samples, int free) {
  return std::max(fit.sigma, prediction_sigma(samples, static_cast<int>(fit.coefficients.size()), free, fit.sigma));
}

std::vector<double> coefficients_of(const SmoothFit& fit) {
  return {fit.coefficients.data(), fit.coefficients.data() + fit.coefficients.size()};
}

void fit_camera(const omni::Camera& camera, const std::vector<CorrectionPoint>& points, const std::vector<int>& folds,
                bool exact_places, CorrectionFit& result) {
  std::vector<SmoothSample> in_azimuth, in_elevation;
  std::vector<double> azimuth_before, elevation_before;
  triangulation::CameraCorrection correction;
  correction.min_elevation = points.front().elevation;
  correction.max_elevation = points.front().elevation;
  for (const CorrectionPoint& point : points) {
    in_azimuth.push_back(point.in_azimuth);
    in_elevation.push_back(point.in_elevation);
    in_azimuth.back().fold = in_elevation.back().fold = folds[point.frame];
    azimuth_before.push_back(point.in_azimuth.value);
    elevation_before.push_back(point.in_elevation.value);
    correction.min_elevation = std::min(correction.min_elevation, point.elevation);
    correction.max_elevation = std::max(correction.max_elevation, point.elevation);
  }
  const SmoothFit azimuth = fit_angle(in_azimuth, triangulation::kAzimuthOrders, kFreeAzimuth, exact_places);
  const SmoothFit elevation = fit_angle(in_elevation, triangulation::kElevationOrders, kFreeElevation, exact_places);
  correction.camera = camera.name;
  correction.azimuth = coefficients_of(azimuth);
  correction.elevation = coefficients_of(elevation);
  correction.azimuth_sigma = sigma_of(azimuth, in_azimuth, kFreeAzimuth);
  correction.elevation_sigma = sigma_of(elevation, in_elevation, kFreeElevation);
  correction.position = camera.position;
  correction.yaw = camera.yaw;
  correction.tilt_x = camera.tilt_x;
  correction.tilt_y = camera.tilt_y;
  correction.lens = triangulation::lens_digest(camera);
  result.correction.cameras.push_back(correction);
  refuse_poor_fit(camera.name, "azimuth", azimuth.left, in_azimuth, kAzimuthFloor);
  refuse_poor_fit(camera.name, "elevation", elevation.left, in_elevation, kElevationFloor);
  result.azimuth_rms.push_back(root_mean_square(azimuth.left));
  result.elevation_rms.push_back(root_mean_square(elevation.left));
  result.azimuth_rms_before.push_back(root_mean_square(azimuth_before));
  result.elevation_rms_before.push_back(root_mean_square(elevation_before));
}

}  // namespace

CorrectionFit fit_correction(const Sightings& sightings, const CorrectionOptions& options) {
  std::vector<CorrectionPoint> points = correction_points(sightings, options.place_sigma);
  const auto of_camera = [&](std::size_t camera) {
    std::vector<CorrectionPoint> own;
    for (const CorrectionPoint& point : points) {
      if (point.camera == static_cast<int>(camera)) own.push_back(point);
    }
    return own;
  };
  const auto& cameras = sightings.rig.cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) require_places(cameras[i].name, of_camera(i));
  refuse_swapped_cameras(sightings, points);
  CorrectionFit result;
  result.rejected = reject_outliers(sightings, points);
  const std::vector<int> folds = folds_of(sightings.frames.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    require_places(cameras[i].name, of_camera(i));
    refuse_beyond_differences(sightings, of_camera(i));
    fit_camera(cameras[i], of_camera(i), folds, options.place_sigma <= 0.0, result);
  }
  return result;
}

}  // namespace movis::calibration
