#include "movis/sim/episode.h"

#include <cmath>

#include "movis/core/error.h"

namespace movis::sim {
namespace {

// Physics of its own stream: the draws for the start do not shift it.
Physics physics_of(const Scenario& scenario, std::uint64_t seed) {
  return {scenario.arena, scenario.robot, scenario.physics, make_stream(seed, kPhysicsStream)};
}

}  // namespace

Episode::Episode(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario), seed_(seed), physics_(physics_of(scenario, seed)) {
  restart();
}

void Episode::restart() {
  RandomStream random = make_stream(seed_, kStartStream);
  physics_ = physics_of(scenario_, seed_);
  physics_.place(draw_start(scenario_, random));
  sent_ = {};
  waiting_.assign(static_cast<std::size_t>(scenario_.robot.latency_frames), {});
  outcome_.reset();
}

void Episode::restart(std::uint64_t seed) {
  seed_ = seed;
  restart();
}

void Episode::send(const control::Command& command) {
  const Twist2& velocity = command.velocity;
  if (!std::isfinite(velocity.vx) || !std::isfinite(velocity.vy) || !std::isfinite(velocity.omega)) {
    sent_ = {};
    throw Error("the robot was sent a velocity that is not finite ({}, {}, {}) and stops; mend what computed it",
                velocity.vx, velocity.vy, velocity.omega);
  }
  sent_ = command;
}

std::optional<Outcome> Episode::judged(const State& state) const {
  if (scenario_.arena.field) return judge(state, *scenario_.arena.field, scenario_.duration_s);
  return time_is_over(state, scenario_.duration_s) ? std::optional(Outcome::out_of_time) : std::nullopt;
}

bool Episode::advance() {
  if (outcome_) return false;
  waiting_.push_back(sent_);
  const control::Command acting = waiting_.front();
  waiting_.pop_front();
  physics_.step(acting, scenario_.robot.frame_period(), [this](const State& state) {
    outcome_ = judged(state);
    return outcome_.has_value();
  });
  return !outcome_;
}

}  // namespace movis::sim
