// The bound of a position from bearings. Those of a bearing from a picture stand in testBearingBound.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <limits>

#include "movis/triangulation/cramer_rao.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix3d;
using test::expect_error;

constexpr double kFree = -1.0;    // floor_sigma: the height is not known
constexpr double kNothing = 1e6;  // rad: an angle of this sigma says nothing
constexpr double kSigma = 1e-3;   // rad
constexpr double kRadius = 0.11;  // of the ball, metres

Bearing with_sigmas(int camera, double azimuth, double elevation) {
  Bearing bearing;
  bearing.camera = camera;
  bearing.covariance = Eigen::Vector2d(azimuth * azimuth, elevation * elevation).asDiagonal();
  return bearing;
}

std::vector<Bearing> with_sigmas(const omni::Rig& rig, double azimuth, double elevation) {
  std::vector<Bearing> bearings;
  bearings.reserve(rig.cameras.size());
  for (int k = 0; k < static_cast<int>(rig.cameras.size()); ++k) {
    bearings.push_back(with_sigmas(k, azimuth, elevation));
  }
  return bearings;
}

omni::Rig vertical_pair(double baseline) {
  omni::Rig rig;
  for (const double side : {-0.5, 0.5}) {
    rig.cameras.push_back(camera_at({0.0, 0.0}, 0.0));
    rig.cameras.back().position.z() += side * baseline;
  }
  return rig;
}

// By hand. Far away a camera at c sees a point at ρ u under the azimuth φ − t/ρ, t = c × u, so that ∂φ/∂ρ = t/ρ² and
// across the ray ∂φ = 1/ρ. Over a triangle Σ t = 0: range and direction part, and Σ t² = 3 L²/2 in any direction, so
// that
//   var ρ = ρ⁴ σ²/(1.5 L²),   var of the direction = σ²/3
// up to terms of the order L/ρ, here 0.04 %.
TEST(PositionBound, TriangleFarAway) {
  const omni::Rig rig = paper_rig();
  constexpr double kRange = 500.0;
  for (const double azimuth_deg : {0.0, 17.0, 30.0, 90.0, 200.0}) {
    Vector3d point(0.0, 0.0, kHeight);
    point.head<2>() = kRange * direction(radians(azimuth_deg));
    const Matrix3d bound = position_bound(rig, point, with_sigmas(rig, kSigma, kNothing), 0.0, 0.0);
    const FloorSigma sigma = floor_sigma_of(bound, point);
    EXPECT_NEAR(sigma.distance, kRange * kRange * kSigma / (std::sqrt(1.5) * kL), 0.001 * sigma.distance);
    EXPECT_NEAR(sigma.direction, kSigma / std::sqrt(3.0), 0.001 * sigma.direction);
    EXPECT_NEAR(sigma.position, std::hypot(sigma.distance, kRange * sigma.direction), 1e-9);
  }
}

// By hand. Level with the pair's middle ∂e/∂ρ = ±(b/2)/ρ² and ∂e/∂z = 1/ρ: range and height part, and
//   var ρ = ρ⁴ σ²/(2 (b/2)²) = 2 ρ⁴ σ²/b².
TEST(PositionBound, VerticalPairFarAway) {
  constexpr double kRange = 20.0;
  constexpr double kBaseline = 0.3;
  const omni::Rig rig = vertical_pair(kBaseline);
  const Vector3d point(0.0, kRange, kHeight);
  const Matrix3d bound = position_bound(rig, point, with_sigmas(rig, kNothing, kSigma), 0.0, kFree);
  EXPECT_NEAR(std::sqrt(bound(1, 1)), std::sqrt(2.0) * kRange * kRange * kSigma / kBaseline, 1e-3 * kRange);
}

// So a vertical pair as long as a triangle's side, b = √3 L, has as much information about the range.
TEST(PositionBound, TriangleAndVerticalPairOfTheSameBaseline) {
  const Vector3d point(0.0, 500.0, kHeight);
  const omni::Rig triangle = paper_rig();
  const omni::Rig pair = vertical_pair(std::sqrt(3.0) * kL);
  const double by_azimuth = position_bound(triangle, point, with_sigmas(triangle, kSigma, kNothing), 0.0, 0.0)(1, 1);
  const double by_elevation = position_bound(pair, point, with_sigmas(pair, kNothing, kSigma), 0.0, kFree)(1, 1);
  EXPECT_NEAR(by_azimuth / by_elevation, 1.0, 0.002);
}

// By hand: at the horizontal distance r and h below, ∂e/∂r = h/D²; across the ray it is r σ.
TEST(PositionBound, OneCameraAndTheFloor) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0)};
  const double r = 1.2;
  const double h = kHeight - kBall;
  const Matrix3d bound = position_bound(rig, {0.0, r, kBall}, with_sigmas(rig, kSigma, 2.0 * kSigma), 0.0, 0.0);
  EXPECT_NEAR(bound(0, 0), std::pow(r * kSigma, 2), 1e-12);
  EXPECT_NEAR(std::sqrt(bound(1, 1)), (r * r + h * h) / h * 2.0 * kSigma, 1e-12);
  EXPECT_EQ(bound(2, 2), 0.0);
}

// By hand: sin γ = R/D, so that an error of γ is one of D by D/tan γ; across the ray it is D σ each.
TEST(PositionBound, OneCameraAndTheDiameter) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0)};
  const double distance = 0.5;
  Bearing bearing = with_sigmas(0, kSigma, kSigma);
  bearing.radius_variance = 4.0 * kSigma * kSigma;
  const Matrix3d bound = position_bound(rig, {0.0, distance, kHeight}, {bearing}, kRadius, kFree);
  const double tan_radius = kRadius / std::sqrt(distance * distance - kRadius * kRadius);
  EXPECT_NEAR(std::sqrt(bound(1, 1)), distance / tan_radius * 2.0 * kSigma, 1e-12);
  EXPECT_NEAR(std::sqrt(bound(0, 0)), distance * kSigma, 1e-12);
  EXPECT_NEAR(std::sqrt(bound(2, 2)), distance * kSigma, 1e-12);
}

Vector3d angles(const omni::Camera& camera, const Vector3d& point) {
  const Vector3d offset = point - camera.position;
  return {azimuth_of(offset.head<2>()), std::atan2(offset.z(), offset.head<2>().norm()),
          std::asin(kRadius / offset.norm())};
}

Eigen::Matrix<double, 9, 1> angles(const omni::Rig& rig, const Vector3d& point) {
  Eigen::Matrix<double, 9, 1> all;
  for (int k = 0; k < 3; ++k) all.segment<3>(3 * k) = angles(rig.cameras[k], point);
  return all;
}

Eigen::Matrix<double, 9, 3> angles_by_point(const omni::Rig& rig, const Vector3d& point) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 9, 3> rows;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = kStep * Vector3d::Unit(i);
    rows.col(i) = (angles(rig, point + step) - angles(rig, point - step)) / (2.0 * kStep);
  }
  return rows;
}

// Unlike each other, and correlated.
Matrix3d covariance_of(int camera) {
  Matrix3d covariance;
  covariance << 1.0, 0.3, -0.2, 0.3, 2.0, 0.5, -0.2, 0.5, 1.5;
  return covariance * 1e-8 * (1.0 + camera);
}

std::vector<Bearing> correlated_bearings() {
  std::vector<Bearing> bearings(3);
  for (int k = 0; k < 3; ++k) {
    const Matrix3d covariance = covariance_of(k);
    bearings[k].camera = k;
    bearings[k].covariance = covariance.topLeftCorner<2, 2>();
    bearings[k].radius_variance = covariance(2, 2);
    bearings[k].radius_covariance = covariance.block<2, 1>(0, 2);
  }
  return bearings;
}

Eigen::Matrix<double, 9, 9> joint_information() {
  Eigen::Matrix<double, 9, 9> information = Eigen::Matrix<double, 9, 9>::Zero();
  for (int k = 0; k < 3; ++k) information.block<3, 3>(3 * k, 3 * k) = covariance_of(k).inverse();
  return information;
}

TEST(PositionBound, IsThatOfTheNumericJacobian) {
  const omni::Rig rig = paper_rig();
  for (const Vector3d& point : {Vector3d(1.0, 0.3, 0.11), Vector3d(-3.0, 2.0, 0.6), Vector3d(0.1, -0.7, 0.11)}) {
    const auto rows = angles_by_point(rig, point);
    Matrix3d information = rows.transpose() * joint_information() * rows;
    const Matrix3d free = position_bound(rig, point, correlated_bearings(), kRadius, kFree);
    EXPECT_LT((free * information - Matrix3d::Identity()).norm(), 1e-5);
    information(2, 2) += 1.0 / (0.003 * 0.003);
    const Matrix3d floor = position_bound(rig, point, correlated_bearings(), kRadius, 0.003);
    EXPECT_LT((floor * information - Matrix3d::Identity()).norm(), 1e-5);
  }
}

// Gauss–Newton steps on noisy angles reach it: a maximum-likelihood estimator with little noise is efficient. The mean
// of N normalized squares χ²/3 scatters by √(2/(3 N)) = 0.0115, N = 5000.
TEST(PositionBound, IsReachedByMaximumLikelihood) {
  const omni::Rig rig = paper_rig();
  const auto information = joint_information();
  RandomStream stream = make_stream(1, 7);
  constexpr int kDraws = 5000;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const Vector3d truth(uniform(stream, 0.5, 2.0), uniform(stream, -2.0, 2.0), uniform(stream, 0.11, 0.8));
    Eigen::Matrix<double, 9, 1> measured = angles(rig, truth);
    for (int k = 0; k < 3; ++k) {
      const Matrix3d root = Eigen::LLT<Matrix3d>(covariance_of(k)).matrixL();
      measured.segment<3>(3 * k) += root * Vector3d(normal(stream, 1.0), normal(stream, 1.0), normal(stream, 1.0));
    }
    Vector3d point = truth + Vector3d(0.02, -0.02, 0.02);
    for (int step = 0; step < 5; ++step) {
      const auto rows = angles_by_point(rig, point);
      Eigen::Matrix<double, 9, 1> residual = measured - angles(rig, point);
      for (int k = 0; k < 3; ++k) residual[3 * k] = wrap_angle(residual[3 * k]);
      point += Matrix3d(rows.transpose() * information * rows)
                   .ldlt()
                   .solve(Vector3d(rows.transpose() * information * residual));
    }
    const Vector3d error = point - truth;
    const Matrix3d bound = position_bound(rig, truth, correlated_bearings(), kRadius, kFree);
    sum += error.dot(bound.ldlt().solve(error)) / 3.0;
  }
  EXPECT_NEAR(sum / kDraws, 1.0, 0.046);  // four sigma
}

TEST(PositionBound, FloorKnownExactlyIsTheLimit) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(1.0, 2.0, kBall);
  const auto bearings = with_sigmas(rig, kSigma, kSigma);
  const Matrix3d exact = position_bound(rig, point, bearings, 0.0, 0.0);
  EXPECT_LT((exact - position_bound(rig, point, bearings, 0.0, 1e-6)).norm(), 1e-6 * exact.norm());
  EXPECT_LT(exact(0, 0), position_bound(rig, point, bearings, 0.0, kFree)(0, 0));
}

// Infinite on the diagonal, zero beside it.
void expect_unobservable(const Matrix3d& bound) {
  EXPECT_FALSE(bound.allFinite());
  EXPECT_FALSE(bound.hasNaN());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_EQ(bound(i, j), i == j ? std::numeric_limits<double>::infinity() : 0.0);
  }
}

TEST(PositionBound, OneCameraWithoutTheFloor) {
  const omni::Rig rig = paper_rig();
  expect_unobservable(position_bound(rig, {1.0, 2.0, kBall}, {with_sigmas(1, kSigma, kSigma)}, 0.0, kFree));
}

TEST(PositionBound, NoBearings) {
  expect_unobservable(position_bound(paper_rig(), {1.0, 2.0, kBall}, {}, 0.0, kFree));
  expect_unobservable(position_bound(paper_rig(), {1.0, 2.0, kBall}, {}, 0.0, 0.0));
}

TEST(PositionBound, CamerasInOnePlace) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.1, 0.0}, 0.0), camera_at({0.1, 0.0}, 1.0)};
  expect_unobservable(position_bound(rig, {1.0, 2.0, kBall}, with_sigmas(rig, kSigma, kSigma), 0.0, kFree));
}

TEST(PositionBound, LevelWithOneCameraTheFloorTellsNoRange) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0)};
  expect_unobservable(position_bound(rig, {0.0, 1.0, kHeight}, with_sigmas(rig, kSigma, kSigma), 0.0, 0.0));
}

TEST(PositionBound, InfiniteVarianceTellsNothing) {
  const omni::Rig rig = paper_rig();
  auto bearings = with_sigmas(rig, kSigma, kSigma);
  const Matrix3d two = position_bound(rig, {1.0, 2.0, kBall}, {bearings[0], bearings[1]}, 0.0, kFree);
  bearings[2].covariance(0, 0) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(position_bound(rig, {1.0, 2.0, kBall}, bearings, 0.0, kFree), two);
}

TEST(PositionBound, StraightBelowACameraItHasNoAzimuth) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(rig.cameras[0].position.x(), rig.cameras[0].position.y(), 0.0);
  const auto bearings = with_sigmas(rig, kSigma, kSigma);
  EXPECT_EQ(position_bound(rig, point, bearings, 0.0, kFree),
            position_bound(rig, point, {bearings[1], bearings[2]}, 0.0, kFree));
}

TEST(PositionBound, BrokenPreconditions) {
  const omni::Rig rig = paper_rig();
  const auto bound = [&](const Bearing& bearing, double radius) {
    position_bound(rig, {1.0, 2.0, kBall}, {bearing}, radius, 0.0);
  };
  Bearing bearing = with_sigmas(3, kSigma, kSigma);
  expect_error([&] { bound(bearing, 0.0); }, {"camera number 3", "3 cameras"});
  expect_error([&] { bound(with_sigmas(0, kSigma, 0.0), 0.0); }, {"camera number 0", "not positive definite"});
  bearing = with_sigmas(0, kSigma, kSigma);
  bearing.radius_variance = 1e-6;
  expect_error([&] { bound(bearing, 0.0); }, {"radius is 0 m"});
}

}  // namespace
}  // namespace movis::triangulation
