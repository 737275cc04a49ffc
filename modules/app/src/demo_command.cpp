#include "demo_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <set>
#include <thread>

#include "interrupt.h"
#include "movis/core/error.h"
#include "movis/core/output_file.h"
#include "movis/core/paths.h"
#include "movis/core/version.h"
#include "movis/experiments/contender.h"
#include "movis/experiments/match.h"
#include "movis/experiments/page.h"
#include "movis/experiments/statistics.h"
#include "progress.h"

namespace movis::app {
namespace {

constexpr int kShownStarts = 6;        // on the page
constexpr double kViewInterval = 0.5;  // seconds, between the pictures that it shows

struct Job {
  std::size_t contender = 0;
  int start = 0;
};

// Episodes are shared out among threads, each with a match and controllers of its own.
class Tournament {
 public:
  Tournament(const sim::Scenario& scenario, const DemoArguments& arguments)
      : scenario_(scenario),
        arguments_(arguments),
        progress_("episodes", static_cast<std::size_t>(arguments.episodes) * arguments.controllers.size()) {
    for (int start = 0; start < arguments.episodes; ++start) {
      for (std::size_t i = 0; i < arguments.controllers.size(); ++i) jobs_.push_back({i, start});
    }
    episodes_.resize(jobs_.size());
  }

  // In the order of the starts, and of the contenders within each.
  std::vector<report::Episode> play();

 private:
  void work();
  void run();

  const sim::Scenario& scenario_;
  const DemoArguments& arguments_;
  std::vector<Job> jobs_;
  std::vector<report::Episode> episodes_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // of what follows
  Progress progress_;
  std::exception_ptr failure_;
};

// Plays the jobs that are left, one after the other.
void Tournament::work() {
  experiments::MatchOptions options;
  options.localizer = arguments_.localizer;
  options.every_tick = check_interrupts;
  experiments::Match match(scenario_, options);
  std::vector<std::unique_ptr<control::Controller>> controllers;
  for (const std::string& name : arguments_.controllers) {
    controllers.push_back(experiments::make_controller(name, match.task()));
  }
  for (std::size_t i = next_++; i < jobs_.size(); i = next_++) {
    const Job& job = jobs_[i];
    const double view_interval = job.start < kShownStarts ? kViewInterval : 0.0;
    const std::uint64_t seed = static_cast<std::uint64_t>(arguments_.seed + job.start);
    episodes_[i] = match.play(arguments_.controllers[job.contender], *controllers[job.contender], seed, view_interval);
    const std::lock_guard lock(mutex_);
    progress_.advance();
  }
}

void Tournament::run() {
  try {
    work();
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
    next_ = jobs_.size();
  }
}

std::vector<report::Episode> Tournament::play() {
  const int opencv_threads = cv::getNumThreads();
  cv::setNumThreads(1);  // every core plays an episode of its own
  std::vector<std::thread> threads;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  threads.reserve(cores);
  for (std::size_t i = 1; i < std::min(cores, jobs_.size()); ++i) threads.emplace_back([this] { run(); });
  run();
  for (std::thread& thread : threads) thread.join();
  cv::setNumThreads(opencv_threads);
  if (failure_) std::rethrow_exception(failure_);
  return std::move(episodes_);
}

// A cell of a CSV file (RFC 4180).
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

void write_rows(const std::vector<report::Episode>& episodes, const DemoArguments& arguments,
                const sim::Scenario& scenario, std::ostream& out) {
  out << "scenario,contender,localizer,seed,version,outcome,duration_s,kicks\n";
  for (const report::Episode& e : episodes) {
    out << fmt::format("{},{},{},{},{},{},{:.4f},{}\n", cell(scenario.name), cell(e.contender), arguments.localizer,
                       e.seed, version(), e.outcome, e.duration_s, e.kicks);
  }
}

// Before anything is played.
void check(const DemoArguments& arguments) {
  namespace fs = std::filesystem;
  std::set<std::string> names;
  for (const std::string& name : arguments.controllers) {
    if (!names.insert(name).second) {
      throw Error(
          "--controllers names '{}' twice; to play one against a copy of itself, give the copy's file another "
          "name",
          name);
    }
  }
  if (arguments.rows && fs::weakly_canonical(*arguments.rows) == fs::weakly_canonical(arguments.out)) {
    throw Error("--rows {}: is the file of --out; name another file", arguments.rows->string());
  }
  const bool device = fs::exists(arguments.out) && !fs::is_regular_file(arguments.out);
  if (!device) OutputFile can_be_written(arguments.out);
}

report::EpisodePage make_page(std::vector<report::Episode> episodes, const DemoArguments& arguments,
                              const sim::Scenario& scenario, const std::vector<report::ContenderSummary>& summaries) {
  const auto not_shown = [](const report::Episode& episode) { return episode.views.empty(); };
  episodes.erase(std::remove_if(episodes.begin(), episodes.end(), not_shown), episodes.end());
  report::EpisodePage page = experiments::page_of(scenario, summaries, std::move(episodes));
  page.title = "MOVIS: approach and shoot";
  page.command =
      fmt::format("build/bin/movis demo --episodes {} --seed {} --controllers {} --localizer {}", arguments.episodes,
                  arguments.seed, fmt::join(arguments.controllers, ","), arguments.localizer);
  if (arguments.scenario) page.command += " --scenario " + arguments.scenario->string();
  return page;
}

// Of every contender to the first one.
void print_differences(const std::vector<std::string>& contenders, const std::vector<report::Episode>& episodes) {
  for (std::size_t i = 1; i < contenders.size(); ++i) {
    const experiments::PairedDifference difference = experiments::paired_times(contenders[i], contenders[0], episodes);
    if (difference.pairs == 0) continue;
    fmt::print("  {} less {}: {:+.2f} s to the goal, 95 % interval {:+.2f} to {:+.2f}, from {} starts\n", contenders[i],
               contenders[0], difference.mean_s, difference.interval_s.low, difference.interval_s.high,
               difference.pairs);
  }
}

}  // namespace

void demo(const DemoArguments& arguments) {
  check(arguments);
  std::optional<OutputFile> rows;
  if (arguments.rows) rows.emplace(*arguments.rows);
  const sim::Scenario scenario =
      sim::read_scenario(arguments.scenario ? *arguments.scenario : data_file("scenarios/resting-ball.yaml"));
  for (const std::string& name : arguments.controllers) {
    experiments::make_controller(name, experiments::task_of(scenario));  // errors come now, not after an episode
  }
  const auto begin = std::chrono::steady_clock::now();
  std::vector<report::Episode> episodes = Tournament(scenario, arguments).play();
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  std::vector<report::ContenderSummary> summaries;
  for (const std::string& contender : arguments.controllers) {
    summaries.push_back(experiments::summarize(contender, episodes));
  }
  double played_s = 0.0;
  for (const report::Episode& episode : episodes) played_s += episode.duration_s;
  fmt::print("{}: {} starts, seeds {}–{}\n{}", scenario.name, arguments.episodes, arguments.seed,
             arguments.seed + arguments.episodes - 1, experiments::table_of(summaries));
  print_differences(arguments.controllers, episodes);
  if (rows) write_rows(episodes, arguments, scenario, rows->stream());
  report::write_episode_page(make_page(std::move(episodes), arguments, scenario, summaries), arguments.out);
  if (rows) rows->commit();
  fmt::print("{:.0f} s of play in {:.0f} s: {:.1f} × real time\n", played_s, took_s, played_s / took_s);
  fmt::print("open in a browser: {}\n", std::filesystem::absolute(arguments.out).string());
}

}  // namespace movis::app
