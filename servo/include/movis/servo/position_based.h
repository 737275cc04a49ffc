#pragma once

#include <filesystem>
#include <memory>

#include "movis/control/controller.h"
#include "movis/control/percepts.h"

namespace movis::servo {

struct PbvsOptions {
  // λ of the control law, 1/s, as a function of x = ‖e‖∞ (metres and radians; the largest error counts, so that the
  // robot drives slowly while it has far to turn):
  //   λ(x) = (λ₀ − λ∞) exp(−λ′₀ x / (λ₀ − λ∞)) + λ∞
  double gain_at_zero = 0.0;      // λ₀
  double gain_at_infinity = 0.0;  // λ∞ < λ₀
  double gain_slope = 0.0;        // λ′₀ > 0: how fast λ falls at x = 0

  // The way round the ball (way_round.h).
  double gap = 0.0;  // between the hulls of robot and ball at the shooting place, metres; negative: the robot leans
                     // on the ball
  double clearance = 0.0;  // between the hulls on the way round, metres
  double lead = 0.0;       // radians
};

// Reads pbvs.yaml strictly. Every key must be there: the file is the only home of the values.
PbvsOptions read_pbvs_options(const std::filesystem::path& file);

// Position-based visual servoing of approach-and-shoot. What is servoed is the pose of the shot frame (origin under the
// ball, y axis towards the goal's centre, z up) in the robot frame. The robot's desired pose d has the y axis's heading
// and lies where way_round.h says, in the end right behind the ball. The features are those of d_from_robot,
//   s = (x, y, θ),  s* = 0:  translation in d's axes (vpFeatureTranslation) and heading (θu_z of vpFeatureThetaU).
// With R the rotation of d_from_robot, L = diag(R, 1), and v = −λ L⁻¹ s drives straight towards d however the robot is
// turned (F. Chaumette, S. Hutchinson, Visual servo control, part I, 2006, the second of its position-based schemes).
// That is what makes the way round the ball a statement about the floor; with the other scheme's features, the ball's
// position in the robot frame, the ball would move straight before the robot's eyes and the path would bend with each
// turn.
//
// A world that is not finite gives a command that is not finite, which control::Drive turns into a stop.
class PositionBased : public control::Controller {
 public:
  PositionBased(control::Task task, const PbvsOptions& options);
  ~PositionBased() override;

  void start() override;
  control::Command step(const control::Observation& observation) override;

  // e_x, e_y (m, in d's axes), e_theta and detour (°).
  const std::vector<control::Signal>& signals() const override { return signals_; }

 private:
  struct Servo;
  control::Task task_;
  PbvsOptions options_;
  std::unique_ptr<Servo> servo_;
  double detour_ = 0.0;  // of the last step, to stay on the side that was chosen
  std::vector<control::Signal> signals_;
};

}  // namespace movis::servo
