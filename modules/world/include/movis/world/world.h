#pragma once

#include <Eigen/Core>
#include <limits>

#include "movis/core/pose.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"

// What the robot believes of the world, from all instants up to now. Every stage before this one is a function of one
// instant; only this one has memory.
namespace movis::world {

inline constexpr double kNever = std::numeric_limits<double>::infinity();

// The last pose and the last ball that were measured, carried along with the robot's own motion since. An age is the
// time since the measurement; kNever where there was none, and then the value means nothing. The ball is taken to rest
// on the floor between its measurements.
struct World {
  double time_s = 0.0;  // of which all this is believed
  Pose2 world_from_robot;
  double pose_age_s = kNever;
  Eigen::Vector2d ball_in_robot = Eigen::Vector2d::Zero();  // metres
  double ball_age_s = kNever;
};

struct WorldOptions {
  double max_pose_age_s = 0.5;  // an older pose is stale: no controller acts on it
  double max_ball_age_s = 0.5;
};

WorldOptions read_world_options(const YamlMap& map);

// Whether the estimate is fresh enough to act on, at the world's own time.
bool has_pose(const World& world, const WorldOptions& options);
bool has_ball(const World& world, const WorldOptions& options);

// The same beliefs at a later time, all of them older by the time between. `before_from_after` is the robot's motion
// between the two: where it stands after, in the frame in which it stood before, as start_from_end and
// CommandHistory::motion give it. Throws an Error where time runs backwards.
World carried(const World& world, double time_s, const Pose2& before_from_after);

// The beliefs after an instant's measurements, with the robot's motion since world.time_s. A measurement with a status
// other than ok changes nothing but the ages. Throws an Error where time runs backwards.
World updated(const World& world, double time_s, const Pose2& before_from_after, const Fix& fix,
              const PointEstimate& ball_in_robot);

}  // namespace movis::world
