#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/fuzzy/hierarchy.h"
#include "support/closed_loop.h"
#include "support/temporary_folder.h"

namespace movis::fuzzy {
namespace {

using test::expect_error;
using test::TemporaryFolder;

control::Task miniature() {
  return {read_field(data_file("fields/paper.yaml")), control::read_robot(data_file("robots/miniature.yaml"))};
}

Hierarchy approach_and_shoot() {
  return {data_file("fuzzy/approach-and-shoot/controller.yaml"), miniature()};
}

control::Command answer(Hierarchy& controller, const Pose2& world_from_robot, const Eigen::Vector2d& ball_in_robot) {
  static const std::vector<Bearing> none;
  return controller.step({none, {0.0, world_from_robot, 0.0, ball_in_robot, 0.0}, 0.0});
}

// A rule base whose outputs are constants; `input` is its only input.
std::string constants(const std::vector<std::pair<std::string, double>>& outputs,
                      const std::string& input = "ball_distance") {
  std::string variables;
  std::string rules;
  for (const auto& [name, value] : outputs) {
    variables += fmt::format(
        "OutputVariable: {}\n range: -400 400\n defuzzifier: WeightedAverage\n default: 0\n term: value Constant {}\n",
        name, value);
    rules += fmt::format(" rule: if {} is any then {} is value\n", input, name);
  }
  return fmt::format(
      "Engine: constants\nInputVariable: {}\n range: -200 200\n term: low Ramp 200 -200\n"
      " term: high Ramp -200 200\n{}RuleBlock:\n{}",
      input, variables, rules);
}

constexpr const char* kTwoBehaviours =
    "selection: select.fll\n"
    "behaviours:\n"
    "- {name: go, rules: go.fll}\n"
    "- {name: pass, rules: pass.fll}\n";

// Writes two behaviours with constant velocities and their weights, and gives the controller's file.
std::filesystem::path two_behaviours(const TemporaryFolder& folder, double go, double pass) {
  folder.write("select.fll", constants({{"go", go}, {"pass", pass}}));
  folder.write("go.fll", constants({{"toward", 1.0}, {"around", 0.0}, {"turn_rate_deg", 90.0}}));
  folder.write("pass.fll", constants({{"turn_rate_deg", 0.0}, {"around", 1.0}, {"toward", 0.0}}));
  return folder.write("controller.yaml", kTwoBehaviours);
}

// By hand: weights 1 and 0.5 are parts 2/3 and 1/3, so toward = 2/3, around = 1/3, 60°/s to the left. The ball lies to
// the left, at (−1, 0); left of the line to it is backwards.
TEST(Hierarchy, CommandIsTheWeightedMean) {
  const TemporaryFolder folder;
  Hierarchy controller(two_behaviours(folder, 1.0, 0.5), miniature());
  const control::Command command = answer(controller, {}, {-1.0, 0.0});
  EXPECT_NEAR(command.velocity.vx, -2.0 / 3.0, 1e-12);
  EXPECT_NEAR(command.velocity.vy, -1.0 / 3.0, 1e-12);
  EXPECT_NEAR(command.velocity.omega, kPi / 3.0, 1e-12);
  ASSERT_EQ(controller.signals().size(), 5u);
  EXPECT_EQ(controller.signals()[0].name, "go");
  EXPECT_NEAR(controller.signals()[0].value, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(controller.signals()[1].value, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(controller.signals()[3].value, 90.0, 1e-12);  // ball direction
}

TEST(Hierarchy, NoWeightIsAStop) {
  const TemporaryFolder folder;
  Hierarchy controller(two_behaviours(folder, 0.0, 0.0), miniature());
  const control::Command command = answer(controller, {}, {0.0, 1.0});
  EXPECT_EQ(command.velocity.vx, 0.0);
  EXPECT_EQ(command.velocity.vy, 0.0);
  EXPECT_EQ(command.velocity.omega, 0.0);
}

// By hand: the robot stands at (0.5, −1) and looks along Y, the ball 0.5 m to the left and 0.5 m ahead. The goal's
// centre is (−0.5, 3) from the robot and (0, 2.5) from the ball, the nearest post (0.5, −2).
TEST(Hierarchy, PerceptsByName) {
  const std::vector<std::pair<const char*, double>> expected{
      {"ball_distance", std::sqrt(0.5)},
      {"ball_gap", std::sqrt(0.5) - 0.36},
      {"ball_direction_deg", 45.0},
      {"target_distance", std::sqrt(9.25)},
      {"target_direction_deg", degrees(std::atan(0.5 / 3.0))},
      {"shot_direction_deg", 0.0},
      {"detour_deg", -45.0},
      {"post_gap", 0.75},
  };
  const TemporaryFolder folder;
  const auto file = two_behaviours(folder, 1.0, 0.0);
  for (const auto& [name, value] : expected) {
    folder.write("go.fll", constants({{"around", 0.0}, {"turn_rate_deg", 0.0}}, name) +
                               fmt::format("OutputVariable: toward\n range: -200 200\n defuzzifier: WeightedAverage\n"
                                           " default: 0\n term: low Constant -200\n term: high Constant 200\n"
                                           "RuleBlock:\n"  // toward is the input itself
                                           " rule: if {0} is low then toward is low\n"
                                           " rule: if {0} is high then toward is high\n",
                                           name));
    Hierarchy controller(file, miniature());
    const Twist2 velocity = answer(controller, {0.5, -1.0, 0.0}, {-0.5, 0.5}).velocity;
    EXPECT_NEAR(velocity.vx, -value * std::sqrt(0.5), 1e-9) << name;
    EXPECT_NEAR(velocity.vy, value * std::sqrt(0.5), 1e-9) << name;
  }
}

// The mirror image of a situation has the mirror image of its command.
TEST(Hierarchy, LeftAndRightAreAlike) {
  Hierarchy controller = approach_and_shoot();
  RandomStream stream = make_stream(3, 0);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  std::uniform_real_distribution<double> heading(-kPi, kPi);
  for (int draw = 0; draw < 2000; ++draw) {
    const Pose2 pose{place(stream), place(stream), heading(stream)};
    const Eigen::Vector2d ball(place(stream), place(stream));
    const control::Command command = answer(controller, pose, ball);
    const control::Command mirrored = answer(controller, {-pose.x, pose.y, -pose.beta}, {-ball.x(), ball.y()});
    EXPECT_NEAR(mirrored.velocity.vx, -command.velocity.vx, 1e-9);
    EXPECT_NEAR(mirrored.velocity.vy, command.velocity.vy, 1e-9);
    EXPECT_NEAR(mirrored.velocity.omega, -command.velocity.omega, 1e-9);
    EXPECT_EQ(mirrored.kick, command.kick);
  }
}

// Far away approach counts alone, near and on the wrong side turn, near and behind the ball shoot. The robot looks
// along Y from the middle.
TEST(Hierarchy, EachBehaviourHasItsPlace) {
  Hierarchy controller = approach_and_shoot();
  const auto weights = [&](const Eigen::Vector2d& ball) {
    answer(controller, {}, ball);
    return std::vector{controller.signals()[0].value, controller.signals()[1].value, controller.signals()[2].value};
  };
  EXPECT_EQ(weights({0.0, 1.5}), (std::vector{1.0, 0.0, 0.0}));
  EXPECT_EQ(weights({0.0, -0.6}), (std::vector{0.0, 1.0, 0.0}));
  EXPECT_EQ(weights({0.0, 0.6}), (std::vector{0.0, 0.0, 1.0}));
}

TEST(Hierarchy, NaNWorldIsAStop) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Hierarchy controller = approach_and_shoot();
  for (const auto& [pose, ball] : {std::pair{Pose2{kNaN, 0.0, 0.0}, Eigen::Vector2d(0.0, 0.3)},
                                   {Pose2{0.0, 0.0, kNaN}, {0.0, 0.3}},
                                   {Pose2{}, {kNaN, 0.3}},
                                   {Pose2{}, {0.0, std::numeric_limits<double>::infinity()}}}) {
    const control::Command command = answer(controller, pose, ball);
    EXPECT_TRUE(std::isfinite(command.velocity.vx + command.velocity.vy + command.velocity.omega));
    EXPECT_FALSE(command.kick);
  }
  const control::Command command = answer(controller, {kNaN, 0.0, 0.0}, {0.0, 0.3});
  EXPECT_EQ(command.velocity.vy, 0.0);
  EXPECT_EQ(controller.signals()[2].value, 0.0);
  EXPECT_GT(answer(controller, {}, {0.0, 0.6}).velocity.vy, 0.1);  // and the next world is acted on
}

TEST(Hierarchy, FilesThatDoNotFit) {
  const TemporaryFolder folder;
  const auto file = two_behaviours(folder, 1.0, 0.0);
  const auto refused = [&](std::initializer_list<const char*> parts) {
    expect_error([&] { Hierarchy(file, miniature()); }, parts);
    two_behaviours(folder, 1.0, 0.0);
  };
  folder.write("go.fll", constants({{"toward", 0}, {"around", 0}, {"turn_rate_deg", 0}}, "ball_gab"));
  refused({"go.fll", "'ball_gab' is no percept", "did you mean 'ball_gap'", "detour_deg"});
  folder.write("go.fll", constants({{"toward", 0}, {"around", 0}, {"turn_rate", 0}}));
  refused({"go.fll", "'turn_rate'", "Known here: toward, around, turn_rate_deg"});
  folder.write("go.fll", constants({{"toward", 0}, {"around", 0}}));
  refused({"go.fll", "'turn_rate_deg' is missing"});
  folder.write("go.fll", constants({{"toward", 0}, {"around", 0}, {"turn_rate_deg", 0}}) +
                             " rule: if ball_distance is lwo then around is value\n");
  refused({"go.fll:25", "'lwo' is no term of 'ball_distance'", "did you mean 'low'"});
  folder.write("select.fll", constants({{"go", 1}, {"pas", 0}}));
  refused({"select.fll", "'pas'", "did you mean 'pass'"});
  folder.write("select.fll", constants({{"go", 1}}));
  refused({"select.fll", "'pass' is missing"});
  folder.write("select.fll", constants({{"go", 1}, {"pass", 2}}));
  refused({"select.fll", "'pass'", "from 0 to 1"});
  std::filesystem::remove(folder.path() / "pass.fll");
  refused({"pass.fll", "cannot be opened"});
  folder.write("controller.yaml", std::string(kTwoBehaviours) + "- {name: go, rules: go.fll}\n");
  refused({"controller.yaml:5", "stands twice"});
  folder.write("controller.yaml", std::string(kTwoBehaviours) + "selektion: select.fll\n");
  refused({"controller.yaml:5", "selektion"});
  expect_error([&] { Hierarchy(folder.path() / "none.yaml", miniature()); }, {"none.yaml", "cannot be opened"});
}

sim::Scenario resting_ball() {
  return sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
}

// The rules were tuned on other seeds (1001–2000).
TEST(Hierarchy, ScoresFromAnywhere) {
  constexpr int kEpisodes = 40;
  const sim::Scenario scenario = resting_ball();
  Hierarchy controller = approach_and_shoot();
  int goals = 0;
  std::vector<double> times;
  for (int seed = 1; seed <= kEpisodes; ++seed) {
    const test::ClosedLoopRun run = test::run_without_images(scenario, controller, static_cast<std::uint64_t>(seed));
    goals += run.outcome == sim::Outcome::goal ? 1 : 0;
    times.push_back(run.time_s);
  }
  std::nth_element(times.begin(), times.begin() + kEpisodes / 2, times.end());
  EXPECT_GE(goals, kEpisodes * 9 / 10);
  EXPECT_LT(times[kEpisodes / 2], 6.0);
  fmt::print("{} goals of {}, median {:.2f} s\n", goals, kEpisodes, times[kEpisodes / 2]);
}

// From between ball and goal, the robot goes round the ball without touching it.
TEST(Hierarchy, GoesRoundTheBall) {
  sim::Scenario scenario = resting_ball();
  Hierarchy controller = approach_and_shoot();
  const Eigen::Vector2d ball(0.0, -0.4);
  scenario.ball_start = ball;
  for (const Pose2& start : {Pose2{0.05, 1.2, kPi}, Pose2{-0.3, 1.3, 0.0}, Pose2{1.0, 0.6, -1.0}}) {
    scenario.robot_start = start;
    const test::ClosedLoopRun run = test::run_without_images(scenario, controller, 1);
    EXPECT_EQ(run.outcome, sim::Outcome::goal);
    for (const test::ClosedLoopTick& tick : run.trace) {
      const Eigen::Vector2d to_ball = ball - tick.truth.world_from_robot.translation();
      const Eigen::Vector2d to_goal = Eigen::Vector2d(0.0, 2.0) - ball;
      const double detour = std::acos(to_ball.normalized().dot(to_goal.normalized()));
      if (detour < radians(30.0)) break;
      EXPECT_GT(to_ball.norm(), 0.42) << tick.truth.time_s;
    }
  }
}

TEST(Hierarchy, StartForgetsTheEpisodeBefore) {
  const sim::Scenario scenario = resting_ball();
  Hierarchy controller = approach_and_shoot();
  const test::ClosedLoopRun first = test::run_without_images(scenario, controller, 5);
  const test::ClosedLoopRun again = test::run_without_images(scenario, controller, 5);
  ASSERT_EQ(first.trace.size(), again.trace.size());
  EXPECT_EQ(first.trace.back().command.velocity.vx, again.trace.back().command.velocity.vx);
}

}  // namespace
}  // namespace movis::fuzzy
