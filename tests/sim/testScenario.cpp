#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/sim/scenario.h"
#include "physics_scene.h"
#include "support/temporary_folder.h"

namespace movis::sim {
namespace {

// Beside links to the files that a scenario names.
class ScenarioFile : public ::testing::Test {
 protected:
  ScenarioFile() {
    for (const char* name : {"rigs/movis.yaml", "robots/miniature.yaml", "looks/hall.yaml", "fields/paper.yaml"}) {
      const std::filesystem::path file = data_file(name);
      std::filesystem::create_symlink(file, folder_.path() / file.filename());
    }
  }

  std::filesystem::path write(const std::string& lines, bool with_field = true) {
    const std::string files = "rig: movis.yaml\nrobot: miniature.yaml\nlook: hall.yaml\n";
    return folder_.write("game.yaml", files + (with_field ? "field: paper.yaml\n" : "") + lines);
  }
  Scenario read(const std::string& lines, bool with_field = true) { return read_scenario(write(lines, with_field)); }
  void expect_refused(const std::string& lines, std::initializer_list<const char*> parts, bool with_field = true) {
    test::expect_error([&] { read(lines, with_field); }, parts);
  }

  test::TemporaryFolder folder_;
};

TEST_F(ScenarioFile, EveryKey) {
  const Scenario scenario = read(R"(
wall: {distance: 0.6, height: 0.4}
obstacles:
- {position: [0.5, 1.0], radius: 0.15, height: 0.5, band: magenta, band_heights: [0.2, 0.3]}
- {position: [-0.5, 1.0]}
start: {robot: [0.1, -1.0, 450], ball: [0.2, 0.3]}
clearance: 0.2
margin: 0.3
duration_s: 12
physics: {substep_s: 0.001, ball_mass: 0.4, rolling_deceleration: 0.3, ball_restitution: 0.5, contact_friction: 0.1}
)");
  EXPECT_EQ(scenario.name, "game");
  EXPECT_EQ(scenario.rig.cameras.size(), 3U);
  EXPECT_EQ(scenario.robot.radius, 0.25);
  EXPECT_EQ(scenario.arena.field->Fd, 2.0);
  EXPECT_EQ(scenario.arena.wall->distance, 0.6);
  EXPECT_EQ(scenario.arena.wall->height, 0.4);
  ASSERT_EQ(scenario.arena.obstacles.size(), 2U);
  const Obstacle& first = scenario.arena.obstacles.front();
  EXPECT_EQ(first.position, Eigen::Vector2d(0.5, 1.0));
  EXPECT_EQ(first.radius, 0.15);
  EXPECT_EQ(first.height, 0.5);
  EXPECT_EQ(first.band, Obstacle::Band::magenta);
  EXPECT_EQ(first.band_bottom, 0.2);
  EXPECT_EQ(first.band_top, 0.3);
  EXPECT_EQ(scenario.arena.obstacles.back().band, Obstacle::Band::none);
  EXPECT_EQ(scenario.robot_start->y, -1.0);
  EXPECT_NEAR(scenario.robot_start->beta, kPi / 2.0, 1e-12);
  EXPECT_EQ(*scenario.ball_start, Eigen::Vector2d(0.2, 0.3));
  EXPECT_EQ(scenario.clearance, 0.2);
  EXPECT_EQ(scenario.margin, 0.3);
  EXPECT_EQ(scenario.duration_s, 12.0);
  EXPECT_EQ(scenario.physics.substep_s, 0.001);
  EXPECT_EQ(scenario.physics.ball_mass, 0.4);
  EXPECT_EQ(scenario.physics.rolling_deceleration, 0.3);
  EXPECT_EQ(scenario.physics.ball_restitution, 0.5);
  EXPECT_EQ(scenario.physics.contact_friction, 0.1);
}

TEST_F(ScenarioFile, OursAreReadable) {
  for (const auto& entry : std::filesystem::directory_iterator(data_file("scenarios"))) {
    if (entry.path().extension() != ".yaml") continue;
    const Scenario scenario = read_scenario(entry.path());
    RandomStream random = make_stream(1, kStartStream);
    EXPECT_EQ(draw_start(scenario, random).time_s, 0.0) << entry.path();
  }
}

TEST_F(ScenarioFile, Misspelt) {
  expect_refused("walls: {height: 0.3}\n", {"game.yaml:5", "'walls'", "did you mean 'wall'?"});
  expect_refused("physics: {friction: 0.3}\n", {"game.yaml:5", "'friction'", "in 'physics'"});
  expect_refused("start: {bal: [0, 0]}\n", {"game.yaml:5", "'bal'", "did you mean 'ball'?"});
  expect_refused("obstacles: [{position: [0, 0], colour: cyan}]\n", {"'colour'", "obstacles[0]"});
  expect_refused("obstacles: [{position: [0, 0], band: red}]\n", {"obstacles[0].band", "none, cyan, magenta"});
  expect_refused("obstacles: [{radius: 0.2}]\n", {"obstacles[0].position", "missing"});
}

TEST_F(ScenarioFile, OutOfRange) {
  expect_refused("duration_s: 0\n", {"game.yaml:5", "duration_s", "out of range"});
  expect_refused("physics: {ball_restitution: 1.1}\n", {"physics.ball_restitution", "out of range"});
  expect_refused("physics: {substep_s: 0.01}\n", {"physics.substep_s", "out of range"});
  expect_refused("clearance: .nan\n", {"clearance", "out of range"});
}

TEST_F(ScenarioFile, FilesAreRelativeToTheScenario) {
  const std::filesystem::path file =
      folder_.write("sub/game.yaml", "rig: ../movis.yaml\nrobot: gone.yaml\nlook: ../hall.yaml\n");
  test::expect_error([&] { read_scenario(file); }, {"sub/game.yaml:2", "'robot'", "sub/gone.yaml", "does not exist"});
  test::expect_error([&] { read_scenario(folder_.path() / "none.yaml"); }, {"none.yaml", "cannot be opened"});
}

// The robot's radius is 0.25 m, the ball's 0.11 m: they touch with centres 0.36 m apart.
TEST_F(ScenarioFile, BallInsideTheRobot) {
  expect_refused("start: {robot: [0, 0, 0], ball: [0, 0]}\n", {"game.yaml:5", "start.ball", "into the robot"});
  expect_refused("start: {robot: [0, 0, 0], ball: [0.2, 0.299]}\n", {"start.ball", "into the robot"});
  EXPECT_NO_THROW(read("start: {robot: [0.0, 0.1, 0], ball: [0.0, 0.46]}\n"));  // touching
}

TEST_F(ScenarioFile, TwoThingsAtOnePlace) {
  const std::string obstacles = "obstacles: [{position: [0, 0]}, {position: [1, 1]}]\n";  // radius 0.2 m
  expect_refused(obstacles + "start: {robot: [1.3, 1.3, 0]}\n", {"game.yaml:6", "start.robot", "obstacles[1]"});
  expect_refused(obstacles + "start: {ball: [0.2, 0.2]}\n", {"start.ball", "obstacles[0]"});
  expect_refused("obstacles: [{position: [0, 0]}, {position: [0.3, 0.2]}]\n",
                 {"game.yaml:5", "obstacles[1].position", "obstacles[0]"});
}

// Side walls from X = 0.50 to 0.51 m, backs at Y = ±2.25 m.
TEST_F(ScenarioFile, InsideAGoalsWalls) {
  expect_refused("start: {robot: [0.7, 2.1, 0]}\n", {"start.robot", "a goal's walls"});
  expect_refused("start: {robot: [0, -2.1, 0]}\n", {"start.robot", "a goal's walls"});
  expect_refused("start: {ball: [0.5, 1.95]}\n", {"start.ball", "a goal's walls"});
  expect_refused("obstacles: [{position: [-0.6, -2.1]}]\n", {"obstacles[0].position", "a goal's walls"});
  EXPECT_NO_THROW(read("obstacles: [{position: [0, 2.0]}]\n"));  // a keeper
}

TEST_F(ScenarioFile, EndsAtOnce) {
  expect_refused("start: {robot: [2.8, 0, 0]}\n", {"start.robot", "robot_out"});
  expect_refused("start: {ball: [1.87, 0]}\n", {"start.ball", "ball_out"});
  expect_refused("start: {ball: [0, 2.12]}\n", {"start.ball", "goal"});
  EXPECT_NO_THROW(read("start: {robot: [2.7, 0, 0], ball: [1.85, 0]}\n"));
}

TEST_F(ScenarioFile, Wall) {
  expect_refused("wall: {distance: 0.2}\n", {"wall.distance", "into the goals", "0.260 m"});
  expect_refused("wall: {height: 0.3}\nstart: {robot: [2.1, 0, 0]}\n", {"start.robot", "the wall"});
  expect_refused("wall: {}\nstart: {ball: [0, 0]}\n", {"'wall'", "name a field"}, false);
  EXPECT_EQ(read("wall: {}\n").arena.wall->distance, 0.5);
}

TEST_F(ScenarioFile, Bands) {
  expect_refused("obstacles: [{position: [0, 0], band_heights: [0.1, 0.2]}]\n", {"band_heights", "band: cyan"});
  expect_refused("obstacles: [{position: [0, 0], band: cyan, band_heights: [0.3, 0.2]}]\n",
                 {"band_heights", "upwards"});
  expect_refused("obstacles: [{position: [0, 0], band: cyan, height: 0.4}]\n", {"band", "0.4 m"});
}

TEST_F(ScenarioFile, CamerasSitOnTheRobot) {
  const std::string camera = R"(cameras:
- name: M1
  position: [0, 0.1, 0.09]
  yaw_deg: 0
  tilt_deg: [0, 0]
  image: {width: 640, height: 480}
  model: unified
  unified: {xi: 1, fu: 300, fv: 300, u0: 320, v0: 240}
)";
  const auto with_rig = [&](const std::string& rig) {
    folder_.write("other.yaml", rig);
    return folder_.write("game.yaml", "rig: other.yaml\nrobot: miniature.yaml\nlook: hall.yaml\nfield: paper.yaml\n");
  };
  test::expect_error([&] { read_scenario(with_rig(camera)); }, {"game.yaml:1", "'rig'", "M1", "inside the robot"});
  const auto moved = [&](const std::string& position) {
    std::string other = camera;
    return other.replace(other.find("[0, 0.1, 0.09]"), 14, position);
  };
  test::expect_error([&] { read_scenario(with_rig(moved("[0, 0, -0.1]"))); }, {"'rig'", "M1", "under the floor"});
  test::expect_error([&] { read_scenario(with_rig(moved("[0.3, 0, 0.3]"))); }, {"'rig'", "M1", "0.300 m", "0.25 m"});
  EXPECT_NO_THROW(read_scenario(with_rig(moved("[0, 0.25, 0.3]"))));
}

TEST_F(ScenarioFile, WithoutAField) {
  expect_refused("", {"game.yaml", "start: {ball: [x, y]}"}, false);
  expect_refused("start: {robot: [0, 0, 0]}\n", {"start", "where the ball is"}, false);
  const Scenario scenario = read("start: {ball: [30, 40]}\n", false);
  EXPECT_EQ(scenario.robot_start->x, 0.0);
  RandomStream random = make_stream(1, kStartStream);
  EXPECT_EQ(draw_start(scenario, random).ball_in_field, Eigen::Vector3d(30.0, 40.0, kBallRadius));
}

TEST_F(ScenarioFile, MarginLeavesNoPlace) {
  expect_refused("margin: 1.8\n", {"game.yaml:5", "margin", "1.8 m"});
  EXPECT_NO_THROW(read("margin: 1.8\nstart: {ball: [0, 0]}\n"));
}

Scenario open_play() {
  Scenario scenario;
  scenario.name = "open play";
  scenario.arena = {paper_field(), Wall{0.5, 0.3}, {}};
  scenario.arena.obstacles.emplace_back().position = {0.3, 0.5};
  scenario.robot = exact_robot();
  return scenario;
}

// Places are even over what is free, so within four standard errors X and Y have the mean 0 that the field's symmetry
// gives where there is no obstacle, and the headings are even over the circle: their mean direction has length
// 1/√n ± 4/√n at most.
TEST(DrawStart, IsFreeAndEven) {
  const Scenario scenario = open_play();
  RandomStream random = make_stream(1, kStartStream);
  const int draws = 2000;
  Eigen::Vector2d heading = Eigen::Vector2d::Zero();
  Eigen::Array2d most_robot = Eigen::Array2d::Zero();
  Eigen::Array2d most_ball = Eigen::Array2d::Zero();
  for (int i = 0; i < draws; ++i) {
    const State state = draw_start(scenario, random);
    const Eigen::Vector2d robot = state.world_from_robot.translation();
    const Eigen::Vector2d ball = state.ball_in_field.head<2>();
    EXPECT_GE((robot - ball).norm(), 0.25 + 0.11 + 0.10);
    EXPECT_GE((robot - Eigen::Vector2d(0.3, 0.5)).norm(), 0.25 + 0.2 + 0.10);
    EXPECT_GE((ball - Eigen::Vector2d(0.3, 0.5)).norm(), 0.11 + 0.2 + 0.10);
    EXPECT_EQ(state.ball_in_field.z(), kBallRadius);
    heading += Eigen::Vector2d(std::cos(state.world_from_robot.beta), std::sin(state.world_from_robot.beta));
    most_robot = most_robot.max(robot.array().abs());
    most_ball = most_ball.max(ball.array().abs());
  }
  EXPECT_LT(heading.norm() / draws, 5.0 / std::sqrt(draws));
  // The robot up to its radius, the ball up to 0.45 m from the lines at 1.75 and 2 m, and some come close to that.
  for (const auto& [most, limit] :
       {std::pair(most_robot, Eigen::Array2d(1.5, 1.75)), std::pair(most_ball, Eigen::Array2d(1.3, 1.55))}) {
    EXPECT_TRUE((most <= limit).all());
    EXPECT_TRUE((most >= limit - 0.02).all());
  }
}

TEST(DrawStart, KeepsWhatIsGiven) {
  Scenario scenario = open_play();
  scenario.ball_start = Eigen::Vector2d(-1.0, -1.0);
  RandomStream random = make_stream(2, kStartStream);
  for (int i = 0; i < 100; ++i) {
    const State state = draw_start(scenario, random);
    EXPECT_EQ(state.ball_in_field, Eigen::Vector3d(-1.0, -1.0, kBallRadius));
    EXPECT_GE((state.world_from_robot.translation() - Eigen::Vector2d(-1.0, -1.0)).norm(), 0.46);
  }
}

TEST(DrawStart, SameSeedSameStart) {
  const Scenario scenario = open_play();
  RandomStream one = make_stream(3, kStartStream);
  RandomStream two = make_stream(3, kStartStream);
  EXPECT_EQ(draw_start(scenario, one).ball_in_field, draw_start(scenario, two).ball_in_field);
}

// An obstacle of 3 m fills the field.
TEST(DrawStart, NoFreePlace) {
  Scenario scenario = open_play();
  scenario.arena.obstacles.front().radius = 3.0;
  RandomStream random = make_stream(1, kStartStream);
  test::expect_error([&] { draw_start(scenario, random); },
                     {"'open play'", "no free place", "obstacles[0] was in the way", "clearance"});
  scenario.arena.field.reset();
  test::expect_error([&] { draw_start(scenario, random); }, {"'open play'", "no field"});
}

}  // namespace
}  // namespace movis::sim
