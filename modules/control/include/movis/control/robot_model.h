#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <vector>

namespace movis::control {

// What a robot can do, from robot.yaml.

struct MotionLimits {
  double speed = 0.0;              // m/s, in any direction
  double acceleration = 0.0;       // m/s², in any direction
  double turn_rate = 0.0;          // rad/s
  double turn_acceleration = 0.0;  // rad/s²
};

// Omnidirectional wheels. A wheel at azimuth α of the robot frame, at `distance` from its centre, drives along the
// tangent (−sin α, cos α).
struct OmniWheels {
  std::vector<double> azimuths;  // radians; three or more
  double distance = 0.0;         // metres from the robot's centre to each wheel's contact
  double radius = 0.0;           // metres
  double max_rate = 0.0;         // rad/s of the wheel
};

// The kicker faces +y. It reaches a ball whose centre is within ±width/2 in x and whose surface is at most `reach`
// before the robot's hull.
struct Kicker {
  double width = 0.0;            // metres
  double reach = 0.0;            // metres
  double speed = 0.0;            // m/s, of the ball
  double speed_sigma = 0.0;      // relative, one sigma
  double direction_sigma = 0.0;  // radians, one sigma
  double lift = 0.0;             // radians above the floor
};

struct RobotModel {
  double radius = 0.0;  // of the round hull, metres
  double height = 0.0;  // metres
  double mass = 0.0;    // kg
  Kicker kicker;
  MotionLimits limits;
  std::optional<OmniWheels> wheels;
  double frame_rate = 0.0;      // Hz, of images and commands
  int latency_frames = 0;       // from the images to the robot's motion
  double actuator_sigma = 0.0;  // relative error of each velocity component, one sigma

  double frame_period() const { return 1.0 / frame_rate; }
  double latency() const { return latency_frames / frame_rate; }  // seconds
};

// Whether the kicker reaches a ball. A ball that overlaps the hull, as an estimate may, is within reach.
bool kicker_reaches(const RobotModel& robot, const Eigen::Vector2d& ball_in_robot, double ball_radius);

// Reads robot.yaml strictly: an unknown or missing key, or a value out of range, is an Error naming file, line, key.
RobotModel read_robot(const std::filesystem::path& file);

}  // namespace movis::control
