#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>

#include "movis/control/command.h"
#include "movis/control/robot_model.h"
#include "movis/core/random.h"
#include "movis/core/yaml.h"
#include "movis/sim/scene.h"

namespace movis::sim {

struct PhysicsOptions {
  double substep_s = 1.0 / 960.0;
  double ball_mass = 0.43;             // kg
  double rolling_deceleration = 0.35;  // m/s², of a rolling ball: μ_r g
  double ball_restitution = 0.6;       // against posts, walls, robots and the floor
  double contact_friction = 0.2;       // between hulls, Coulomb
};

PhysicsOptions read_physics_options(const YamlMap& map);

inline constexpr double kKickerRecharge = 0.5;  // seconds between two kicks

// The motion of robot and ball in an arena, in equal substeps.
//
// - The robot's velocity, in its own frame, follows the command within its limits (control::limited) and with relative
//   actuator noise, a draw for every step(). What a contact does to that velocity, the drive undoes within the limits.
// - The ball rolls straight and slows down evenly, so that from speed v it rolls v² / (2·rolling_deceleration). In the
//   air it is ballistic, and it bounces on the floor.
// - Contacts on the floor plane are Box2D's: restitution between the ball and anything, Coulomb friction between all
//   hulls. A ball that is higher than a robot, an obstacle, a wall or a goal does not touch it; should it come down on
//   one, it is pushed aside.
// - A kicked ball leaves along the robot's +y, scattered by the kicker's noise, with the kicker's speed and the robot's
//   own velocity in that direction. What the ball did before is forgotten.
//
// Runs are bit-identical for the same seed and calls.
class Physics {
 public:
  Physics(const Arena& arena, const control::RobotModel& robot, const PhysicsOptions& options, RandomStream random);
  ~Physics();
  Physics(Physics&&) noexcept;
  Physics& operator=(Physics&&) noexcept;

  // Robot and ball there, at rest, the kicker ready. Nothing else is left of the past but the draws from `random`.
  void place(const State& state);
  void set_ball_velocity(const Eigen::Vector3d& in_field);  // m/s

  // The next `seconds` under a command that acts now. With `kick` the kicker waits for the ball: it kicks, once a call
  // at most, as soon as the ball is on the floor within its reach and kKickerRecharge has passed since the last kick.
  // `over`, asked after every substep, ends the call early. Throws an Error for a velocity that is not finite.
  void step(const control::Command& command, double seconds, const std::function<bool(const State&)>& over = {});

  const State& state() const;
  Twist2 robot_velocity() const;          // robot frame
  Eigen::Vector3d ball_velocity() const;  // field frame, m/s
  int kicks() const;                      // that touched the ball, since place()

 private:
  struct Box;
  std::unique_ptr<Box> box_;
};

}  // namespace movis::sim
