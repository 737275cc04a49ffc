#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "movis/control/controller.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/player.h"
#include "movis/report/episode_page.h"
#include "movis/sim/scenario.h"
#include "movis/sim/simulator.h"

namespace movis::experiments {

struct MatchOptions {
  std::string localizer{localization::kDefaultLocalizer};
  std::string triangulation = "pairs";  // joint gives up goals beside the robot more often, and then no pose comes
  pipeline::Options pipeline;
  std::function<void()> every_tick;  // called in every tick, if given; may throw to end the episode
};

// What controllers may know beforehand. Throws an Error where the scenario has no field, or one whose goals no ball can
// enter.
control::Task task_of(const sim::Scenario& scenario);

// One scenario, to be played by any controller from any seed: simulated cameras, the robot's eyes on them, and what
// happened. The controller sees the images' estimates alone; the truth goes into the record, beside them.
class Match {
 public:
  // Throws an Error as task_of() does, and where the scenario's rig or field cannot be used by the pipeline.
  Match(const sim::Scenario& scenario, const MatchOptions& options);

  // What controllers may know beforehand.
  const control::Task& task() const { return task_; }

  // Plays one episode from its start to its outcome and keeps the cameras' pictures every `view_interval_s` seconds (0:
  // none). The same seed and controller give the same record.
  report::Episode play(const std::string& contender, control::Controller& controller, std::uint64_t seed,
                       double view_interval_s = 0.0);

 private:
  report::EpisodeTick recorded(const control::Command& command, const control::Controller& controller) const;

  MatchOptions options_;
  control::Task task_;
  pipeline::Player player_;
  sim::Simulator simulator_;
  grab::FrameSet images_;
};

}  // namespace movis::experiments
