#include "movis/triangulation/obstacles.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

double square(double value) {
  return value * value;
}

// A round body, of one sight or of several.
struct Body {
  Vector2d axis = Vector2d::Zero();
  Matrix2d information = Matrix2d::Zero();       // of the axis
  Matrix2d foot_information = Matrix2d::Zero();  // of the nearest point, by the best sight
  double radius = 0.0;
  double radius_information = 0.0;
  unsigned cameras = 0;  // bits
};
constexpr int kCameraBits = std::numeric_limits<unsigned>::digits;

Body body_of(const omni::Camera& camera, const ObstacleSight& sight, const ObstacleOptions& options) {
  constexpr double kLeastGap = 0.05;  // 1 − sin α of a body that the camera nearly touches
  const double half = 0.5 * std::abs(turn(sight.right, sight.left));
  const double gap = std::max(kLeastGap, 1.0 - std::sin(half));
  const double azimuth = sight.right + half;
  const double turn_variance = 0.5 * square(radians(options.azimuth_sigma_deg));
  const double distance_variance = square(sight.sigma) + square(options.distance_sigma);
  Body body;
  body.radius = std::min(options.largest_radius, sight.distance * (1.0 - gap) / gap);
  const double distance = sight.distance + body.radius;
  const double by_half = sight.distance * std::cos(half) / square(gap);
  const double along_variance = distance_variance / square(gap) + square(by_half) * turn_variance;
  const double across_variance = square(distance) * turn_variance;
  const Vector2d along(std::cos(azimuth), std::sin(azimuth));
  const Vector2d across(-along.y(), along.x());
  body.axis = camera.position.head<2>() + distance * along;
  body.information = along * along.transpose() / along_variance + across * across.transpose() / across_variance;
  body.foot_information = along * along.transpose() / distance_variance + across * across.transpose() / across_variance;
  body.radius_information = 1.0 / (square((1.0 - gap) / gap) * distance_variance + square(by_half) * turn_variance);
  body.cameras = 1U << static_cast<unsigned>(sight.camera);
  return body;
}

bool same(const Body& a, const Body& b, const ObstacleOptions& options) {
  const Vector2d between = b.axis - a.axis;
  const double length = between.norm();
  if (length <= options.same_distance) return true;
  const Vector2d direction = between / length;
  const double sigma = std::sqrt(direction.dot((a.information.inverse() + b.information.inverse()).eval() * direction));
  return length <= options.same_distance + 2.0 * sigma;
}

void add(const Body& more, Body& body) {
  const Matrix2d information = body.information + more.information;
  body.axis = information.inverse() * (body.information * body.axis + more.information * more.axis);
  body.information = information;
  if (more.foot_information.determinant() > body.foot_information.determinant()) {
    body.foot_information = more.foot_information;
  }
  const double radius_information = body.radius_information + more.radius_information;
  body.radius = (body.radius_information * body.radius + more.radius_information * more.radius) / radius_information;
  body.radius_information = radius_information;
  body.cameras |= more.cameras;
}

Obstacle obstacle_of(const Body& body) {
  Obstacle obstacle;
  const double range = body.axis.norm();
  const Vector2d direction = range > 0.0 ? Vector2d(body.axis / range) : Vector2d::UnitY();
  obstacle.azimuth = std::atan2(direction.y(), direction.x());
  obstacle.distance = std::max(0.0, range - body.radius);
  obstacle.width = 2.0 * body.radius;
  obstacle.foot = obstacle.distance * direction;
  obstacle.covariance = body.foot_information.inverse();
  for (unsigned bits = body.cameras; bits != 0; bits &= bits - 1) ++obstacle.cameras;
  return obstacle;
}

bool covers(const ObstacleSight& sight, double azimuth) {
  constexpr double kBorder = radians(1.0);  // an azimuth of the obstacle scan
  return turn(sight.right - kBorder, azimuth) >= 0.0 && turn(azimuth, sight.left + kBorder) >= 0.0;
}

void hide(double hidden, double& variance, std::uint8_t& flags) {
  variance = std::max(variance, hidden);
  flags |= kCutByObject;
}

}  // namespace

ObstacleOptions read_obstacle_options(const YamlMap& map) {
  map.allow({"azimuth_sigma_deg", "distance_sigma", "largest_radius", "same_distance"});
  ObstacleOptions options;
  map.read_number("azimuth_sigma_deg", {0.01, 10.0}, options.azimuth_sigma_deg);
  map.read_number("distance_sigma", {0.0, 1.0}, options.distance_sigma);
  map.read_number("largest_radius", {0.05, 2.0}, options.largest_radius);
  map.read_number("same_distance", {0.0, 2.0}, options.same_distance);
  return options;
}

void merge_obstacles(const omni::Rig& rig, const std::vector<ObstacleSight>& sights, const ObstacleOptions& options,
                     std::vector<Obstacle>& obstacles) {
  if (rig.cameras.size() > kCameraBits) {
    throw Error("obstacles are merged from up to {} cameras, this rig has {}; leave some of them out", kCameraBits,
                rig.cameras.size());
  }
  std::array<Body, kMostObstacles> bodies;
  int count = 0;
  for (const ObstacleSight& sight : sights) {
    if (sight.camera < 0 || sight.camera >= static_cast<int>(rig.cameras.size())) {
      throw Error("a sight of an obstacle is of camera number {}, the rig has {} cameras", sight.camera,
                  rig.cameras.size());
    }
    const Body body = body_of(rig.cameras[sight.camera], sight, options);
    const auto end = bodies.begin() + count;
    const auto known = std::find_if(bodies.begin(), end, [&](const Body& other) { return same(other, body, options); });
    if (known != end) {
      add(body, *known);
    } else if (count < kMostObstacles) {
      bodies[count++] = body;
    }
  }
  obstacles.clear();
  for (int i = 0; i < count; ++i) obstacles.push_back(obstacle_of(bodies[i]));
}

void hide_covered_edges(const std::vector<ObstacleSight>& sights, std::vector<Bearing>& bearings) {
  for (Bearing& bearing : bearings) {
    if (bearing.object != ObjectClass::yellow_goal && bearing.object != ObjectClass::blue_goal) continue;
    const double hidden = square(0.5 * turn(bearing.right, bearing.left));
    for (const ObstacleSight& sight : sights) {
      if (sight.camera != bearing.camera) continue;
      const bool left = covers(sight, bearing.left);
      const bool right = covers(sight, bearing.right);
      if (left) hide(hidden, bearing.left_variance, bearing.left_flags);
      if (right) hide(hidden, bearing.right_variance, bearing.right_flags);
    }
    bearing.flags |= bearing.left_flags | bearing.right_flags;
  }
}

}  // namespace movis::triangulation
