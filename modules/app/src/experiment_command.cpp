#include "experiment_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "interrupt.h"
#include "movis/core/error.h"
#include "movis/core/names.h"
#include "movis/core/paths.h"
#include "movis/core/yaml.h"
#include "movis/experiments/measurement_summary.h"
#include "movis/experiments/self_localization.h"
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

std::string command_of(const ExperimentArguments& arguments) {
  return fmt::format("build/bin/movis experiment {} --seed {}{}", arguments.experiment, arguments.seed,
                     arguments.quick ? " --quick" : "");
}

// What every experiment can do.
struct Experiment {
  std::string name;
  std::size_t blocks = 0;
  std::function<experiments::ReplayedRow(std::int64_t row, const fs::path& folder)> replay;
  // Writes the three files; returns the number of rows and what to say of them.
  std::function<std::pair<std::size_t, std::string>(const experiments::ExperimentRun& run, const fs::path& folder,
                                                    const std::string& command)>
      run;
};

Experiment measurement(const fs::path& file, bool quick) {
  const experiments::MeasurementSettings settings = experiments::read_measurement(file, quick);
  const auto run = [settings](const experiments::ExperimentRun& how, const fs::path& folder,
                              const std::string& command) {
    const std::vector<experiments::MeasurementRow> rows = experiments::run_measurement(settings, how, folder);
    const auto summary = experiments::summarize_measurement(settings, how.seed, rows);
    experiments::write_summary(summary, folder / "summary.json");
    experiments::write_page(summary, command, folder / "index.html");
    std::string text = fmt::format("{}: {} points, {} under the robot left out; seed {}\n{}", settings.name,
                                   summary.lattice.points.size(), summary.lattice.under_robot, how.seed,
                                   experiments::table_of(summary));
    for (const experiments::Finding& finding : summary.findings) {
      text += finding.topic + '\n';
      for (const std::string& sentence : finding.sentences) text += "  - " + sentence + '\n';
    }
    return std::pair{rows.size(), text};
  };
  const auto replay = [settings](std::int64_t row, const fs::path& folder) {
    return experiments::replay_measurement(settings, row, folder);
  };
  return {settings.name, experiments::blocks_of(settings).size(), replay, run};
}

Experiment self_localization(const fs::path& file, bool quick) {
  const experiments::SelfLocalizationSettings settings = experiments::read_self_localization(file, quick);
  const auto run = [settings](const experiments::ExperimentRun& how, const fs::path& folder,
                              const std::string& command) {
    const auto rows = experiments::run_self_localization(settings, how, folder);
    const auto summary = experiments::summarize_self_localization(settings, how.seed, rows);
    experiments::write_summary(summary, folder / "summary.json");
    experiments::write_page(summary, command, folder / "index.html");
    return std::pair{
        rows.size(),
        fmt::format("{}: {} spots, {} headings; {} draws with coloured goals, {} with white ones; seed {}\n{}",
                    settings.name, settings.spots.size(), settings.headings(), settings.coloured_draws,
                    settings.white_draws, how.seed, experiments::table_of(summary))};
  };
  const auto replay = [settings](std::int64_t row, const fs::path& folder) {
    return experiments::replay_self_localization(settings, row, folder);
  };
  return {settings.name, experiments::blocks_of(settings).size(), replay, run};
}

Experiment read_experiment(const fs::path& file, bool quick) {
  const std::string kind = YamlMap::read(file).one_of("experiment", {"measurement", "self-localization"});
  return kind == "measurement" ? measurement(file, quick) : self_localization(file, quick);
}

void replay(const Experiment& experiment, std::int64_t row, const fs::path& folder) {
  const experiments::ReplayedRow replayed = experiment.replay(row, folder);
  fmt::print("            {}\nstored      {}\nrecomputed  {}\n", replayed.header, replayed.stored, replayed.recomputed);
  if (replayed.stored == replayed.recomputed) return;
  throw Error("row {} comes out differently: another build, another machine's arithmetic, or a changed file", row);
}

}  // namespace

void experiment(const ExperimentArguments& arguments) {
  const Experiment experiment = read_experiment(file_of(arguments.experiment), arguments.quick);
  const fs::path folder = arguments.out.value_or(fs::path("movis-" + experiment.name));
  if (arguments.replay) {
    replay(experiment, *arguments.replay, folder);
    return;
  }
  const auto begin = std::chrono::steady_clock::now();
  Progress progress("draws of rigs", experiment.blocks);
  experiments::ExperimentRun run;
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
  const auto [rows, text] = experiment.run(run, folder, command_of(arguments));
  progress.finish();
  fmt::print("{}{} rows in {:.0f} s; open in a browser: {}\n", text, rows,
             std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
             fs::absolute(folder / "index.html").string());
}

}  // namespace movis::app
