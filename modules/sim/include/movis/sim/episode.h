#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "movis/control/command.h"
#include "movis/sim/physics.h"
#include "movis/sim/referee.h"
#include "movis/sim/scenario.h"

namespace movis::sim {

// A scenario played, without eyes: physics, latency and referee. Simulator adds the images.
//
// A command acts `latency_frames` frame periods after the instant it is sent at, and holds until the next one acts. Of
// several commands of one frame the last counts; a frame without one repeats the last. Without a field there is no
// referee, only the clock.
class Episode {
 public:
  Episode(const Scenario& scenario, std::uint64_t seed);

  void restart();                    // the same episode from its beginning
  void restart(std::uint64_t seed);  // another one of the same scenario
  // Throws an Error for a velocity that is not finite; the command is then to stand still.
  void send(const control::Command& command);
  bool advance();  // by one frame period, or to the outcome; false once there is one

  const State& truth() const { return physics_.state(); }
  std::optional<Outcome> outcome() const { return outcome_; }
  int kicks() const { return physics_.kicks(); }

 private:
  std::optional<Outcome> judged(const State& state) const;

  Scenario scenario_;
  std::uint64_t seed_;
  Physics physics_;
  control::Command sent_;                 // lately
  std::deque<control::Command> waiting_;  // one a frame of latency; the front acts next
  std::optional<Outcome> outcome_;
};

}  // namespace movis::sim
