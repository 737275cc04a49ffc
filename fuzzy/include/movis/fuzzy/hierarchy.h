#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "movis/control/controller.h"
#include "movis/control/percepts.h"

namespace movis::fuzzy {

struct Situation;

// Multilayered fuzzy behaviour control (Maeda & Shimizuhira 2005, cited in section 1 of the paper): in the lower layer
// every element behaviour is a rule base whose conclusions are a velocity; in the higher layer a rule base concludes
// how much each behaviour counts. The command is the mean of the behaviours' velocities by these weights,
//   v = Σ w_b v_b / Σ w_b,
// and the kick follows control::should_kick. Where a rule base has no value, or all weights are 0, the robot stops.
//
// A file controller.yaml names the rule bases (fll.h), relative to itself:
//   selection: select.fll                              outputs: one weight in 0…1 for each behaviour, by its name
//   behaviours:
//   - {name: approach, rules: approach.fll}            outputs: toward, around, turn_rate_deg
//
// Inputs of both layers, by name (control/percepts.h; directions are from straight ahead, positive to the left):
//   ball_distance         from the robot's centre, m
//   ball_gap              between the hulls of robot and ball, m
//   ball_direction_deg
//   target_distance       to the centre of the goal, m
//   target_direction_deg
//   shot_direction_deg    of the line from the ball to the goal's centre
//   detour_deg            from the line robot → ball to the line ball → target; 0: the robot stands behind the ball.
//                         Positive: the goal lies to the left of the line of sight, so the way behind the ball leads
//                         round it to the right
//   post_gap              from the robot's hull to the nearest post of either goal, m
// Outputs of a behaviour, all three:
//   toward                m/s, to the ball
//   around                m/s, square to that, positive to the left
//   turn_rate_deg         °/s, positive to the left
// They are relative to the line of sight to the ball, so that rules for distance, for the way round and for the heading
// can be written one by one, and velocities of different behaviours can be averaged.
class Hierarchy : public control::Controller {
 public:
  // Reads strictly: beyond what fll.h refuses, an unknown input or output, an output that is missing, a behaviour
  // without a weight and a weight without a behaviour are Errors that name the file and list what is known.
  Hierarchy(const std::filesystem::path& file, control::Task task);
  ~Hierarchy() override;
  Hierarchy(Hierarchy&&) noexcept;
  Hierarchy& operator=(Hierarchy&&) noexcept;

  void start() override;
  control::Command step(const control::Observation& observation) override;

  // The behaviours' weights, as parts of 1 (all 0 where the robot stops), then detour, ball direction and gap.
  const std::vector<control::Signal>& signals() const override { return signals_; }

 private:
  struct Layers;
  Twist2 combined(const Situation& situation);

  control::Task task_;
  std::unique_ptr<Layers> layers_;
  std::vector<control::Signal> signals_;
};

}  // namespace movis::fuzzy
