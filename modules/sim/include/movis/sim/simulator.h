#pragma once

#include <cstdint>

#include "movis/control/robot.h"
#include "movis/grab/image_source.h"
#include "movis/sim/episode.h"
#include "movis/sim/renderer.h"

namespace movis::sim {

// A scenario as cameras and a robot: an Episode with a renderer. The first acquire() renders the beginning, each
// further one plays one frame period and renders what has become. The same scenario, seed and commands give the same
// images.
class Simulator : public grab::ImageSource, public control::Robot {
 public:
  Simulator(const Scenario& scenario, std::uint64_t seed);

  void restart(std::uint64_t seed);            // another episode of the scenario
  void open() override;                        // back to the beginning of the episode
  bool acquire(grab::FrameSet& set) override;  // false once there is an outcome
  void close() override {}
  void send(const control::Command& command) override { episode_.send(command); }

  // For judges and pages; never for what is judged.
  const State& truth() const { return episode_.truth(); }
  std::optional<Outcome> outcome() const { return episode_.outcome(); }
  int kicks() const { return episode_.kicks(); }

 private:
  std::uint64_t seed_;
  Episode episode_;
  Renderer renderer_;
  std::int64_t frame_ = 0;  // of the next acquire()
};

}  // namespace movis::sim
