#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>

#include "demo_command.h"
#include "interrupt.h"
#include "movis/core/version.h"
#include "movis/localization/localizer.h"
#include "track_command.h"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongArguments = 2;

std::vector<std::string> localizer_names() {
  std::vector<std::string> names;
  for (const auto name : movis::localization::localizer_names()) names.emplace_back(name);
  return names;
}

void add_track(CLI::App& program, movis::app::TrackArguments& arguments) {
  CLI::App* track = program.add_subcommand("track", "Measure ball and pose in every set of a data set");
  track->add_option("--data", arguments.data, "The data set: a folder with rig.yaml, frames.csv and images")
      ->required();
  track->add_option("--out", arguments.out, "The estimates, a CSV file")->required();
  track->add_option("--page", arguments.page, "An HTML page of what was seen and measured");
  track->add_option("--rig", arguments.rig, "Another rig than the data set's rig.yaml");
  track->add_option("--field", arguments.field, "Another field than the data set's field.yaml");
  track->add_option("--colours", arguments.colours, "Colour classes; default: data/colours/default.yaml");
  track->add_option("--options", arguments.options,
                    "Options of the stages: YAML with the maps scan, triangulation, world");
  track->add_option("--triangulation", arguments.triangulation, "How bearings become points")
      ->check(CLI::IsMember({"pairs"}))
      ->capture_default_str();
  track->add_option("--localizer", arguments.localizer, "How goals become a pose")
      ->check(CLI::IsMember(localizer_names()))
      ->capture_default_str();
  track->callback([&arguments] { movis::app::track(arguments); });
}

void add_demo(CLI::App& program, movis::app::DemoArguments& arguments) {
  CLI::App* demo = program.add_subcommand("demo", "Play approach-and-shoot on rendered images; one HTML page about it");
  demo->add_option("--out", arguments.out, "The page")->capture_default_str();
  demo->add_option("--episodes", arguments.episodes,
                   "Starts; every controller plays each of them, the page shows the first six")
      ->check(CLI::Range(1, 2000))
      ->capture_default_str();
  demo->add_option("--seed", arguments.seed, "Of the first start; the others count on from it")
      ->check(CLI::Range(std::int64_t{0}, std::int64_t{1} << 53))
      ->capture_default_str();
  demo->add_option("--scenario", arguments.scenario,
                   "What is played: a scenario.yaml; default: data/scenarios/resting-ball.yaml");
  demo->add_option("--controllers", arguments.controllers,
                   "fuzzy[:controller.yaml] and pbvs[:pbvs.yaml], separated by commas")
      ->delimiter(',')
      ->capture_default_str();
  demo->add_option("--localizer", arguments.localizer, "How goals become a pose")
      ->check(CLI::IsMember(localizer_names()))
      ->capture_default_str();
  demo->add_option("--rows", arguments.rows, "A CSV file, one row an episode");
  demo->callback([&arguments] { movis::app::demo(arguments); });
}

}  // namespace

int main(int argc, char** argv) {
  movis::app::catch_interrupts();
  CLI::App program("MOVIS: omnidirectional vision of mobile robots. File formats and statuses: docs/files.md");
  program.set_version_flag("--version", std::string("movis ") + movis::version());
  program.require_subcommand(1);
  movis::app::DemoArguments demo_arguments;
  add_demo(program, demo_arguments);
  movis::app::TrackArguments track_arguments;
  add_track(program, track_arguments);
  try {
    program.parse(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::fprintf(stderr, "movis: standard output cannot be written; is the disk full?\n");
      return kFailed;
    }
    return kDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kWrongArguments;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "movis: %s\n", error.what());
    return kFailed;
  }
}
