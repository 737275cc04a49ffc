#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace movis {

// What a colour class stands for; the order is that of colours.yaml.
enum class ObjectClass : std::uint8_t { ball, yellow_goal, blue_goal, field, line, obstacle };
inline constexpr int kObjectClasses = 6;

const char* name(ObjectClass object);

// Why a bearing deserves less trust. Bits, to be combined.
enum BearingFlag : std::uint8_t {
  kCutByBody = 1,    // the object's image touches the own body: part of it is hidden
  kNearSensor = 2,   // its azimuths overlap those of another sensor unit, which may hide part of it
  kCutByDomain = 4,  // its image reaches the border of the mirror or of the picture
  kCutByObject = 8,  // something else stands before it (a ball before a goal, an obstacle)
};

// The direction in which one camera sees one object. Angles are of the ray in the robot's axes (tilt and yaw are
// already taken out) at the camera's viewpoint: azimuth from x (right) towards y (forward), elevation up from the
// horizontal plane.
struct Bearing {
  int camera = -1;  // index into the rig
  ObjectClass object = ObjectClass::ball;
  double azimuth = 0.0;
  double elevation = 0.0;
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // of (azimuth, elevation), rad²

  // A ball is seen under a circular cone: half its opening angle, radians, with its variance and its covariance with
  // (azimuth, elevation), rad². 0: not measured.
  double radius = 0.0;
  double radius_variance = 0.0;
  Eigen::Vector2d radius_covariance = Eigen::Vector2d::Zero();

  // The object's azimuthal extent; left is the larger azimuth, as the camera looks at it.
  double left = 0.0;
  double right = 0.0;
  double left_variance = 0.0;   // rad²
  double right_variance = 0.0;  // rad²

  double weight = 0.0;  // evidence: the sum of the pixels' memberships
  std::uint8_t flags = 0;
  std::uint8_t left_flags = 0;  // those that concern this edge of a goal; `flags` has them too
  std::uint8_t right_flags = 0;
  double time_s = 0.0;

  bool clean() const { return flags == 0; }
};

}  // namespace movis
