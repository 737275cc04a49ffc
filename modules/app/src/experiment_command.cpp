#include "experiment_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "interrupt.h"
#include "movis/core/error.h"
#include "movis/core/names.h"
#include "movis/core/paths.h"
#include "movis/experiments/measurement_summary.h"
#include "progress.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

// A name means a file in data/experiments; what ends in .yaml or .yml is a file of one's own.
fs::path file_of(const std::string& experiment) {
  const fs::path given(experiment);
  if (given.extension() == ".yaml" || given.extension() == ".yml") return given;
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(data_file("experiments"))) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  if (std::find(names.begin(), names.end(), experiment) != names.end()) {
    return data_file("experiments") / (experiment + ".yaml");
  }
  throw Error("there is no experiment '{}'{}; or name a YAML file", experiment, suggestion(experiment, names));
}

fs::path folder_of(const ExperimentArguments& arguments, const std::string& name) {
  return arguments.out.value_or(fs::path("movis-" + name));
}

std::string command_of(const ExperimentArguments& arguments) {
  return fmt::format("build/bin/movis experiment {} --seed {}{}", arguments.experiment, arguments.seed,
                     arguments.quick ? " --quick" : "");
}

void replay(const experiments::MeasurementSettings& settings, std::int64_t row, const fs::path& folder) {
  const experiments::ReplayedRow replayed = experiments::replay_measurement(settings, row, folder);
  fmt::print("            {}\nstored      {}\nrecomputed  {}\n", replayed.header, replayed.stored, replayed.recomputed);
  if (replayed.stored == replayed.recomputed) return;
  throw Error("row {} comes out differently: another build, another machine's arithmetic, or a changed file", row);
}

std::vector<experiments::MeasurementRow> run(const experiments::MeasurementSettings& settings,
                                             const ExperimentArguments& arguments, const fs::path& folder) {
  Progress progress("draws of rigs", experiments::blocks_of(settings).size());
  experiments::MeasurementRun run;
  run.seed = static_cast<std::uint64_t>(arguments.seed);
  run.jobs = arguments.jobs > 0 ? arguments.jobs : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  run.resume = arguments.resume;
  run.progress = [&](std::size_t, std::size_t) {
    progress.advance();
    try {
      check_interrupts();
    } catch (const Error&) {
      throw Error("interrupted; {} holds what is finished: the same command with --resume goes on",
                  (folder / "rows.csv").string());
    }
  };
  return experiments::run_measurement(settings, run, folder);
}

}  // namespace

void experiment(const ExperimentArguments& arguments) {
  const experiments::MeasurementSettings settings =
      experiments::read_measurement(file_of(arguments.experiment), arguments.quick);
  const fs::path folder = folder_of(arguments, settings.name);
  if (arguments.replay) {
    replay(settings, *arguments.replay, folder);
    return;
  }
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<experiments::MeasurementRow> rows = run(settings, arguments, folder);
  const auto seed = static_cast<std::uint64_t>(arguments.seed);
  const experiments::MeasurementSummary summary = experiments::summarize_measurement(settings, seed, rows);
  experiments::write_summary(summary, folder / "summary.json");
  experiments::write_page(summary, command_of(arguments), folder / "index.html");
  fmt::print("{}: {} points, {} under the robot left out; seed {}\n{}", settings.name, summary.lattice.points.size(),
             summary.lattice.under_robot, arguments.seed, experiments::table_of(summary));
  for (const experiments::Finding& finding : summary.findings) {
    fmt::print("{}\n", finding.topic);
    for (const std::string& sentence : finding.sentences) fmt::print("  - {}\n", sentence);
  }
  fmt::print("{} rows in {:.0f} s; open in a browser: {}\n", rows.size(),
             std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
             fs::absolute(folder / "index.html").string());
}

}  // namespace movis::app
