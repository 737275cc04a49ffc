#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "movis/core/paths.h"
#include "movis/experiments/contender.h"
#include "movis/experiments/match.h"
#include "support/temporary_folder.h"

// Closed loops on rendered images.
namespace movis::experiments {
namespace {

sim::Scenario short_scenario(double duration_s) {
  sim::Scenario scenario = sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
  scenario.duration_s = duration_s;
  return scenario;
}

// Does what it is told, and counts.
class Puppet : public control::Controller {
 public:
  explicit Puppet(const control::Command& command) : command_(command) {}
  void start() override { steps = 0; }
  control::Command step(const control::Observation& observation) override {
    ++steps;
    last_time_s = observation.time_s;
    return command_;
  }
  const std::vector<control::Signal>& signals() const override { return signals_; }

  int steps = 0;
  double last_time_s = -1.0;

 private:
  control::Command command_;
  std::vector<control::Signal> signals_{{"weight", "", 1.0}};
};

TEST(Match, BothControllersScoreFromOneStart) {
  Match match(short_scenario(20.0), {});
  for (const std::string& name : controller_names()) {
    const auto controller = make_controller(name, match.task());
    const report::Episode episode = match.play(name, *controller, 1);
    EXPECT_EQ(episode.outcome, "goal") << name;
    EXPECT_GE(episode.kicks, 1) << name;
  }
}

TEST(Match, SameSeedSameRecord) {
  const sim::Scenario scenario = short_scenario(1.0);
  Match one(scenario, {});
  Match other(scenario, {});
  const auto controller = make_controller("pbvs", one.task());
  one.play("pbvs", *controller, 3);  // what was played before leaves no trace
  const report::Episode first = one.play("pbvs", *controller, 5);
  const report::Episode second = other.play("pbvs", *controller, 5);
  ASSERT_EQ(first.ticks.size(), second.ticks.size());
  for (std::size_t i = 0; i < first.ticks.size(); ++i) {
    EXPECT_EQ(first.ticks[i].true_pose.x, second.ticks[i].true_pose.x) << i;
    EXPECT_EQ(first.ticks[i].vx, second.ticks[i].vx) << i;
    ASSERT_EQ(first.ticks[i].pose.has_value(), second.ticks[i].pose.has_value()) << i;
    if (!first.ticks[i].pose) continue;
    EXPECT_EQ(first.ticks[i].pose->beta, second.ticks[i].pose->beta) << i;
  }
}

TEST(Match, ControllerThatReturnsNanIsContainedAndTheRobotStops) {
  Match match(short_scenario(1.0), {});
  Puppet puppet({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, true});
  const report::Episode episode = match.play("nan", puppet, 1);
  EXPECT_EQ(episode.outcome, "out_of_time");
  EXPECT_EQ(episode.kicks, 0);
  EXPECT_GT(puppet.steps, 20);
  for (const report::EpisodeTick& tick : episode.ticks) {
    EXPECT_EQ(tick.status, "not_finite");
    EXPECT_EQ(tick.vx, 0.0);
    EXPECT_EQ(tick.true_pose.x, episode.ticks.front().true_pose.x);
  }
}

// The controller is told the time of the images; it sees no later one.
TEST(Match, EveryImageIsOneTick) {
  Match match(short_scenario(0.5), {});
  Puppet puppet({});
  const report::Episode episode = match.play("still", puppet, 2, 0.2);
  ASSERT_EQ(episode.ticks.size(), 15U);  // 0.5 s at 30 Hz, the first at 0
  EXPECT_EQ(puppet.steps, 15);
  EXPECT_NEAR(puppet.last_time_s, 14.0 / 30.0, 1e-9);
  EXPECT_EQ(episode.views.size(), 3U);  // at 0, 0.2 and 0.4 s
  EXPECT_EQ(episode.views[0].cameras.size(), 3U);
  EXPECT_EQ(episode.signal_names, std::vector<std::string>{"weight"});
}

TEST(Match, ScenarioWithoutAField) {
  sim::Scenario scenario = short_scenario(1.0);
  scenario.arena.field.reset();
  test::expect_error([&] { Match(scenario, {}); }, {"resting-ball", "no field"});
}

TEST(Match, FieldWhoseGoalsNoBallCanEnter) {
  sim::Scenario scenario = short_scenario(1.0);
  scenario.arena.field->goal_height = 0.2;
  test::expect_error([&] { Match(scenario, {}); }, {"resting-ball", "goal_height", "0.2 m"});
}

TEST(Match, EveryTickMayEndIt) {
  MatchOptions options;
  int ticks = 0;
  options.every_tick = [&] {
    if (++ticks == 3) throw std::runtime_error("enough");
  };
  Match match(short_scenario(20.0), options);
  Puppet puppet({});
  test::expect_error([&] { match.play("still", puppet, 1); }, {"enough"});
  EXPECT_EQ(puppet.steps, 2);
}

TEST(Match, UnknownLocalizer) {
  MatchOptions options;
  options.localizer = "gps";
  test::expect_error([&] { Match(short_scenario(1.0), options); }, {"'gps'", "composed"});
}

}  // namespace
}  // namespace movis::experiments
