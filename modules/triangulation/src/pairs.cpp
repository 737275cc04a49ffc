#include "movis/triangulation/pairs.h"

#include <cmath>

#include "movis/core/angle.h"
#include "owning_pair.h"

namespace movis::triangulation {

using Eigen::Matrix2d;
using Eigen::Vector2d;

PairsOptions read_pairs_options(const YamlMap& map) {
  map.allow({"min_parallax_deg"});
  PairsOptions options;
  map.read_number("min_parallax_deg", {0.001, 90.0}, options.min_parallax_deg);
  return options;
}

Intersection intersect(const Vector2d& position1, double azimuth1, const Vector2d& position2, double azimuth2,
                       const PairsOptions& options) {
  const Vector2d d1(std::cos(azimuth1), std::sin(azimuth1));
  const Vector2d d2(std::cos(azimuth2), std::sin(azimuth2));
  const Vector2d b = position2 - position1;
  const double parallax = std::sin(azimuth2 - azimuth1);  // D
  Intersection result;
  if (!(std::abs(parallax) >= std::sin(radians(options.min_parallax_deg)))) {
    result.status = PointStatus::parallel_rays;
    return result;
  }
  result.range1 = (b.x() * d2.y() - b.y() * d2.x()) / parallax;
  result.range2 = (b.x() * d1.y() - b.y() * d1.x()) / parallax;
  result.point = position1 + result.range1 * d1;
  result.status = result.range1 > 0.0 && result.range2 > 0.0 ? PointStatus::ok : PointStatus::behind_camera;
  // Turning ray 1 by ε moves its line at the point by range1 ε along n1 = (−d1_y, d1_x); the intersection stays on the
  // other line: it moves by range1 ε · d2 / (n1·d2), with n1·d2 = D (and n2·d1 = −D).
  result.point_by_azimuths.col(0) = result.range1 / parallax * d2;
  result.point_by_azimuths.col(1) = -result.range2 / parallax * d1;
  return result;
}

PointEstimate triangulate_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                const PairsOptions& options) {
  const auto azimuth = [](const Bearing& bearing) { return bearing.azimuth; };
  const OwningPair pair = find_owning_pair(rig, bearings, object, azimuth, options);
  PointEstimate estimate;
  estimate.status = pair.status;
  if (pair.status != PointStatus::ok) return estimate;

  const Bearing& one = *pair.first;
  const Bearing& two = *pair.second;
  const Intersection& floor = pair.intersection;
  // Height: z_k = c_k + s_k tan e_k by each camera, weighted by the variances that the elevations give them.
  const double tan1 = std::tan(one.elevation);
  const double tan2 = std::tan(two.elevation);
  const double slope1 = floor.range1 * (1.0 + tan1 * tan1);  // ∂z/∂e
  const double slope2 = floor.range2 * (1.0 + tan2 * tan2);
  const double variance1 = slope1 * slope1 * one.covariance(1, 1);
  const double variance2 = slope2 * slope2 * two.covariance(1, 1);
  const double share1 = variance1 + variance2 > 0.0 ? variance2 / (variance1 + variance2) : 0.5;
  const double share2 = 1.0 - share1;
  const double z1 = rig.cameras[one.camera].position.z() + floor.range1 * tan1;
  const double z2 = rig.cameras[two.camera].position.z() + floor.range2 * tan2;
  estimate.point << floor.point, share1 * z1 + share2 * z2;

  // Derivatives by (azimuth 1, elevation 1, azimuth 2, elevation 2). The ranges' derivatives follow from the point's:
  // ds1 = d1·dp, ds2 = d2·dp.
  Eigen::Matrix<double, 3, 4> point_by_angles = Eigen::Matrix<double, 3, 4>::Zero();
  point_by_angles.block<2, 1>(0, 0) = floor.point_by_azimuths.col(0);
  point_by_angles.block<2, 1>(0, 2) = floor.point_by_azimuths.col(1);
  const Vector2d d1(std::cos(one.azimuth), std::sin(one.azimuth));
  const Vector2d d2(std::cos(two.azimuth), std::sin(two.azimuth));
  const Eigen::RowVector2d z_by_point = share1 * tan1 * d1.transpose() + share2 * tan2 * d2.transpose();
  point_by_angles(2, 0) = z_by_point * floor.point_by_azimuths.col(0);
  point_by_angles(2, 2) = z_by_point * floor.point_by_azimuths.col(1);
  point_by_angles(2, 1) = share1 * slope1;
  point_by_angles(2, 3) = share2 * slope2;
  Eigen::Matrix4d angles = Eigen::Matrix4d::Zero();
  angles.topLeftCorner<2, 2>() = one.covariance;
  angles.bottomRightCorner<2, 2>() = two.covariance;
  estimate.covariance = point_by_angles * angles * point_by_angles.transpose();
  return estimate;
}

}  // namespace movis::triangulation
