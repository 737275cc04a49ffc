#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "movis/core/error.h"
#include "movis/triangulation/pairs.h"

namespace movis::triangulation {

// Two bearings of one object whose cameras own its direction.
struct OwningPair {
  PointStatus status = PointStatus::not_seen;
  const Bearing* first = nullptr;
  const Bearing* second = nullptr;
  Intersection intersection;
};

// How nearly perpendicular the object's direction is to the pair's baseline, in 0…1: |sin| of the angle between the
// baseline and the sum of the two rays. It does not ask where the rays meet, which says nothing where they hardly do.
inline double perpendicularity(const Eigen::Vector2d& baseline, double azimuth1, double azimuth2) {
  const Eigen::Vector2d direction(std::cos(azimuth1) + std::cos(azimuth2), std::sin(azimuth1) + std::sin(azimuth2));
  const double cross = baseline.x() * direction.y() - baseline.y() * direction.x();
  return std::abs(cross) / std::max(baseline.norm() * direction.norm(), 1e-12);
}

// Of an azimuth, for choosing between pairs: a flagged bearing is about three times worse than its covariance says.
inline double trusted_variance(const Bearing& bearing) {
  constexpr double kFlagged = 3.0;
  return bearing.covariance(0, 0) * (bearing.clean() ? 1.0 : kFlagged * kFlagged);
}

inline Eigen::Vector2d position_of(const omni::Rig& rig, const Bearing& bearing) {
  if (bearing.camera < 0 || bearing.camera >= static_cast<int>(rig.cameras.size())) {
    throw Error("a bearing is of camera number {}, the rig has {} cameras", bearing.camera, rig.cameras.size());
  }
  return rig.cameras[bearing.camera].position.head<2>();
}

// Intersects every pair of the object's bearings, `azimuth_of` each, and keeps the pair that owns the object's
// direction: the largest perpendicularity over the standard deviation of the parallax. Without a pair that intersects,
// the status of the last one that was tried says why.
template <typename AzimuthOf>
OwningPair find_owning_pair(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                            AzimuthOf azimuth_of, const PairsOptions& options) {
  if (rig.cameras.size() < 2) {
    throw Error("triangulation needs a rig of two or more cameras; this one has {}", rig.cameras.size());
  }
  OwningPair best;
  double best_score = -1.0;
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    const Bearing& one = bearings[i];
    if (one.object != object) continue;
    const Eigen::Vector2d position1 = position_of(rig, one);
    if (best.status == PointStatus::not_seen) best.status = PointStatus::one_camera;
    for (std::size_t j = i + 1; j < bearings.size(); ++j) {
      const Bearing& two = bearings[j];
      if (two.object != object || two.camera == one.camera) continue;
      const Eigen::Vector2d position2 = position_of(rig, two);
      const Intersection found = intersect(position1, azimuth_of(one), position2, azimuth_of(two), options);
      if (found.status != PointStatus::ok) {
        if (best_score < 0.0) best.status = found.status;
        continue;
      }
      const double deviation = std::sqrt(trusted_variance(one) + trusted_variance(two));
      const double score =
          perpendicularity(position2 - position1, azimuth_of(one), azimuth_of(two)) / std::max(deviation, 1e-12);
      if (score > best_score) {
        best_score = score;
        best = {PointStatus::ok, &one, &two, found};
      }
    }
  }
  return best;
}

}  // namespace movis::triangulation
