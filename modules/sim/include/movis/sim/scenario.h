#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "movis/control/robot_model.h"
#include "movis/core/random.h"
#include "movis/omni/rig.h"
#include "movis/sim/look.h"
#include "movis/sim/physics.h"
#include "movis/sim/scene.h"

namespace movis::sim {

// Random streams of an episode: make_stream(seed, purpose).
inline constexpr std::uint64_t kStartStream = 1;
inline constexpr std::uint64_t kPhysicsStream = 2;
inline constexpr std::uint64_t kImageStream = std::uint64_t{1} << 32;  // and the image's number added

// A situation to play, from scenario.yaml: everything but the seed. A start that is not given is drawn, evenly over the
// free places: the robot with its hull inside the lines and with any heading, the ball `margin` inside them, both
// `clearance` away from each other and everything else. Without a field, the robot starts at the origin unless told
// otherwise, and the ball must be given.
struct Scenario {
  std::string name;  // the file's, without its extension
  omni::Rig rig;
  Arena arena;
  control::RobotModel robot;
  Look look;
  PhysicsOptions physics;
  double duration_s = 20.0;
  std::optional<Pose2> robot_start;
  std::optional<Eigen::Vector2d> ball_start;
  double clearance = 0.10;  // metres, between drawn hulls, and from them to obstacles, goals and walls
  double margin = 0.45;     // metres, of a drawn ball's centre from the outer edges of the field's lines
};

// Reads scenario.yaml strictly. Files named in it are relative to it. Refuses by name a situation that cannot be: the
// ball inside the robot, two things at one place, something inside a goal's walls, a start after which the episode ends
// at once, a camera inside the robot or beside it.
Scenario read_scenario(const std::filesystem::path& file);

// The beginning of an episode. Throws an Error where no free place is found.
State draw_start(const Scenario& scenario, RandomStream& random);

}  // namespace movis::sim
