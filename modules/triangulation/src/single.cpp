#include "movis/triangulation/single.h"

#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

// A range that follows from the depression of a ray, with its derivative.
struct Range {
  double range = 0.0;          // metres
  double by_depression = 0.0;  // metres a radian
};

// The ray's depression has a variance and a covariance with the azimuth.
struct Depression {
  double angle = 0.0;
  double variance = 0.0;
  double with_azimuth = 0.0;
};

double height_above_centre(const omni::Camera& camera, const SingleOptions& options) {
  const double height = camera.position.z() - options.ball_radius;
  if (height > 0.0) return height;
  throw Error(
      "camera '{}' is {} m above the floor, no higher than the centre of a ball of radius {} m: one camera "
      "cannot tell the ball's distance; raise it",
      camera.name, camera.position.z(), options.ball_radius);
}

PointEstimate on_floor(const omni::Camera& camera, const Bearing& bearing, const Depression& depression,
                       const Range& range, const SingleOptions& options) {
  const Eigen::Vector2d along(std::cos(bearing.azimuth), std::sin(bearing.azimuth));
  const Eigen::Vector2d across(-along.y(), along.x());
  PointEstimate estimate;
  estimate.status = PointStatus::ok;
  estimate.on_floor = true;
  estimate.point << camera.position.head<2>() + range.range * along, options.ball_radius;
  Eigen::Matrix2d point_by_angles;  // azimuth, depression
  point_by_angles << range.range * across, range.by_depression * along;
  Eigen::Matrix2d angles;
  angles << bearing.covariance(0, 0), depression.with_azimuth, depression.with_azimuth, depression.variance;
  estimate.covariance.topLeftCorner<2, 2>() = point_by_angles * angles * point_by_angles.transpose();
  return estimate;
}

PointEstimate without(PointStatus status) {
  PointEstimate estimate;
  estimate.status = status;
  return estimate;
}

bool too_flat(double depression, const SingleOptions& options) {
  return !(depression >= radians(options.min_depression_deg));
}

}  // namespace

SingleOptions read_single_options(const YamlMap& map) {
  map.allow({"ball_radius", "min_depression_deg"});
  SingleOptions options;
  map.read_number("ball_radius", {0.001, 10.0}, options.ball_radius);
  map.read_number("min_depression_deg", {0.001, 45.0}, options.min_depression_deg);
  return options;
}

PointEstimate range_by_elevation(const omni::Camera& camera, const Bearing& bearing, const SingleOptions& options) {
  const double height = height_above_centre(camera, options);
  const Depression down{-bearing.elevation, bearing.covariance(1, 1), -bearing.covariance(0, 1)};
  if (too_flat(down.angle, options)) return without(PointStatus::parallel_rays);
  const double sine = std::sin(down.angle);
  return on_floor(camera, bearing, down, {height / std::tan(down.angle), -height / (sine * sine)}, options);
}

PointEstimate range_by_contact(const omni::Camera& camera, const Bearing& bearing, const SingleOptions& options) {
  height_above_centre(camera, options);
  if (!(bearing.radius > 0.0)) return without(PointStatus::one_camera);
  const double height = camera.position.z();
  const Depression down{bearing.radius - bearing.elevation,
                        bearing.covariance(1, 1) + bearing.radius_variance - 2.0 * bearing.radius_covariance.y(),
                        bearing.radius_covariance.x() - bearing.covariance(0, 1)};
  if (too_flat(down.angle, options)) return without(PointStatus::parallel_rays);
  const double sine = std::sin(down.angle);
  const double half_cosine = std::cos(0.5 * down.angle);
  return on_floor(camera, bearing, down,
                  {height / std::tan(down.angle) + options.ball_radius * std::tan(0.5 * down.angle),
                   -height / (sine * sine) + 0.5 * options.ball_radius / (half_cosine * half_cosine)},
                  options);
}

}  // namespace movis::triangulation
