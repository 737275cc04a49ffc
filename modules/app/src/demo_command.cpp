#include "demo_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <thread>

#include "interrupt.h"
#include "movis/core/error.h"
#include "movis/core/names.h"
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
  std::string contender;
  int start = 0;
};

// Plays the jobs that are left, one after the other, on a match of its own.
void work(const sim::Scenario& scenario, const DemoArguments& arguments, const std::vector<Job>& jobs,
          std::atomic<std::size_t>& next, std::vector<report::Episode>& episodes, Progress& progress,
          std::mutex& progress_mutex) {
  experiments::MatchOptions options;
  options.localizer = arguments.localizer;
  experiments::Match match(scenario, options);
  for (std::size_t i = next++; i < jobs.size(); i = next++) {
    check_interrupts();
    const auto controller = experiments::make_controller(jobs[i].contender, match.task());
    const double view_interval = jobs[i].start < kShownStarts ? kViewInterval : 0.0;
    const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(jobs[i].start);
    episodes[i] = match.play(jobs[i].contender, *controller, seed, view_interval);
    const std::lock_guard lock(progress_mutex);
    progress.advance();
  }
}

std::vector<report::Episode> play_all(const sim::Scenario& scenario, const DemoArguments& arguments) {
  std::vector<Job> jobs;
  for (int start = 0; start < arguments.episodes; ++start) {
    for (const std::string& contender : arguments.controllers) jobs.push_back({contender, start});
  }
  std::vector<report::Episode> episodes(jobs.size());
  std::atomic<std::size_t> next = 0;
  Progress progress("episodes", jobs.size());
  std::mutex mutex;
  std::exception_ptr failure;
  const auto run = [&] {
    try {
      work(scenario, arguments, jobs, next, episodes, progress, mutex);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
      next = jobs.size();
    }
  };
  cv::setNumThreads(1);  // every core plays an episode of its own
  std::vector<std::thread> threads;
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t i = 1; i < std::min(cores, jobs.size()); ++i) threads.emplace_back(run);
  run();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
  return episodes;
}

void write_rows(const std::vector<report::Episode>& episodes, const DemoArguments& arguments,
                const sim::Scenario& scenario) {
  OutputFile file(*arguments.rows);
  file.stream() << "scenario,contender,localizer,seed,version,outcome,duration_s,kicks\n";
  for (const report::Episode& e : episodes) {
    file.stream() << fmt::format("{},{},{},{},{},{},{:.4f},{}\n", scenario.name, e.contender, arguments.localizer,
                                 e.seed, version(), e.outcome, e.duration_s, e.kicks);
  }
  file.commit();
}

report::EpisodePage make_page(std::vector<report::Episode> episodes, const DemoArguments& arguments,
                              const sim::Scenario& scenario, const std::vector<report::ContenderSummary>& summaries) {
  const auto not_shown = [](const report::Episode& episode) { return episode.views.empty(); };
  episodes.erase(std::remove_if(episodes.begin(), episodes.end(), not_shown), episodes.end());
  report::EpisodePage page = experiments::page_of(scenario, summaries, std::move(episodes));
  page.title = "MOVIS: approach and shoot";
  page.command = fmt::format("movis demo --episodes {} --seed {} --controllers {} --localizer {}", arguments.episodes,
                             arguments.seed, joined(arguments.controllers), arguments.localizer);
  if (arguments.scenario) page.command += " --scenario " + arguments.scenario->string();
  return page;
}

}  // namespace

void demo(const DemoArguments& arguments) {
  const sim::Scenario scenario =
      sim::read_scenario(arguments.scenario ? *arguments.scenario : data_file("scenarios/resting-ball.yaml"));
  { OutputFile can_be_written(arguments.out); }
  const auto begin = std::chrono::steady_clock::now();
  std::vector<report::Episode> episodes = play_all(scenario, arguments);
  const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  std::vector<report::ContenderSummary> summaries;
  for (const std::string& contender : arguments.controllers) {
    summaries.push_back(experiments::summarize(contender, episodes));
  }
  double played_s = 0.0;
  for (const report::Episode& episode : episodes) played_s += episode.duration_s;
  if (arguments.rows) write_rows(episodes, arguments, scenario);
  report::write_episode_page(make_page(std::move(episodes), arguments, scenario, summaries), arguments.out);

  fmt::print("{}: {} starts, seeds {}–{}\n{}", scenario.name, arguments.episodes, arguments.seed,
             arguments.seed + static_cast<std::uint64_t>(arguments.episodes) - 1, experiments::table_of(summaries));
  fmt::print("{:.0f} s of play in {:.0f} s: {:.1f} × real time\n", played_s, took_s, played_s / took_s);
  fmt::print("open in a browser: {}\n", std::filesystem::absolute(arguments.out).string());
}

}  // namespace movis::app
