#include "movis/sim/scenario.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "movis/core/yaml.h"
#include "movis/sim/referee.h"
#include "panels.h"
#include "placement.h"

namespace movis::sim {
namespace {

constexpr Range kPosition{-100.0, 100.0};  // metres
constexpr Range kPositionOrDegrees{-3600.0, 3600.0};
constexpr Range kHeight{0.01, 10.0};
constexpr double kTouching = -1e-6;  // metres; hulls that touch are no closer than this

std::filesystem::path named_file(const YamlMap& map, const char* key) {
  std::filesystem::path file = map.file().parent_path() / map.text(key);
  if (!std::filesystem::exists(file)) {
    map.fail(key,
             fmt::format("names {}, which does not exist; paths are relative to the scenario's folder", file.string()));
  }
  return file;
}

Wall read_wall(const YamlMap& map, const std::optional<Field>& field) {
  map.allow({"distance", "height"});
  if (!field) map.fail("is around a field, and there is none; name a field or remove the wall");
  Wall wall;
  map.read_number("distance", {0.0, 100.0}, wall.distance);
  map.read_number("height", kHeight, wall.height);
  const double goals_end = field->Fd + field->goal_depth + kBackPanel / 2.0 - field->half_length;
  if (wall.distance < goals_end) {
    map.fail("distance", fmt::format("is {} m, which puts the wall into the goals; they end {:.3f} m behind the lines",
                                     wall.distance, goals_end));
  }
  return wall;
}

Obstacle read_obstacle(const YamlMap& map) {
  map.allow({"position", "radius", "height", "band", "band_heights"});
  Obstacle obstacle;
  const std::vector<double> position = map.numbers("position", 2, kPosition);
  obstacle.position = {position[0], position[1]};
  map.read_number("radius", {0.01, 5.0}, obstacle.radius);
  map.read_number("height", kHeight, obstacle.height);
  if (map.has("band")) {
    const std::string band = map.one_of("band", {"none", "cyan", "magenta"});
    if (band == "cyan") obstacle.band = Obstacle::Band::cyan;
    if (band == "magenta") obstacle.band = Obstacle::Band::magenta;
  }
  if (obstacle.band == Obstacle::Band::none) {
    if (map.has("band_heights")) map.fail("band_heights", "stands without a band; add `band: cyan` or `band: magenta`");
    return obstacle;
  }
  if (map.has("band_heights")) {
    const std::vector<double> heights = map.numbers("band_heights", 2, {0.0, kHeight.max});
    obstacle.band_bottom = heights[0];
    obstacle.band_top = heights[1];
  }
  if (obstacle.band_bottom >= obstacle.band_top || obstacle.band_top > obstacle.height) {
    map.fail(map.has("band_heights") ? "band_heights" : "band",
             fmt::format("goes from {} to {} m; it must go upwards and end below the obstacle's height of {} m",
                         obstacle.band_bottom, obstacle.band_top, obstacle.height));
  }
  return obstacle;
}

// One after the other, so that each is checked against those before it.
void read_obstacles(const YamlMap& map, Arena& arena) {
  for (const YamlMap& entry : map.list_of_maps("obstacles")) {
    const Obstacle obstacle = read_obstacle(entry);
    const std::string what = in_the_way(arena, obstacle.position, obstacle.radius, kTouching);
    if (!what.empty()) entry.fail("position", fmt::format("lets the obstacle overlap {}; move one of them", what));
    arena.obstacles.push_back(obstacle);
  }
}

void check_rig(const YamlMap& map, const omni::Rig& rig, const control::RobotModel& robot) {
  for (const omni::Camera& camera : rig.cameras) {
    const double height = camera.position.z();
    const double aside = camera.position.head<2>().norm();
    if (height <= 0.0) {
      map.fail("rig", fmt::format("puts camera {} under the floor; heights are positive", camera.name));
    }
    if (aside > robot.radius) {
      map.fail("rig",
               fmt::format("puts camera {} {:.3f} m from the robot's axis, beside its hull of radius {} m; name the "
                           "robot that carries this rig",
                           camera.name, aside, robot.radius));
    }
    if (height < robot.height) {
      map.fail("rig",
               fmt::format("puts camera {} inside the robot's hull, {} m above the floor; the hull ends at {} m. "
                           "Raise the camera, or name the robot that carries this rig",
                           camera.name, height, robot.height));
    }
  }
}

// The hall holds everything, and the renderer paints all of its floor.
void check_hall(const YamlMap& map, const Scenario& scenario) {
  constexpr double kAround = 1.0;         // metres beyond the lines that a robot may go, see judge()
  constexpr double kLargestField = 30.0;  // metres, half of it
  const double half_width = scenario.look.hall_half_width;
  if (scenario.arena.field) {
    const Field& field = *scenario.arena.field;
    const double longest = std::max({field.half_width, field.half_length, field.Fd + field.goal_depth});
    if (longest > kLargestField) {
      map.fail("field",
               fmt::format("is {} m long from its centre; at most {} m are simulated", longest, kLargestField));
    }
    const double needed = longest + kAround + scenario.robot.radius;
    if (needed > half_width) {
      map.fail("look", fmt::format("puts the walls of the hall {} m from the centre; the field and a robot around it "
                                   "need {:.2f} m: make hall_half_width larger",
                                   half_width, needed));
    }
  }
  for (const Obstacle& obstacle : scenario.arena.obstacles) {
    if (obstacle.position.cwiseAbs().maxCoeff() + obstacle.radius < half_width) continue;
    map.fail("obstacles", fmt::format("has one at ({}, {}), outside the hall, whose walls are {} m from the centre",
                                      obstacle.position.x(), obstacle.position.y(), half_width));
  }
}

// Refuses what ends the episode at once, and what overlaps something.
void check_start(const YamlMap& start, const char* key, const Scenario& scenario, const State& state,
                 const Eigen::Vector2d& position, double radius) {
  const std::string what = in_the_way(scenario.arena, position, radius, kTouching);
  if (!what.empty()) start.fail(key, fmt::format("lets the {} overlap {}; move one of them", key, what));
  if (!scenario.arena.field) return;
  const auto outcome = judge(state, *scenario.arena.field, std::numeric_limits<double>::infinity());
  if (outcome) start.fail(key, fmt::format("ends the episode at once ({}); move it onto the field", word(*outcome)));
}

void read_start(const YamlMap& start, Scenario& scenario) {
  start.allow({"robot", "ball"});
  State state;
  if (start.has("robot")) {
    const std::vector<double> robot = start.numbers("robot", 3, kPositionOrDegrees);
    scenario.robot_start = Pose2{robot[0], robot[1], wrap_angle(radians(robot[2]))};
    state.world_from_robot = *scenario.robot_start;
    check_start(start, "robot", scenario, state, scenario.robot_start->translation(), scenario.robot.radius);
  }
  if (!start.has("ball")) return;
  const std::vector<double> ball = start.numbers("ball", 2, kPosition);
  scenario.ball_start = Eigen::Vector2d(ball[0], ball[1]);
  state.ball_in_field = {ball[0], ball[1], kBallRadius};
  check_start(start, "ball", scenario, state, *scenario.ball_start, kBallRadius);
}

// What cannot be drawn must be given, and must fit together.
void complete_start(const YamlMap& map, Scenario& scenario) {
  if (!scenario.arena.field) {
    if (!scenario.ball_start) {
      map.fail(map.has("start") ? "start" : "field",
               "leaves open where the ball is: without a field give `start: {ball: [x, y]}`, or name a field");
    }
    if (!scenario.robot_start) scenario.robot_start = Pose2{};
  } else if (!scenario.ball_start && scenario.margin >= scenario.arena.field->half_width) {
    map.fail(map.has("margin") ? "margin" : "field",
             fmt::format("leaves no place for the ball: it is to lie {} m inside the lines, and the field is {} m wide",
                         scenario.margin, 2.0 * scenario.arena.field->half_width));
  }
  if (!scenario.robot_start || !scenario.ball_start) return;
  const double gap = (scenario.robot_start->translation() - *scenario.ball_start).norm() - scenario.robot.radius;
  if (gap - kBallRadius < kTouching) {
    map.map("start").fail("ball", fmt::format("puts the ball into the robot: its centre is {:.3f} m from the hull, and "
                                              "its radius is {} m; move one of them",
                                              gap, kBallRadius));
  }
}

}  // namespace

Scenario read_scenario(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow(
      {"rig", "robot", "look", "field", "wall", "obstacles", "start", "clearance", "margin", "duration_s", "physics"});
  Scenario scenario;
  scenario.name = file.stem().string();
  scenario.rig = omni::read_rig(named_file(map, "rig"));
  scenario.robot = control::read_robot(named_file(map, "robot"));
  check_rig(map, scenario.rig, scenario.robot);
  scenario.look = read_look(named_file(map, "look"));
  if (map.has("physics")) scenario.physics = read_physics_options(map.map("physics"));
  map.read_number("duration_s", {0.1, 3600.0}, scenario.duration_s);
  map.read_number("clearance", {0.0, 10.0}, scenario.clearance);
  map.read_number("margin", {0.0, 10.0}, scenario.margin);

  if (map.has("field")) scenario.arena.field = read_field(named_file(map, "field"));
  if (map.has("wall")) scenario.arena.wall = read_wall(map.map("wall"), scenario.arena.field);
  if (map.has("obstacles")) read_obstacles(map, scenario.arena);
  if (map.has("start")) read_start(map.map("start"), scenario);
  complete_start(map, scenario);
  check_hall(map, scenario);
  return scenario;
}

}  // namespace movis::sim
