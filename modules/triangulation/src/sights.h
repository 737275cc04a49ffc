#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/omni/rig.h"
#include "movis/triangulation/joint.h"

// Least squares over the cameras that see one object (joint.h has the equations).
namespace movis::triangulation {

inline constexpr int kMostCameras = 8;

// Throws where the rig cannot be used.
void require_joint_rig(const omni::Rig& rig);

// The bearing's camera; throws where the rig has none of that number.
const omni::Camera& camera_of(const omni::Rig& rig, const Bearing& bearing);

// One camera's bearing, prepared for many steps.
struct Sight {
  const Bearing* bearing = nullptr;
  Eigen::Vector3d position;
  double cos_azimuth, sin_azimuth, cos_elevation, sin_elevation;
  double cos_radius, sin_radius;  // where the radius is measured
  bool has_radius = false;
  Eigen::Matrix3d whitener;  // U, upper triangular, UᵀU = Σ⁻¹ of (azimuth, elevation, radius)
};

// One sight a camera, in a fixed place.
struct Sights {
  std::array<Sight, kMostCameras> sight;
  int count = 0;
};

Sights sights_of(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                 const JointOptions& options);

// How to read them: which cameras take part (bits, by place) and whether the object lies on the floor.
struct Reading {
  unsigned cameras = 0;
  bool on_floor = false;

  bool takes(int place) const { return (cameras >> place & 1U) != 0; }
};

struct JointSolution {
  PointStatus status = PointStatus::not_seen;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double chi2 = 0.0;
  int dof = 0;
  double largest_residual = 0.0;  // of an azimuth or an elevation, radians
  double floor_score = 0.0;       // by how many of its sigmas the bearings' height is above that of the floor
};

JointSolution solve(const Sights& sights, const Reading& reading, const JointOptions& options);

}  // namespace movis::triangulation
