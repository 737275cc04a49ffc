#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "movis/core/angle.h"
#include "movis/core/bearing.h"
#include "movis/core/line_point.h"
#include "movis/core/obstacle.h"
#include "movis/omni/rig.h"

namespace movis::triangulation {

// The paper's error correction (§3): Δazimuth and Δelevation of each camera as smooth functions of the measured azimuth
// φ and elevation e. With them a rig's bearings, made with the drawing of the rig, become those of a rig that is as it
// was drawn.
//
// The basis follows from what a camera can be off by, to first order (nominal minus built is absorbed in the signs):
//   yaw δ              Δφ = δ
//   tilt (ω_x, ω_y)    δd = ω × d of the unit ray d:
//                      Δφ = −tan e (ω_x cos φ + ω_y sin φ),   Δe = ω_x sin φ − ω_y cos φ
//   principal point p  an image radius ρ = F cos e/(ξ − sin e) (unified sphere, hyperboloid.h), shifted by p:
//                      Δφ = (p × d)/ρ,   1/ρ = (ξ sec e − tan e)/F
//                      Δe = (p·d)/ρ',   1/ρ' = (ξ − sin e)²/(F (1 − ξ sin e)), for ξ near 1 linear in sin e
//   focal length       Δe = Δf/f · ρ/ρ' = Δf/f · cos e (ξ − sin e)/(1 − ξ sin e), nearly Δf/f · cos e
//   viewpoint t        what stands h below the viewpoint (a ball on the floor) is −h/tan e away:
//                      Δφ = (t × d) tan e/h,   Δe = (t·d) sin² e/h − t_z sin e cos e/h
// (× and · in the floor plane.) Products of two of them, (0.01 rad)² a piece, bring second harmonics: left out, they
// leave 0.008° in azimuth for individual differences as in omni/deviation.h, with them 0.0005°. So
//   Δφ = Σ a_i · {1, sec e cos φ, sec e sin φ, tan e cos φ, tan e sin φ,
//                 sec e cos 2φ, sec e sin 2φ, tan e cos 2φ, tan e sin 2φ}
//   Δe = Σ b_i · {1, cos φ, sin φ, sin e, sin e cos φ, sin e sin φ,
//                 cos 2φ, sin 2φ, sin² e, sin² e cos φ, sin² e sin φ}
// cut off after one of the orders below.
//
// Domain: the elevations that it was fitted to. Outside, it is that of the nearest of them, and a standard deviation of
// 1° a unit of tan e is added: about what 2 mm over h, 1.5 px and 0.25° make of it. So the correction of what is nearer
// than the nearest ball that it was fitted to is rough. Since the viewpoint's share goes with 1/h, what stands higher is
// corrected rightly only when it is far away. A correction belongs to the rig that the bearings are made with.
//
// A ball's angular radius γ scales as its azimuthal extent does, cos e dφ:   γ' = γ (1 + ∂Δφ/∂φ − tan e Δe)
// That is exact to first order for a turned camera (1), for a lens, whose picture is nearly conformal, and for a
// viewpoint: there it is 1 + (t·d) sin e cos e/h, as γ goes with 1/distance. ∂Δe/∂e would not do: it is that of balls at
// other distances. The scale's sigma is that of the azimuth.
inline constexpr int kMostCoefficients = 11;
inline constexpr std::array<int, 5> kAzimuthOrders{1, 3, 5, 7, 9};
inline constexpr std::array<int, 5> kElevationOrders{1, 3, 6, 8, 11};

// All terms; those beyond the largest order are zero.
using CorrectionBasis = Eigen::Matrix<double, kMostCoefficients, 1>;
CorrectionBasis azimuth_basis(double azimuth, double elevation);
CorrectionBasis elevation_basis(double azimuth, double elevation);

struct CameraCorrection {
  std::string camera;
  std::vector<double> azimuth;    // coefficients, radians; one of kAzimuthOrders
  std::vector<double> elevation;  // coefficients, radians; one of kElevationOrders
  double azimuth_sigma = 0.0;     // of what the functions leave, radians; added to the bearings' covariance
  double elevation_sigma = 0.0;
  double min_elevation = radians(-85.0), max_elevation = radians(85.0);  // that it was fitted to

  // Of the camera in the rig that the bearings were made with: the correction serves no other.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw = 0.0, tilt_x = 0.0, tilt_y = 0.0;
  std::string lens;  // lens_digest
};

// Of a camera's model, its parameters to nine digits, and its picture's size: tells lenses from each other.
std::string lens_digest(const omni::Camera& camera);

struct Correction {
  std::vector<CameraCorrection> cameras;  // in the rig's order; none: nothing is corrected
};

// Strict: every camera of the rig must be there by name, in any order, and no other, and stand where it stands in
// `rig`, with the same lens. Refused, when written too, is what corrects by more than 10° anywhere in its elevations,
// which no individual difference needs.
Correction read_correction(const std::filesystem::path& file, const omni::Rig& rig);
void write_correction(const Correction& correction, const std::filesystem::path& file);

// Corrects azimuth, elevation and both edges (each at its own azimuth) of every bearing, scales a ball's angular radius
// as above, and adds the variances of what the correction leaves. Allocates nothing. A bearing of
// a camera that the correction has not throws.
void correct(const Correction& correction, std::vector<Bearing>& bearings);

// The same for line points, whose places on the floor are worked out anew, and for obstacles' azimuths and distances.
// Directions that would not meet the floor any more are taken to meet it at the greatest distance, 20 m. The variances
// of what is left are added to those across a line and along the sight, the larger of azimuth's and elevation's: they
// are not known to lie one way or the other.
void correct(const Correction& correction, std::vector<LinePoint>& lines);
void correct(const Correction& correction, std::vector<ObstacleSight>& sights);

}  // namespace movis::triangulation
