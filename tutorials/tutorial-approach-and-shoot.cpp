// A controller of your own, in closed loop against fuzzy control and visual servoing.
//
// Scenario: the robot and a resting ball on the paper's field, their places drawn from a seed. Every contender plays
// the same starts, sees the same way (three rendered cameras, scan, triangulation, localization) and drives the same
// robot. A goal is the yellow one, at +Y. The controller, Orbit, moves in polar coordinates around the ball:
//
//   robot frame  origin on the floor under the robot, x right, y forward, metres; directions from straight ahead,
//                positive to the left, radians
//   n, t         unit vectors at the robot: from the ball to the robot, and n turned to the left by 90°
//   r            distance of the centres of ball and robot, metres;  contact: the sum of their radii
//   detour       δ, the turn about the ball that takes the robot behind it, where ball and goal lie in one line
//   v            k (ρ − r) n + k contact sat(δ) t,  sat(δ) = δ within ±1 rad: go round, at the distance
//                ρ = contact − lean + gap min(1, |δ|/30°): gap − lean clear of the ball, then closer, then against it
//   ω            k_turn times the direction of the line from the ball to the goal
//
// The law need not know the robot's limits, nor when to stop: control::Drive does. The kick rule is one for all
// contenders: movis/control/percepts.h.

#include "common.h"
#include "movis/experiments/contender.h"
#include "movis/experiments/match.h"
#include "movis/experiments/page.h"
#include "movis/experiments/statistics.h"

using namespace movis;
using Eigen::Vector2d;

// Your controller: start() and step() are all it takes; the signals become curves on the page.
class Orbit : public control::Controller {
 public:
  explicit Orbit(control::Task task) : task_(std::move(task)) {}

  void start() override {}  // nothing to forget: the command is a function of the observation

  control::Command step(const control::Observation& observation) override {
    const control::Percepts percepts = control::perceive(observation, task_);
    const double contact = task_.robot.radius + task_.ball_radius;
    const double away = std::min(1.0, std::abs(percepts.detour) / radians(30.0));  // 0 behind the ball
    const double rho = contact - kLean + kGap * away;

    const Vector2d n = -percepts.ball_in_robot / percepts.ball_distance;
    const Vector2d t(-n.y(), n.x());
    const double around = contact * std::clamp(percepts.detour, -1.0, 1.0);
    const Vector2d v = kGain * ((rho - percepts.ball_distance) * n + around * t);
    const double shot_direction = wrap_angle(percepts.ball_direction + percepts.detour);

    signals_[0].value = 1.0 - away;
    signals_[1].value = degrees(percepts.detour);
    return {{v.x(), v.y(), kTurnGain * shot_direction}, control::should_kick(observation, task_)};
  }

  const std::vector<control::Signal>& signals() const override { return signals_; }

 private:
  static constexpr double kGain = 4.0, kTurnGain = 4.0;  // 1/s
  static constexpr double kGap = 0.2, kLean = 0.05;      // metres
  control::Task task_;
  std::vector<control::Signal> signals_{{"behind", "", 0.0}, {"detour", "°", 0.0}};
};

struct Arguments {
  std::vector<std::string> against{"fuzzy", "pbvs"};
  std::string scenario, localizer = "nls", page;
  int starts = 2;
  std::uint64_t seed = 1;  // of the first start
};

std::unique_ptr<control::Controller> make(const std::string& name, const control::Task& task) {
  if (name == "orbit") return std::make_unique<Orbit>(task);
  return experiments::make_controller(name, task);
}

void write_page(const sim::Scenario& scenario, std::vector<report::ContenderSummary> summaries,
                std::vector<report::Episode> episodes, const std::string& file) {
  report::EpisodePage page = experiments::page_of(scenario, std::move(summaries), std::move(episodes));
  page.title = "A controller of your own";
  page.command = "tutorial-approach-and-shoot";
  report::write_episode_page(page, file);
  fmt::print("open in a browser: {}\n", file);
}

bool compete(const Arguments& arguments) {
  const sim::Scenario scenario = sim::read_scenario(
      arguments.scenario.empty() ? data_file("scenarios/resting-ball.yaml").string() : arguments.scenario);
  experiments::MatchOptions options;
  options.localizer = arguments.localizer;
  experiments::Match match(scenario, options);
  std::vector<std::string> contenders{"orbit"};
  contenders.insert(contenders.end(), arguments.against.begin(), arguments.against.end());

  std::vector<report::Episode> episodes;
  const double view_interval_s = arguments.page.empty() ? 0.0 : 0.5;  // pictures are for the page alone
  for (int start = 0; start < arguments.starts; ++start) {
    const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(start);
    for (const std::string& contender : contenders) {
      const auto controller = make(contender, match.task());
      episodes.push_back(match.play(contender, *controller, seed, view_interval_s));
      const report::Episode& episode = episodes.back();
      fmt::print("start {}  {:9} {:11} {:6.2f} s\n", seed, contender, episode.outcome, episode.duration_s);
    }
  }
  std::vector<report::ContenderSummary> summaries;
  summaries.reserve(contenders.size());
  for (const std::string& contender : contenders) {
    summaries.push_back(experiments::summarize(contender, episodes));
  }
  fmt::print("{}", experiments::table_of(summaries));
  const bool scored = summaries[0].goals > 0;
  if (!arguments.page.empty()) write_page(scenario, summaries, std::move(episodes), arguments.page);
  return scored;
}

int main(int argc, char** argv) {
  CLI::App program("Plays a controller of your own against others, on rendered images", "tutorial-approach-and-shoot");
  Arguments arguments;
  program.add_option("--against", arguments.against, "fuzzy[:FILE] and pbvs[:FILE], separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  program.add_option("--starts", arguments.starts, "How many")->check(CLI::Range(1, 1000))->capture_default_str();
  program.add_option("--seed", arguments.seed, "Of the first start; the others count on")->capture_default_str();
  program.add_option("--scenario", arguments.scenario, "Default: data/scenarios/resting-ball.yaml");
  program.add_option("--localizer", arguments.localizer, "nls, composed, method1 or method2")->capture_default_str();
  program.add_option("--page", arguments.page, "An HTML page that replays the episodes");
  return tutorial::run(program, argc, argv, [&] { return compete(arguments); });
}
