#pragma once

#include <cstdint>
#include <string>

#include "movis/control/controller.h"
#include "movis/pipeline/player.h"
#include "movis/report/episode_page.h"
#include "movis/sim/scenario.h"
#include "movis/sim/simulator.h"

namespace movis::experiments {

struct MatchOptions {
  std::string localizer = "composed";
  pipeline::Options pipeline;
};

// One scenario, to be played by any controller from any seed: simulated cameras, the robot's eyes on them, and what
// happened. The controller sees the images' estimates alone; the truth goes into the record, beside them.
class Match {
 public:
  // Throws an Error where the scenario has no field: there would be no goal to shoot at.
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
  sim::Simulator simulator_;
  pipeline::Player player_;
  grab::FrameSet images_;
};

}  // namespace movis::experiments
