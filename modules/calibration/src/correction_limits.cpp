#include "correction_limits.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/omni/deviation.h"

namespace movis::calibration {
namespace {

constexpr double kSigmas = 5.0;    // of a deviation
constexpr double kDoubt = 3.0;     // of its own sigmas
constexpr double kPoorFit = 10.0;  // times; places that are said to be exact may be a few times worse

// By what a camera that is off by one sigma of each deviation sees a ball elsewhere: rows azimuth and elevation,
// measured less true, with their sign turned, as the correction's is. Zero where it does not see it.
Eigen::Matrix<double, 2, omni::kDeviations> by_deviation(const omni::Camera& drawn, const Eigen::Vector3d& ball) {
  const omni::Deviation sigma = omni::individual_differences();
  const Eigen::Vector3d offset = ball - drawn.position;
  Eigen::Matrix<double, 2, omni::kDeviations> result;
  result.setZero();
  for (int i = 0; i < omni::kDeviations; ++i) {
    omni::Deviation deviation = omni::Deviation::Zero();
    deviation[i] = sigma[i];
    const auto pixel = project(omni::deviated(drawn, deviation), ball);
    const auto ray = pixel ? unproject(drawn, *pixel) : std::nullopt;
    if (!ray) continue;
    result(0, i) = turn(std::atan2(ray->y(), ray->x()), std::atan2(offset.y(), offset.x()));
    result(1, i) = std::atan2(offset.z(), offset.head<2>().norm()) - std::atan2(ray->z(), ray->head<2>().norm());
  }
  return result;
}

}  // namespace

void refuse_beyond_differences(const Sightings& sightings, const std::vector<CorrectionPoint>& points) {
  using Information = Eigen::Matrix<double, omni::kDeviations, omni::kDeviations>;
  if (points.empty()) return;
  const omni::Camera& camera = sightings.rig.cameras[points.front().camera];
  Information information = Information::Identity();  // the prior's, in its sigmas
  omni::Deviation moment = omni::Deviation::Zero();
  double squares = 0.0;
  for (const CorrectionPoint& point : points) {
    const auto rows = by_deviation(camera, *sightings.frames[point.frame].ball_in_robot);
    const SmoothSample* const samples[] = {&point.in_azimuth, &point.in_elevation};
    const double floors[] = {kAzimuthFloor, kElevationFloor};
    for (int i = 0; i < 2; ++i) {
      const double variance = samples[i]->variance + floors[i] * floors[i];
      information += rows.row(i).transpose() * rows.row(i) / variance;
      moment += rows.row(i).transpose() * (samples[i]->value / variance);
      squares += samples[i]->value * samples[i]->value / variance;
    }
  }
  const omni::Deviation deviation = information.ldlt().solve(moment);  // in sigmas
  // Places may be rougher than they are said to be: what is left widens the deviations' own sigmas (Birge's ratio).
  const double left = squares - moment.dot(deviation) - deviation.squaredNorm();
  const double scale = std::sqrt(std::max(1.0, left / (2.0 * static_cast<double>(points.size()))));
  const omni::Deviation sigma = information.inverse().diagonal().cwiseSqrt() * scale;
  int most = 0;
  if ((deviation.cwiseAbs() - kDoubt * sigma).maxCoeff(&most) <= kSigmas) return;
  throw Error(
      "{} would have to be off by {:.0f} sigmas of its individual differences in {}: a correction is not for that. "
      "Check that the places of truth.csv are in metres and right, that ball_z is the height of the ball's centre "
      "(on the floor, its radius), and that the rig is that of the images",
      camera.name, std::abs(deviation[most]), omni::kDeviationNames[static_cast<std::size_t>(most)]);
}

void refuse_poor_fit(const std::string& camera, const char* angle, const std::vector<double>& left,
                     const std::vector<SmoothSample>& samples, double floor) {
  double squares = 0.0, angles = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    squares += left[i] * left[i] / (samples[i].variance + floor * floor);
    angles += left[i] * left[i];
  }
  const auto n = static_cast<double>(left.size());
  if (squares <= kPoorFit * kPoorFit * n) return;
  throw Error(
      "the correction leaves {:.2f}° (rms) in {} of {}, {:.0f} times what its bearings' sigmas tell; check the "
      "places of truth.csv, how exact they are, ball_z and the rig",
      degrees(std::sqrt(angles / n)), angle, camera, std::sqrt(squares / n));
}

}  // namespace movis::calibration
