#include "correction_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/median.h"

namespace movis::calibration {
namespace {

constexpr double kLeastSigma = 1e-5;  // radians; of a bearing that claims less
constexpr double kFlagged = 3.0;
constexpr double kLeastDistance = 0.01;  // metres; no ball is nearer to a viewpoint

Eigen::Vector3d to_ball(const Sightings& sightings, const CorrectionPoint& point, int camera) {
  return *sightings.frames[point.frame].ball_in_robot - sightings.rig.cameras[camera].position;
}

double azimuth_of(const Eigen::Vector3d& offset) {
  return std::atan2(offset.y(), offset.x());
}

}  // namespace

std::vector<CorrectionPoint> correction_points(const Sightings& sightings, double place_sigma) {
  constexpr int kUnusable = kCutByBody | kCutByDomain | kCutByObject;
  const auto cameras = static_cast<int>(sightings.rig.cameras.size());
  std::vector<CorrectionPoint> points;
  for (std::size_t frame = 0; frame < sightings.frames.size(); ++frame) {
    const Sighting& sighting = sightings.frames[frame];
    if (!sighting.ball_in_robot) continue;
    for (const Bearing& bearing : sighting.bearings) {
      if (bearing.camera < 0 || bearing.camera >= cameras) {
        throw Error("a bearing is of camera number {}, the rig has {} cameras", bearing.camera, cameras);
      }
      if (bearing.object != ObjectClass::ball || (bearing.flags & kUnusable) != 0) continue;
      CorrectionPoint point;
      point.frame = static_cast<int>(frame);
      point.camera = bearing.camera;
      point.azimuth = bearing.azimuth;
      point.elevation = bearing.elevation;
      const Eigen::Vector3d offset = to_ball(sightings, point, point.camera);
      const double distance = std::max(offset.head<2>().norm(), kLeastDistance);
      point.azimuth_of_place = place_sigma / distance;
      point.elevation_of_place = place_sigma * std::abs(offset.z()) / (distance * distance + offset.z() * offset.z());
      const double trust = bearing.clean() ? 1.0 : kFlagged * kFlagged;
      point.in_azimuth.basis = triangulation::azimuth_basis(bearing.azimuth, bearing.elevation);
      point.in_azimuth.value = turn(bearing.azimuth, azimuth_of(offset));
      point.in_azimuth.variance = trust * std::max(bearing.covariance(0, 0), kLeastSigma * kLeastSigma) +
                                  point.azimuth_of_place * point.azimuth_of_place;
      point.in_elevation.basis = triangulation::elevation_basis(bearing.azimuth, bearing.elevation);
      point.in_elevation.value = std::atan2(offset.z(), offset.head<2>().norm()) - bearing.elevation;
      point.in_elevation.variance = trust * std::max(bearing.covariance(1, 1), kLeastSigma * kLeastSigma) +
                                    point.elevation_of_place * point.elevation_of_place;
      points.push_back(point);
    }
  }
  return points;
}

void refuse_swapped_cameras(const Sightings& sightings, const std::vector<CorrectionPoint>& points) {
  constexpr double kMuch = radians(5.0);
  constexpr double kBetter = 0.25;
  const auto& cameras = sightings.rig.cameras;
  const auto count = static_cast<int>(cameras.size());
  for (int seen = 0; seen < count; ++seen) {
    std::vector<double> off;  // median, were the images those of each camera
    for (int other = 0; other < count; ++other) {
      std::vector<double> angles;
      for (const CorrectionPoint& point : points) {
        if (point.camera != seen) continue;
        const double azimuth = point.azimuth - cameras[seen].yaw + cameras[other].yaw;
        angles.push_back(std::abs(turn(azimuth, azimuth_of(to_ball(sightings, point, other)))));
      }
      off.push_back(median(angles));
    }
    const auto best = static_cast<int>(std::min_element(off.begin(), off.end()) - off.begin());
    if (off[seen] < kMuch || off[best] > kBetter * off[seen]) continue;
    throw Error(
        "the images of {} look like those of {}: the ball is {:.1f}° (median) from where it stands, taken for those of "
        "{} it is {:.1f}°; give each camera its own images in frames.csv, or its own yaw and position in the rig",
        cameras[seen].name, cameras[best].name, degrees(off[seen]), cameras[best].name, degrees(off[best]));
  }
}

}  // namespace movis::calibration
