#include "movis/triangulation/vertical.h"

#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

using Eigen::Vector2d;

void check(const omni::Rig& rig) {
  constexpr double kUpright = 0.1;
  if (rig.cameras.size() != 2) {
    throw Error("vertical stereo needs a rig of two cameras above one another; this one has {}", rig.cameras.size());
  }
  const Eigen::Vector3d baseline = rig.cameras[1].position - rig.cameras[0].position;
  if (baseline.head<2>().norm() <= kUpright * std::abs(baseline.z())) return;
  throw Error(
      "cameras '{}' and '{}' do not stand above one another: {:.3f} m aside, {:.3f} m up; triangulate them as a "
      "pair",
      rig.cameras[0].name, rig.cameras[1].name, baseline.head<2>().norm(), std::abs(baseline.z()));
}

const Bearing* find(const std::vector<Bearing>& bearings, ObjectClass object, int camera) {
  for (const Bearing& bearing : bearings) {
    if (bearing.object == object && bearing.camera == camera) return &bearing;
  }
  return nullptr;
}

// The header's quantities, for cameras 1 and 2.
struct Stack {
  double share1, share2;  // of the mean azimuth
  Vector2d along, across, middle;
  double o1, o2;  // of the viewpoints along the direction
  double l1, l2;  // and across it: ∂o/∂φ
  double t1, t2;
  double range;
};

Stack measure(const omni::Rig& rig, const Bearing& one, const Bearing& two) {
  Stack s;
  const double total = one.covariance(0, 0) + two.covariance(0, 0);
  s.share2 = total > 0.0 ? one.covariance(0, 0) / total : 0.5;
  s.share1 = 1.0 - s.share2;
  const double azimuth = one.azimuth + s.share2 * turn(one.azimuth, two.azimuth);
  s.along = {std::cos(azimuth), std::sin(azimuth)};
  s.across = {-s.along.y(), s.along.x()};
  const Eigen::Vector3d& c1 = rig.cameras[0].position;
  const Eigen::Vector3d& c2 = rig.cameras[1].position;
  s.middle = s.share1 * c1.head<2>() + s.share2 * c2.head<2>();
  s.o1 = s.along.dot(c1.head<2>() - s.middle);
  s.o2 = s.along.dot(c2.head<2>() - s.middle);
  s.l1 = s.across.dot(c1.head<2>() - s.middle);
  s.l2 = s.across.dot(c2.head<2>() - s.middle);
  s.t1 = std::tan(one.elevation);
  s.t2 = std::tan(two.elevation);
  s.range = (c2.z() - c1.z() + s.o1 * s.t1 - s.o2 * s.t2) / (s.t1 - s.t2);
  return s;
}

Eigen::Matrix3d covariance_of(const Stack& s, const Bearing& one, const Bearing& two) {
  // Range and height by (mean azimuth, t1, t2), and the point by these.
  const Eigen::RowVector3d range_by =
      Eigen::RowVector3d(s.l1 * s.t1 - s.l2 * s.t2, s.o1 - s.range, s.range - s.o2) / (s.t1 - s.t2);
  Eigen::Matrix3d point_by;
  point_by.topRows<2>() = s.along * range_by;
  point_by.col(0).head<2>() += s.range * s.across;
  point_by.row(2) = s.t1 * range_by + Eigen::RowVector3d(-s.l1 * s.t1, s.range - s.o1, 0.0);
  Eigen::Matrix<double, 3, 4> by_angles;      // azimuth 1, elevation 1, azimuth 2, elevation 2
  by_angles << s.share1, 0.0, s.share2, 0.0,  //
      0.0, 1.0 + s.t1 * s.t1, 0.0, 0.0,       //
      0.0, 0.0, 0.0, 1.0 + s.t2 * s.t2;
  const Eigen::Matrix<double, 3, 4> jacobian = point_by * by_angles;
  return jacobian.leftCols<2>() * one.covariance * jacobian.leftCols<2>().transpose() +
         jacobian.rightCols<2>() * two.covariance * jacobian.rightCols<2>().transpose();
}

}  // namespace

VerticalOptions read_vertical_options(const YamlMap& map) {
  map.allow({"min_parallax_deg"});
  VerticalOptions options;
  map.read_number("min_parallax_deg", {0.001, 90.0}, options.min_parallax_deg);
  return options;
}

PointEstimate triangulate_vertical(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                   const VerticalOptions& options) {
  check(rig);
  PointEstimate estimate;
  const Bearing* one = find(bearings, object, 0);
  const Bearing* two = find(bearings, object, 1);
  if (one == nullptr || two == nullptr) {
    estimate.status = one == two ? PointStatus::not_seen : PointStatus::one_camera;
    return estimate;
  }
  if (!(std::abs(one->elevation - two->elevation) >= radians(options.min_parallax_deg))) {
    estimate.status = PointStatus::parallel_rays;
    return estimate;
  }
  const Stack stack = measure(rig, *one, *two);
  if (!(stack.range > 0.0)) {
    estimate.status = PointStatus::behind_camera;
    return estimate;
  }
  estimate.status = PointStatus::ok;
  estimate.point << stack.middle + stack.range * stack.along,
      rig.cameras[0].position.z() + (stack.range - stack.o1) * stack.t1;
  estimate.covariance = covariance_of(stack, *one, *two);
  return estimate;
}

}  // namespace movis::triangulation
