// The error correction of bearings: its basis from what a camera can be off by, and what it does to a bearing.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "movis/triangulation/correction.h"
#include "movis_rig.h"
#include "support/allocations.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

// A correction of one camera with the given coefficients.
Correction correction_of(std::vector<double> azimuth, std::vector<double> elevation = {0.0}) {
  CameraCorrection camera;
  camera.camera = "M1";
  camera.azimuth = std::move(azimuth);
  camera.elevation = std::move(elevation);
  return {{camera}};
}

Bearing bearing_at(double azimuth, double elevation) {
  Bearing bearing;
  bearing.camera = 0;
  bearing.azimuth = azimuth;
  bearing.elevation = elevation;
  bearing.left = azimuth + 0.1;
  bearing.right = azimuth - 0.1;
  return bearing;
}

Bearing corrected(const Correction& correction, const Bearing& bearing) {
  std::vector<Bearing> bearings{bearing};
  correct(correction, bearings);
  return bearings.front();
}

Vector3d ray(double azimuth, double elevation) {
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth), std::sin(elevation)};
}

double elevation_of(const Vector3d& direction) {
  return std::atan2(direction.z(), direction.head<2>().norm());
}

// Expects that the correction turns each measured direction into the one that `truth` says, within `within` radians.
template <typename Truth>
void expect_directions(const Correction& correction, double within, Truth truth) {
  for (double azimuth = -3.0; azimuth < 3.1; azimuth += 0.5) {
    for (const double elevation : {-0.6, -0.2, -0.03}) {
      const Vector3d expected = truth(azimuth, elevation);
      const Bearing found = corrected(correction, bearing_at(azimuth, elevation));
      EXPECT_NEAR(turn(azimuth_of(expected.head<2>()), found.azimuth), 0.0, within) << azimuth << " " << elevation;
      EXPECT_NEAR(found.elevation, elevation_of(expected), within) << azimuth << " " << elevation;
    }
  }
}

// A camera whose yaw is 0.01 larger than the drawing says sees everything at 0.01 too little.
TEST(Correction, Yaw) {
  expect_directions(correction_of({0.01}), 1e-12,
                    [](double azimuth, double elevation) { return ray(azimuth + 0.01, elevation); });
}

// A camera that is turned by the small vector ω sees a thing at d that is at d + ω × d. By hand, with
// d = (cos e cos φ, cos e sin φ, sin e): Δφ = −tan e (ω_x cos φ + ω_y sin φ), Δe = ω_x sin φ − ω_y cos φ.
// What is left is of the order ω² tan² e ≈ 5e-9.
TEST(Correction, Tilt) {
  const Vector3d omega(1e-4, -5e-5, 0.0);
  const Correction correction = correction_of({0.0, 0.0, 0.0, -omega.x(), -omega.y()}, {0.0, -omega.y(), omega.x()});
  const Eigen::AngleAxisd turned(omega.norm(), omega.normalized());
  expect_directions(correction, 1e-8,
                    [&](double azimuth, double elevation) { return Vector3d(turned * ray(azimuth, elevation)); });
}

// A viewpoint that is off by t: a ball whose centre lies h below it is seen from t + c instead of c, h/tan(−e) away.
// From c it is at s d + t with s = −h/tan e, so Δφ = (t × d)'s length over s with its sign, (t_y cos φ − t_x sin φ)/s =
// tan e (t_x sin φ − t_y cos φ)/h; the slope −h/s becomes −(h − t_z)/(s + t·d), and by d tan e = de/cos² e
// Δe = sin² e (t·d)/h − sin e cos e t_z/h; sin e cos e = sin e up to e³/2.
TEST(Correction, Viewpoint) {
  const Vector3d t(2e-5, -1e-5, 0.0);
  constexpr double h = 0.14;
  const Correction correction = correction_of({0.0, 0.0, 0.0, -t.y() / h, t.x() / h},
                                              {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, t.x() / h, t.y() / h});
  expect_directions(correction, 1e-7, [&](double azimuth, double elevation) {
    const double range = h / std::sin(-elevation);
    return Vector3d(range * ray(azimuth, elevation) + t);
  });
}

// A principal point that is off by p: a picture of radius ρ = F cos e/(ξ − sin e) (unified sphere) is moved by p, so
// what is seen at ρ d stands at ρ d − p: Δφ = −(p × d turned)/ρ = (p_x sin φ − p_y cos φ)(ξ sec e − tan e)/F. Azimuth
// only: the elevation's basis takes 1/ρ' for linear in sin e.
TEST(Correction, PrincipalPointInAzimuth) {
  constexpr double F = 170.0, xi = 0.97;
  const Vector2d p(0.01, 0.02);  // pixels
  const Correction correction = correction_of({0.0, -p.y() * xi / F, p.x() * xi / F, p.y() / F, -p.x() / F});
  for (double azimuth = -3.0; azimuth < 3.1; azimuth += 0.5) {
    for (const double elevation : {-0.6, -0.2, -0.03}) {
      const double radius = F * std::cos(elevation) / (xi - std::sin(elevation));
      const Vector2d there = radius * direction(azimuth) - p;
      const Bearing found = corrected(correction, bearing_at(azimuth, elevation));
      EXPECT_NEAR(turn(azimuth_of(there), found.azimuth), 0.0, 1e-7);  // (p/ρ)² = 2e-8
    }
  }
}

// By hand: seen under azimuth 0 and the elevation of the floor 1.0 m away, the direction is turned by 0.02 rad and raised
// by 0.01 rad, to the floor h/tan(atan(h/1.0 m) − 0.01) away. A radian of elevation is (h² + r²)/h = 4.25 m.
TEST(Correction, LinePointsOnTheFloor) {
  constexpr double kHigh = 0.25;
  Correction correction = correction_of({0.02}, {0.01});
  correction.cameras[0].position = {0.1, 0.2, kHigh};
  correction.cameras[0].elevation_sigma = 0.003;
  LinePoint line;
  line.camera = 0;
  line.elevation = -std::atan(kHigh);
  line.sigma = 0.004;
  line.sigma_on_floor = 0.017;  // 4.25 m · 0.004
  std::vector<LinePoint> lines{line};
  correct(correction, lines);
  const double distance = kHigh / std::tan(std::atan(kHigh) - 0.01);
  EXPECT_NEAR(lines[0].azimuth, 0.02, 1e-12);
  EXPECT_NEAR(lines[0].point.x(), 0.1 + distance * std::cos(0.02), 1e-9);
  EXPECT_NEAR(lines[0].point.y(), 0.2 + distance * std::sin(0.02), 1e-9);
  EXPECT_NEAR(lines[0].sigma, 0.005, 1e-9);  // 3-4-5
  EXPECT_NEAR(lines[0].sigma_on_floor, 4.25 * 0.005, 1e-9);

  std::vector<ObstacleSight> sights{{0, 0.1, -0.1, 1.0, 0.02}};
  correct(correction, sights);
  EXPECT_NEAR(sights[0].left, 0.12, 1e-12);
  EXPECT_NEAR(sights[0].right, -0.08, 1e-12);
  EXPECT_NEAR(sights[0].distance, distance, 1e-9);
  EXPECT_GT(sights[0].sigma, 0.02);
}

// 0.02 sec e cos φ at e = 0: +0.02 at φ = 0, nothing at φ = ±π/2. An object from −π/2 to π/2 keeps its edges.
TEST(Correction, EdgesAtTheirOwnAzimuths) {
  Bearing bearing = bearing_at(0.0, 0.0);
  bearing.left = kPi / 2.0;
  bearing.right = -kPi / 2.0;
  const Bearing found = corrected(correction_of({0.0, 0.02, 0.0}), bearing);
  EXPECT_NEAR(found.azimuth, 0.02, 1e-12);
  EXPECT_NEAR(found.left, kPi / 2.0, 1e-12);
  EXPECT_NEAR(found.right, -kPi / 2.0, 1e-12);
}

TEST(Correction, AnglesWrap) {
  const Bearing found = corrected(correction_of({0.1}), bearing_at(kPi - 0.05, 0.0));
  EXPECT_NEAR(found.azimuth, -kPi + 0.05, 1e-12);
  EXPECT_NEAR(found.left, -kPi + 0.15, 1e-12);
  EXPECT_NEAR(found.right, kPi - 0.05, 1e-12);
}

TEST(Correction, AddsWhatTheFitLeaves) {
  Correction correction = correction_of({0.0});
  correction.cameras[0].azimuth_sigma = 3e-4;
  correction.cameras[0].elevation_sigma = 4e-4;
  Bearing bearing = bearing_at(1.0, -0.1);
  bearing.covariance << 1e-8, 2e-9, 2e-9, 3e-8;
  bearing.left_variance = 5e-8;
  bearing.right_variance = 6e-8;
  const Bearing found = corrected(correction, bearing);
  EXPECT_NEAR(found.covariance(0, 0), 1e-8 + 9e-8, 1e-16);
  EXPECT_NEAR(found.covariance(1, 1), 3e-8 + 16e-8, 1e-16);
  EXPECT_EQ(found.covariance(0, 1), 2e-9);
  EXPECT_NEAR(found.left_variance, 5e-8 + 9e-8, 1e-16);
  EXPECT_NEAR(found.right_variance, 6e-8 + 9e-8, 1e-16);
}

// Δe = 0.1 sin e, fitted from −0.3 to −0.1. Outside it is that of the border, and a sigma of 1° a unit of tan e is
// added: at e = +0.1 that is 2 tan 0.1 degrees.
TEST(Correction, HoldsBeyondItsElevations) {
  Correction correction = correction_of({0.0}, {0.0, 0.0, 0.0, 0.1, 0.0, 0.0});
  correction.cameras[0].min_elevation = -0.3;
  correction.cameras[0].max_elevation = -0.1;
  const Bearing above = corrected(correction, bearing_at(0.5, 0.1));
  EXPECT_NEAR(above.elevation, 0.1 - 0.1 * std::sin(0.1), 1e-12);
  const double variance = std::pow(2.0 * std::tan(0.1) * kPi / 180.0, 2);
  EXPECT_NEAR(above.covariance(0, 0), variance, 1e-15);
  EXPECT_NEAR(above.covariance(1, 1), variance, 1e-15);
  EXPECT_NEAR(above.left_variance, variance, 1e-15);
  const Bearing below = corrected(correction, bearing_at(0.5, -0.5));
  EXPECT_NEAR(below.elevation, -0.5 - 0.1 * std::sin(0.3), 1e-12);
  EXPECT_NEAR(below.covariance(0, 0), std::pow((std::tan(0.5) - std::tan(0.3)) * kPi / 180.0, 2), 1e-15);
  const Bearing inside = corrected(correction, bearing_at(0.5, -0.2));
  EXPECT_NEAR(inside.elevation, -0.2 - 0.1 * std::sin(0.2), 1e-12);
  EXPECT_EQ(inside.covariance(1, 1), 0.0);
}

// Δφ = 0.02 sec e sin φ stretches the neighbourhood of φ = 0, e = 0 by 1.02 along the azimuth.
TEST(Correction, ScalesTheRadius) {
  Bearing bearing = bearing_at(0.0, 0.0);
  bearing.radius = 0.05;
  bearing.radius_variance = 1e-8;
  bearing.radius_covariance = {1e-9, 2e-9};
  Correction correction = correction_of({0.0, 0.0, 0.02});
  const Bearing found = corrected(correction, bearing);
  EXPECT_NEAR(found.radius, 0.05 * 1.02, 1e-9);
  EXPECT_NEAR(found.radius_variance, 1e-8 * 1.02 * 1.02, 1e-14);
  EXPECT_NEAR(found.radius_covariance.x(), 1.02e-9, 1e-15);
  correction.cameras[0].azimuth_sigma = 0.001;  // of the scale: 0.001 · 0.051
  EXPECT_NEAR(corrected(correction, bearing).radius_variance, 1e-8 * 1.02 * 1.02 + 0.051 * 0.051 * 1e-6, 1e-14);
  EXPECT_EQ(corrected(correction_of({0.0, 0.0, 0.02}), bearing_at(0.0, 0.0)).radius, 0.0);  // not measured
}

// A camera that is turned sees a ball as large as before. By hand: ∂Δφ/∂φ = tan e (ω_x sin φ − ω_y cos φ) = tan e Δe.
TEST(Correction, TiltKeepsTheRadius) {
  constexpr double x = 0.004, y = -0.002;
  const Correction correction = correction_of({0.0, 0.0, 0.0, -x, -y}, {0.0, -y, x});
  for (const double azimuth : {-2.0, 0.3, 1.4}) {
    Bearing bearing = bearing_at(azimuth, -0.5);
    bearing.radius = 0.2;
    EXPECT_NEAR(corrected(correction, bearing).radius, 0.2, 1e-9);
  }
}

// From the viewpoint c + t a ball on the floor, h below, appears under sin γ' = R/|s d|, from c under R/|s d + t|.
// s = 0.14/sin 0.4 = 0.36 m; t of 0.1 mm is 3e-4 of it, so that second order is below 1e-7; γ for tan γ, of the 5e-4 by
// which they differ, is another 1e-9.
TEST(Correction, ViewpointScalesTheRadiusByTheDistance) {
  constexpr double h = 0.14, e = -0.4, R = 0.02;
  const Vector3d t(8e-5, -6e-5, 0.0);
  const Correction correction = correction_of({0.0, 0.0, 0.0, -t.y() / h, t.x() / h},
                                              {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, t.x() / h, t.y() / h});
  for (const double azimuth : {-2.0, 0.3, 1.4}) {
    const Vector3d offset = h / std::sin(-e) * ray(azimuth, e);
    Bearing bearing = bearing_at(azimuth, e);
    bearing.radius = std::asin(R / offset.norm());
    const double expected = std::asin(R / (offset + t).norm());
    EXPECT_GT(std::abs(expected - bearing.radius), 1e-6);
    EXPECT_NEAR(corrected(correction, bearing).radius, expected, 1e-7);
  }
}

TEST(Correction, NoCamerasNothingHappens) {
  const Bearing found = corrected({}, bearing_at(1.0, -0.1));
  EXPECT_EQ(found.azimuth, 1.0);
  EXPECT_EQ(found.elevation, -0.1);
  EXPECT_EQ(found.left, 1.1);
}

TEST(Correction, UnknownCameraThrows) {
  Bearing bearing = bearing_at(1.0, -0.1);
  bearing.camera = 1;
  test::expect_error([&] { corrected(correction_of({0.0}), bearing); }, {"camera number 1", "1 cameras"});
}

#ifdef MOVIS_COUNTS_ALLOCATIONS
TEST(Correction, AllocatesNothing) {
  Correction correction = correction_of({1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3},
                                        {1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3});
  correction.cameras[0].max_elevation = -0.2;
  std::vector<Bearing> bearings(9, bearing_at(0.3, -0.1));
  bearings[0].radius = 0.1;
  EXPECT_EQ(test::allocations_in([&] { correct(correction, bearings); }), 0);
  EXPECT_NE(bearings[8].azimuth, 0.3);
}
#endif

}  // namespace
}  // namespace movis::triangulation
