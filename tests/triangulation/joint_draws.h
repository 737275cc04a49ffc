#pragma once

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <vector>

#include "movis/triangulation/joint.h"
#include "movis_rig.h"

// Balls that are drawn with bearings of stated noise, and the Cramér–Rao bound of their places, written down from the
// definition: J = Aᵀ Σ⁻¹ A at the true place, Σ of all angles of all cameras, common biases and all.
namespace movis::triangulation {

struct Noise {
  double azimuth = radians(0.01);
  double elevation = radians(0.02);
  double radius = 0.0;       // 0: the radius is not measured
  double correlation = 0.0;  // between any two angles of one camera
};

using Matrix3d = Eigen::Matrix3d;

// Of (azimuth, elevation, radius), by the ball's place.
inline Matrix3d angles_by_place(const Vector3d& camera, const Vector3d& ball, double ball_radius) {
  const Vector3d o = ball - camera;
  const double h = o.head<2>().norm();
  const double d = o.norm();
  Matrix3d by_place;
  by_place.row(0) << -o.y() / (h * h), o.x() / (h * h), 0.0;
  by_place.row(1) << -o.z() * o.x() / (h * d * d), -o.z() * o.y() / (h * d * d), h / (d * d);
  by_place.row(2) = -ball_radius / (d * d * std::sqrt(d * d - ball_radius * ball_radius)) * o.transpose();
  return by_place;
}

inline Matrix3d covariance_of(const Noise& noise) {
  const Vector3d sigma(noise.azimuth, noise.elevation, noise.radius);
  Matrix3d covariance = noise.correlation * sigma * sigma.transpose();
  covariance.diagonal() = sigma.cwiseAbs2();
  return covariance;
}

inline Matrix3d place_bound(const omni::Rig& rig, const std::vector<int>& cameras, const Vector3d& ball,
                            const Noise& noise, const JointOptions& options) {
  const int angles = noise.radius > 0.0 ? 3 : 2;
  const int n = static_cast<int>(cameras.size());
  Eigen::MatrixXd a(n * angles, 3);
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Zero(n * angles, n * angles);
  const double biases[] = {0.0, radians(options.elevation_bias_deg), radians(options.radius_bias_deg)};
  for (int i = 0; i < n; ++i) {
    a.middleRows(i * angles, angles) =
        angles_by_place(rig.cameras[cameras[i]].position, ball, options.ball_radius).topRows(angles);
    sigma.block(i * angles, i * angles, angles, angles) = covariance_of(noise).topLeftCorner(angles, angles);
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < angles; ++k) sigma(i * angles + k, j * angles + k) += biases[k] * biases[k];
    }
  }
  Matrix3d information = a.transpose() * sigma.inverse() * a;
  if (options.floor) information(2, 2) += 1.0 / (options.floor_sigma * options.floor_sigma);
  return information.inverse();
}

struct Draw {
  Vector3d ball;
  std::vector<Bearing> bearings;
};

// On 8 m × 8 m, not under the robot; on the floor, or above it by `lowest` to `highest`.
struct Heights {
  double lowest = 0.0, highest = 0.0;
};

inline Draw draw_ball(const omni::Rig& rig, const Noise& noise, const JointOptions& options, RandomStream& stream,
                      const Heights& heights = {}) {
  Draw draw;
  do {
    draw.ball = Vector3d(uniform(stream, -4.0, 4.0), uniform(stream, -4.0, 4.0), options.ball_radius);
  } while (draw.ball.head<2>().norm() < 0.5);
  draw.ball.z() +=
      heights.highest > 0.0 ? uniform(stream, heights.lowest, heights.highest) : normal(stream, options.floor_sigma);
  const Matrix3d root = covariance_of(noise).llt().matrixL();  // without a radius its last row is zero
  const double elevation_bias = normal(stream, radians(options.elevation_bias_deg));
  const double radius_bias = normal(stream, radians(options.radius_bias_deg));
  draw.bearings = exact_bearings(rig, draw.ball);
  for (Bearing& bearing : draw.bearings) {
    const Vector3d unit(normal(stream, 1.0), normal(stream, 1.0), normal(stream, 1.0));
    const Vector3d error = root * unit;
    const Matrix3d covariance = covariance_of(noise);
    bearing.azimuth = wrap_angle(bearing.azimuth + error.x());
    bearing.elevation += error.y() + elevation_bias;
    bearing.covariance = covariance.topLeftCorner<2, 2>();
    if (noise.radius == 0.0) continue;
    const double distance = (draw.ball - rig.cameras[bearing.camera].position).norm();
    bearing.radius = std::asin(options.ball_radius / distance) + error.z() + radius_bias;
    bearing.radius_variance = covariance(2, 2);
    bearing.radius_covariance = covariance.topRightCorner<2, 1>();
  }
  return draw;
}

// What many draws came to.
struct Consistency {
  int measured = 0, on_floor = 0;
  double squares = 0.0;  // of the errors on the floor plane, and what the bound has for their mean
  double bound = 0.0;
  double nees_floor = 0.0, nees_point = 0.0;

  void add(const PointEstimate& estimate, const Vector3d& ball, const Matrix3d& place_bound) {
    const Vector3d error = estimate.point - ball;
    const Vector2d on_plane = error.head<2>();
    squares += on_plane.squaredNorm();
    bound += place_bound.topLeftCorner<2, 2>().trace();
    nees_floor += on_plane.dot(estimate.covariance.topLeftCorner<2, 2>().inverse() * on_plane) / 2.0;
    nees_point += error.dot(estimate.covariance.inverse() * error) / 3.0;
    ++measured;
    on_floor += estimate.on_floor ? 1 : 0;
  }

  double efficiency() const { return std::sqrt(squares / bound); }  // RMS over the bound
  double mean_nees_floor() const { return nees_floor / measured; }
  double mean_nees_point() const { return nees_point / measured; }
};

}  // namespace movis::triangulation
