#pragma once

#include <cstdint>
#include <optional>

#include "movis/core/field.h"
#include "movis/sim/scene.h"

namespace movis::sim {

// How an episode ended.
enum class Outcome : std::uint8_t {
  goal,         // the whole ball crossed the yellow goal's line, between the posts and under the bar
  own_goal,     // the same at the blue goal
  ball_out,     // the whole ball left the field elsewhere
  robot_out,    // the robot's centre went more than a metre off the field
  out_of_time,  // the scenario's duration is over
};

const char* word(Outcome outcome);

// The outcome that a state means; nothing while the game goes on. Lines belong to the field: the ball is out beyond
// their outer edges. Behind a goal of little depth a ball rebounds before the next image: ask after every substep of
// the physics.
std::optional<Outcome> judge(const State& state, const Field& field, double duration_s);

// The part of it that needs no field.
bool time_is_over(const State& state, double duration_s);

}  // namespace movis::sim
