// The bound of one camera's bearing of a ball, from the information in the picture of its outline.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "movis/triangulation/cramer_rao.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix3d;
using test::expect_error;

constexpr double kRadius = 0.11;  // of the ball, metres

// A paraboloid's picture is a stereographic projection: conformal, so that a ball on the horizon has a round image, of
// radius f tan γ, and a radian of any angle is f pixels there.
omni::Camera conformal_camera(double focal_px) {
  omni::Camera camera;
  camera.width = camera.height = 4000;
  omni::UnifiedSphere model;
  model.xi = 1.0;
  model.fu = model.fv = focal_px;
  model.u0 = model.v0 = 2000.0;
  camera.model = model;
  return camera;
}

Vector3d on_the_horizon(double angular_radius) {
  return {0.0, kRadius / std::sin(angular_radius), 0.0};
}

double blur_of(const Picture& picture) {
  return std::sqrt(picture.blur_px * picture.blur_px + 1.0 / 12.0);
}

// By hand, for a disc much larger than the blur: n = f cos ψ for a displacement by azimuth, so that with r = f tan γ
//   J = C²/(σ² 2√π s) ∮ n² ds = C²/(σ² 2√π s) · π r f².
TEST(BearingBound, LargeDiscByHand) {
  const Picture picture{100.0, 3.0, 1.0};
  const double focal = 1500.0;
  const double radius_px = 20.0;
  const Matrix3d bound =
      bearing_bound(conformal_camera(focal), on_the_horizon(std::atan(radius_px / focal)), kRadius, picture);
  const double variance_px =
      9.0 / 1e4 * 2.0 * std::sqrt(kPi) * blur_of(picture) / (kPi * radius_px);  // of the disc's place
  EXPECT_NEAR(bound(0, 0) * focal * focal / variance_px, 1.0, 0.005);
  EXPECT_NEAR(bound(1, 1) * focal * focal / variance_px, 1.0, 0.005);
  EXPECT_NEAR(bound(0, 1) * focal * focal / variance_px, 0.0, 1e-6);
}

struct DiscBound {
  double place, size;  // variances, px²
};

// The Fisher information of place, radius and level of a disc blurred by a Gaussian, by plain integration over the
// picture. The blurred disc and its derivative by the radius are, at the distance ρ from its middle,
//   S(ρ) = ∫₀ʳ (t/s²) e^(−(ρ² + t²)/2s²) I₀(ρ t/s²) dt,   ∂S/∂r = (r/s²) e^(−(ρ² + r²)/2s²) I₀(ρ r/s²)
DiscBound integrated_bound(double radius, double blur, double contrast, double noise) {
  const double s2 = blur * blur;
  const auto ring = [&](double rho, double t) {  // e^−x I₀(x) keeps it finite
    const double x = rho * t / s2;
    return t / s2 * std::exp(-0.5 * (rho - t) * (rho - t) / s2) * std::exp(-x) * std::cyl_bessel_i(0.0, x);
  };
  constexpr double kStep = 0.01;
  constexpr double kInner = 0.02;
  double place = 0.0, size = 0.0, level = 0.0, size_level = 0.0;
  const auto blurred = [&](double rho) {
    const int steps = static_cast<int>(std::lround(radius / kInner));
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) sum += ring(rho, (i + 0.5) * radius / steps) * radius / steps;
    return sum;
  };
  double before = blurred(0.0);
  for (double rho = 0.5 * kStep; rho < radius + 6.0 * blur; rho += kStep) {
    const double after = blurred(rho + 0.5 * kStep);
    const double slope = contrast * (after - before) / kStep;
    const double value = 0.5 * (before + after);
    const double by_size = contrast * ring(rho, radius);
    place += kPi * slope * slope * rho * kStep;
    size += 2.0 * kPi * by_size * by_size * rho * kStep;
    level += 2.0 * kPi * value * value * rho * kStep;
    size_level += 2.0 * kPi * value * by_size * rho * kStep;
    before = after;
  }
  return {noise * noise / place, noise * noise / (size - size_level * size_level / level)};
}

// From a ball of hardly a pixel to a large one.
TEST(BearingBound, IsThatOfTheIntegratedPicture) {
  const Picture picture{100.0, 3.0, 0.6};
  const double focal = 1000.0;
  for (const double radius_px : {0.4, 1.0, 2.0, 4.0, 6.4, 7.0}) {
    const DiscBound expected = integrated_bound(radius_px, blur_of(picture), picture.contrast, picture.noise);
    const Matrix3d bound =
        bearing_bound(conformal_camera(focal), on_the_horizon(std::atan(radius_px / focal)), kRadius, picture);
    EXPECT_NEAR(bound(0, 0) * focal * focal / expected.place, 1.0, 0.003) << radius_px;
    EXPECT_NEAR(bound(1, 1) * focal * focal / expected.place, 1.0, 0.003) << radius_px;
    EXPECT_NEAR(bound(2, 2) * focal * focal / expected.size, 1.0, 0.003) << radius_px;
  }
}

// A large ball in a real mirror, where the outline is no circle, through the forward model: its points' pixels, moved
// by each angle in turn.
TEST(BearingBound, IsThatOfTheNumericOutline) {
  const omni::Camera camera = camera_at({0.1, -0.2}, 0.7);
  const Picture picture{150.0, 2.0, 0.3};
  const Vector3d ball(0.4, 0.35, kBall);
  const Vector3d offset = ball - camera.position;
  const Vector3d angles(azimuth_of(offset.head<2>()), std::atan2(offset.z(), offset.head<2>().norm()),
                        std::asin(kRadius / offset.norm()));
  const auto pixel_at = [&](const Vector3d& at, double psi) {
    const Vector3d axis(std::cos(at[1]) * std::cos(at[0]), std::cos(at[1]) * std::sin(at[0]), std::sin(at[1]));
    const Vector3d left(-std::sin(at[0]), std::cos(at[0]), 0.0);
    const Vector3d up(-std::sin(at[1]) * std::cos(at[0]), -std::sin(at[1]) * std::sin(at[0]), std::cos(at[1]));
    const Vector3d ray = std::cos(at[2]) * axis + std::sin(at[2]) * (std::cos(psi) * left + std::sin(psi) * up);
    return omni::project(camera, camera.position + ray).value();
  };
  constexpr int kPieces = 2000;
  constexpr double kStep = 1e-5;
  Matrix3d information = Matrix3d::Zero();
  for (int i = 0; i < kPieces; ++i) {
    const double psi = 2.0 * kPi * i / kPieces;
    const Vector2d along = pixel_at(angles, psi + kPi / kPieces) - pixel_at(angles, psi - kPi / kPieces);
    Vector3d normal;
    for (int j = 0; j < 3; ++j) {
      const Vector3d step = kStep * Vector3d::Unit(j);
      const Vector2d moved = (pixel_at(angles + step, psi) - pixel_at(angles - step, psi)) / (2.0 * kStep);
      normal[j] = (moved.x() * along.y() - moved.y() * along.x()) / along.norm();
    }
    information += along.norm() * normal * normal.transpose();
  }
  const double signal = picture.contrast / picture.noise;
  information *= signal * signal / (2.0 * std::sqrt(kPi) * blur_of(picture));
  const Matrix3d expected = information.inverse();
  const Matrix3d bound = bearing_bound(camera, ball, kRadius, picture);
  EXPECT_NEAR(bound(0, 0) / expected(0, 0), 1.0, 0.01);
  EXPECT_NEAR(bound(1, 1) / expected(1, 1), 1.0, 0.01);
  // The unknown level costs a share of about √π s/r of the size's information: r is some 35 pixels here.
  EXPECT_GT(bound(2, 2) / expected(2, 2), 1.0);
  EXPECT_LT(bound(2, 2) / expected(2, 2), 1.05);
}

TEST(BearingBound, GrowsWithNoiseOverContrast) {
  const omni::Camera camera = camera_at({0.0, 0.0}, 0.0);
  const Vector3d ball(0.5, 1.5, kBall);
  const Matrix3d bound = bearing_bound(camera, ball, kRadius, {100.0, 2.0, 0.6});
  EXPECT_LT((bearing_bound(camera, ball, kRadius, {50.0, 4.0, 0.6}) - 16.0 * bound).norm(), 1e-9 * bound.norm());
}

// Yaw turns the picture; which pixels show the ball does not matter.
TEST(BearingBound, DoesNotDependOnYaw) {
  const Vector3d ball(0.5, 1.5, kBall);
  const Matrix3d bound = bearing_bound(camera_at({0.0, 0.0}, 0.0), ball, kRadius, {});
  const Matrix3d turned = bearing_bound(camera_at({0.0, 0.0}, 2.0), ball, kRadius, {});
  EXPECT_LT((turned - bound).norm(), 1e-9 * bound.norm());
}

TEST(BearingBound, CutByThePicturesBorder) {
  omni::Camera camera = conformal_camera(1000.0);
  const Vector3d ball = on_the_horizon(0.03);  // at (2000, 3000) with a radius of 30 pixels
  const Matrix3d whole = bearing_bound(camera, ball, kRadius, {});
  camera.height = 3001;  // half of it
  const Matrix3d half = bearing_bound(camera, ball, kRadius, {});
  EXPECT_TRUE(half.allFinite());
  for (int i = 0; i < 3; ++i) EXPECT_GT(half(i, i), 1.5 * whole(i, i)) << i;
  camera.height = 2960;
  EXPECT_EQ(bearing_bound(camera, ball, kRadius, {})(0, 0), std::numeric_limits<double>::infinity());
}

TEST(BearingBound, BallThatTheCameraDoesNotSee) {
  const omni::Camera camera = camera_at({0.0, 0.0}, 0.0);
  for (const Vector3d& ball : {Vector3d(0.0, 1.0, 3.0),               // above the mirror's rim
                               Vector3d(0.0, 0.05, kHeight),          // the camera is within the ball
                               Vector3d(0.0, 0.0, kHeight - 0.5)}) {  // straight below there is no azimuth
    const Matrix3d bound = bearing_bound(camera, ball, kRadius, {});
    EXPECT_FALSE(bound.hasNaN());
    EXPECT_EQ(bound(1, 1), std::numeric_limits<double>::infinity()) << ball.transpose();
  }
}

TEST(BearingBound, BrokenPreconditions) {
  const omni::Camera camera = camera_at({0.0, 0.0}, 0.0);
  const Vector3d ball(0.5, 1.5, kBall);
  expect_error([&] { bearing_bound(camera, ball, kRadius, {100.0, 0.0, 0.6}); }, {"noise is 0", "above 0"});
  expect_error([&] { bearing_bound(camera, ball, kRadius, {0.0, 2.0, 0.6}); }, {"contrast is 0"});
  expect_error([&] { bearing_bound(camera, ball, kRadius, {100.0, 2.0, -1.0}); }, {"blur is -1"});
  expect_error([&] { bearing_bound(camera, ball, -0.1, {}); }, {"radius is -0.1 m"});
}

}  // namespace
}  // namespace movis::triangulation
