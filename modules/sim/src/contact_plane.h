#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "movis/control/robot_model.h"
#include "movis/sim/physics.h"
#include "movis/sim/scene.h"

namespace movis::sim {

// A round body of the floor plane, field frame.
struct Disc {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // metres
  double angle = 0.0;
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  // m/s
  double rate = 0.0;                                   // rad/s
};

// What Box2D is asked: which of robot, ball and standing things touch, and what that does to robot and ball. Its
// coordinates have single precision, so a body that touches nothing is not taken from it: 1e-7 of a position is more
// than a slow ball moves in a substep.
class ContactPlane {
 public:
  ContactPlane(const Arena& arena, const control::RobotModel& robot, const PhysicsOptions& options);
  ~ContactPlane();

  struct Touched {
    std::optional<Disc> robot, ball;  // after the step; nothing where the body touched nothing
  };

  // Both move with their velocities, which change only by contacts. The ball's lowest point is at `ball_bottom`: it
  // passes over what is lower.
  Touched step(const Disc& robot, const Disc& ball, double ball_bottom, double seconds);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

}  // namespace movis::sim
