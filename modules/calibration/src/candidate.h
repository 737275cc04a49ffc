#pragma once

#include <Eigen/Core>
#include <optional>

#include "movis/core/bearing.h"
#include "movis/omni/deviation.h"

// What a camera that differs from its drawing makes of a pixel.
namespace movis::calibration {

struct Direction {
  double azimuth = 0.0;  // in the robot's axes, radians
  double elevation = 0.0;
};

Direction direction_of(const Eigen::Vector3d& ray_in_robot);

// The drawing of a camera for the optimization: without name and mask, and with a wider domain, as a candidate's may
// lie differently.
omni::Camera bare(const omni::Camera& camera);

// The drawing with deviations given in units of their prior's sigma.
omni::Camera candidate(const omni::Camera& drawing, const omni::Deviation& sigma, const double* deviation);

// The pixel of a direction that was found with the rig that was believed; nothing outside the camera's domain.
std::optional<Eigen::Vector2d> pixel_of(const omni::Camera& believed, const Direction& direction);

// The direction in which a camera sees a pixel.
std::optional<Direction> direction_of(const omni::Camera& camera, const Eigen::Vector2d& pixel);

}  // namespace movis::calibration
