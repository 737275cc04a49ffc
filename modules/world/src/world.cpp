#include "movis/world/world.h"

#include "movis/core/error.h"

namespace movis::world {
namespace {

constexpr Range kAge{0.0, 60.0};

}  // namespace

WorldOptions read_world_options(const YamlMap& map) {
  map.allow({"max_pose_age_s", "max_ball_age_s"});
  WorldOptions options;
  map.read_number("max_pose_age_s", kAge, options.max_pose_age_s);
  map.read_number("max_ball_age_s", kAge, options.max_ball_age_s);
  return options;
}

bool has_pose(const World& world, const WorldOptions& options) {
  return world.pose_age_s <= options.max_pose_age_s;
}

bool has_ball(const World& world, const WorldOptions& options) {
  return world.ball_age_s <= options.max_ball_age_s;
}

World carried(const World& world, double time_s, const Pose2& before_from_after) {
  const double seconds = time_s - world.time_s;
  if (!(seconds >= 0.0)) {
    throw Error("the world of time {} s cannot be carried back to {} s; give instants in the order of time",
                world.time_s, time_s);
  }
  return {time_s, world.world_from_robot * before_from_after, world.pose_age_s + seconds,
          inverse(before_from_after) * world.ball_in_robot, world.ball_age_s + seconds};
}

World updated(const World& world, double time_s, const Pose2& before_from_after, const Fix& fix,
              const PointEstimate& ball_in_robot) {
  World now = carried(world, time_s, before_from_after);
  if (fix.status == FixStatus::ok) {
    now.world_from_robot = fix.world_from_robot;
    now.pose_age_s = 0.0;
  }
  if (ball_in_robot.status == PointStatus::ok) {
    now.ball_in_robot = ball_in_robot.point.head<2>();
    now.ball_age_s = 0.0;
  }
  return now;
}

}  // namespace movis::world
