#include "movis/control/robot_model.h"

#include <Eigen/SVD>
#include <cmath>

#include "movis/control/wheels.h"
#include "movis/core/angle.h"
#include "movis/core/yaml.h"

namespace movis::control {
namespace {

constexpr Range kLength{0.01, 2.0};
constexpr Range kRelativeSigma{0.0, 0.5};
constexpr Range kAnyAngle{-1e4, 1e4};  // degrees

Kicker read_kicker(const YamlMap& map, double robot_radius) {
  map.allow({"width", "reach", "speed", "speed_sigma", "direction_sigma_deg", "lift_deg"});
  Kicker kicker;
  kicker.width = map.number("width", kLength);
  if (kicker.width > 2.0 * robot_radius) map.fail("width", "is more than the robot's diameter");
  kicker.reach = map.number("reach", {0.001, 0.5});
  kicker.speed = map.number("speed", {0.1, 30.0});
  kicker.speed_sigma = map.number("speed_sigma", kRelativeSigma);
  kicker.direction_sigma = radians(map.number("direction_sigma_deg", {0.0, 30.0}));
  kicker.lift = radians(map.number("lift_deg", {0.0, 60.0}));
  return kicker;
}

MotionLimits read_limits(const YamlMap& map) {
  map.allow({"speed", "acceleration", "turn_rate", "turn_acceleration"});
  MotionLimits limits;
  limits.speed = map.number("speed", {0.01, 20.0});
  limits.acceleration = map.number("acceleration", {0.01, 100.0});
  limits.turn_rate = map.number("turn_rate", {0.01, 100.0});
  limits.turn_acceleration = map.number("turn_acceleration", {0.01, 1000.0});
  return limits;
}

// Whether the wheels drive any combination of vx, vy and ω. The distance is left out: it only chooses the unit of ω.
bool holonomic(OmniWheels wheels) {
  wheels.distance = wheels.radius = 1.0;
  const Eigen::VectorXd gains = Eigen::JacobiSVD<Eigen::MatrixXd>(rates_by_twist(wheels)).singularValues();
  return gains(2) > 1e-3 * gains(0);
}

OmniWheels read_wheels(const YamlMap& map) {
  map.allow({"azimuths_deg", "distance", "radius", "max_rate"});
  OmniWheels wheels;
  for (const double azimuth_deg : map.numbers("azimuths_deg", kAnyAngle)) {
    wheels.azimuths.push_back(wrap_angle(radians(azimuth_deg)));
  }
  if (wheels.azimuths.size() < 3) map.fail("azimuths_deg", "must name three wheels or more");
  wheels.distance = map.number("distance", kLength);
  wheels.radius = map.number("radius", {0.005, 0.5});
  wheels.max_rate = map.number("max_rate", {0.1, 1000.0});
  if (!holonomic(wheels)) {
    map.fail("azimuths_deg",
             "these wheels cannot drive in all directions; at least three must differ, not all on one "
             "line through the robot's centre");
  }
  return wheels;
}

}  // namespace

bool kicker_reaches(const RobotModel& robot, const Eigen::Vector2d& ball_in_robot, double ball_radius) {
  return ball_in_robot.y() > 0.0 && std::abs(ball_in_robot.x()) <= robot.kicker.width / 2.0 &&
         ball_in_robot.norm() - robot.radius - ball_radius <= robot.kicker.reach;
}

RobotModel read_robot(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow(
      {"radius", "height", "mass", "kicker", "limits", "wheels", "frame_rate", "latency_frames", "actuator_sigma"});
  RobotModel robot;
  robot.radius = map.number("radius", {0.02, 1.0});
  robot.height = map.number("height", kLength);
  robot.mass = map.number("mass", {0.1, 500.0});
  robot.kicker = read_kicker(map.map("kicker"), robot.radius);
  robot.limits = read_limits(map.map("limits"));
  if (map.has("wheels")) robot.wheels = read_wheels(map.map("wheels"));
  robot.frame_rate = map.number("frame_rate", {1.0, 1000.0});
  robot.latency_frames = map.integer("latency_frames", {0.0, 30.0});
  robot.actuator_sigma = map.number("actuator_sigma", kRelativeSigma);
  return robot;
}

}  // namespace movis::control
