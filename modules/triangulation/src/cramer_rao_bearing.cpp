#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "information.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/triangulation/cramer_rao.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kOutline = 128;  // pieces; smooth and periodic, so that far fewer would do where all of it is seen

// A piece of the outline in the picture.
struct Piece {
  double length = 0.0;                 // pixels
  Vector3d normal = Vector3d::Zero();  // its displacement along its normal by the three angles, pixels a radian
};

// The cone's axis, and what it moves along by elevation and by azimuth (the latter over the elevation's cosine).
struct Axes {
  Vector3d axis, up, left;
};

Axes axes_of(const Vector3d& direction) {
  const Vector3d left = Vector3d(-direction.y(), direction.x(), 0.0) / direction.head<2>().norm();
  return {direction, direction.cross(left), left};
}

// The pieces of the outline that are seen. A ray of the cone is cos γ n + sin γ (cos ψ left + sin ψ up).
std::vector<Piece> outline_of(const omni::Camera& camera, const Axes& axes, double radius) {
  const Matrix3d camera_from_robot = camera.robot_from_camera().transpose();
  std::vector<Piece> pieces;
  pieces.reserve(kOutline);
  for (int i = 0; i < kOutline; ++i) {
    const double angle = 2.0 * kPi * (i + 0.5) / kOutline;
    const Vector3d outwards = std::cos(angle) * axes.left + std::sin(angle) * axes.up;
    const Vector3d ray = std::cos(radius) * axes.axis + std::sin(radius) * outwards;
    const auto projection = project_with_jacobian(camera.model, camera_from_robot * ray);
    if (!projection || !omni::project(camera, camera.position + ray)) continue;
    Matrix3d ray_by_angles;
    ray_by_angles.col(0) = Vector3d(-ray.y(), ray.x(), 0.0);  // turned about z
    ray_by_angles.col(1) = std::cos(radius) * axes.up - std::sin(radius) * std::sin(angle) * axes.axis;
    ray_by_angles.col(2) = std::cos(radius) * outwards - std::sin(radius) * axes.axis;
    const Eigen::Matrix<double, 2, 3> pixel_by_ray = projection->pixel_by_ray * camera_from_robot;
    const Vector3d onwards = std::sin(radius) * (std::cos(angle) * axes.up - std::sin(angle) * axes.left);
    const Vector2d tangent = pixel_by_ray * onwards;  // pixels a radian of ψ
    const Vector2d normal = Vector2d(tangent.y(), -tangent.x()).normalized();
    pieces.push_back({tangent.norm() * 2.0 * kPi / kOutline, (pixel_by_ray * ray_by_angles).transpose() * normal});
  }
  return pieces;
}

// f₁ and f₀ of a disc. With κ = r²/(2 s²), X = e^−κ I₀(κ) and Y = e^−κ I₁(κ), its picture's information is (docs/bound.md)
//   place           (C/σ)² π κ Y
//   size            (C/σ)² 2π κ X
//   level           π r² (1 − X − Y)/σ²
//   size and level  π r C (1 − X)/σ²
struct FiniteSize {
  double place, size;
};

FiniteSize finite_size(double radius_px, double blur) {
  const double kappa = radius_px * radius_px / (2.0 * blur * blur);
  constexpr double kLarge = 50.0;  // there the series of 1/κ is right to 1e-6
  const double thin = 1.0 / std::sqrt(2.0 * kPi * kappa);
  const double inverse = 1.0 / kappa;
  const double x = kappa > kLarge ? thin * (1.0 + inverse * (0.125 + inverse * 9.0 / 128.0))
                                  : std::exp(-kappa) * std::cyl_bessel_i(0.0, kappa);
  const double y = kappa > kLarge ? thin * (1.0 - inverse * (0.375 + inverse * 15.0 / 128.0))
                                  : std::exp(-kappa) * std::cyl_bessel_i(1.0, kappa);
  const double shared =
      (1.0 - x) * (1.0 - x) / (2.0 * kappa * x * (1.0 - x - y));  // squared correlation of size and level
  return {y / thin, x / thin * (1.0 - shared)};
}

void check(double ball_radius, const Picture& picture) {
  if (!(ball_radius > 0.0)) throw Error("the ball's radius is {} m; give one above 0", ball_radius);
  if (!(picture.contrast > 0.0)) throw Error("the contrast is {} grey levels; give one above 0", picture.contrast);
  if (!(picture.noise > 0.0)) {
    throw Error("the noise is {} grey levels: without noise there is no bound; give a sigma above 0", picture.noise);
  }
  if (!(picture.blur_px >= 0.0)) throw Error("the blur is {} pixels; give a sigma of 0 or more", picture.blur_px);
}

}  // namespace

Matrix3d bearing_bound(const omni::Camera& camera, const Vector3d& ball_in_robot, double ball_radius,
                       const Picture& picture) {
  check(ball_radius, picture);
  const Vector3d offset = ball_in_robot - camera.position;
  const double distance = offset.norm();
  if (distance <= ball_radius || offset.head<2>().norm() < kNoAzimuth * distance) return unobservable<3>();
  const double radius = std::asin(ball_radius / distance);
  const std::vector<Piece> outline = outline_of(camera, axes_of(offset / distance), radius);
  double length = 0.0;
  Vector3d mean = Vector3d::Zero();
  for (const Piece& piece : outline) {
    length += piece.length;
    mean += piece.length * piece.normal;
  }
  if (!(length > 0.0)) return unobservable<3>();
  mean /= length;
  Matrix3d around_mean = Matrix3d::Zero();
  for (const Piece& piece : outline) {
    around_mean += piece.length * (piece.normal - mean) * (piece.normal - mean).transpose();
  }
  const double blur = std::sqrt(picture.blur_px * picture.blur_px + 1.0 / 12.0);
  const double signal = picture.contrast / picture.noise;
  const double density = signal * signal / (2.0 * std::sqrt(kPi) * blur);  // of information, by pixel of outline
  const FiniteSize factor = finite_size(radius * std::abs(mean.z()), blur);
  return inverse_information<3>(density *
                                (factor.place * around_mean + factor.size * length * mean * mean.transpose()));
}

}  // namespace movis::triangulation
