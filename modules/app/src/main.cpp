#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "bound_command.h"
#include "calibrate_correction.h"
#include "calibrate_curve.h"
#include "calibrate_rig.h"
#include "demo_command.h"
#include "experiment_command.h"
#include "interrupt.h"
#include "locate_command.h"
#include "movis/core/version.h"
#include "movis/localization/localizer.h"
#include "movis/triangulation/triangulator.h"
#include "track_command.h"
#include "wrong_arguments.h"

namespace {

constexpr int kDone = 0;
constexpr int kFailed = 1;
constexpr int kWrongArguments = 2;

std::vector<std::string> localizer_names() {
  std::vector<std::string> names;
  for (const auto name : movis::localization::localizer_names()) names.emplace_back(name);
  return names;
}

std::vector<std::string> triangulator_names() {
  std::vector<std::string> names;
  for (const auto name : movis::triangulation::triangulator_names()) names.emplace_back(name);
  return names;
}

void add_track(CLI::App& program, movis::app::TrackArguments& arguments) {
  CLI::App* track = program.add_subcommand("track", "Measure ball and pose in every set of a data set");
  track->add_option("--data", arguments.data, "The data set: a folder with rig.yaml, frames.csv and images")
      ->required();
  track->add_option("--out", arguments.out, "The estimates, a CSV file")->required();
  track->add_option("--page", arguments.page, "An HTML page of what was seen and measured");
  track->add_option("--obstacles", arguments.obstacles, "What hides the floor in every set, a CSV file");
  track->add_option("--rig", arguments.rig, "Another rig than the data set's rig.yaml");
  track->add_option("--field", arguments.field, "Another field than the data set's field.yaml");
  track->add_option("--colours", arguments.colours, "Colour classes; default: data/colours/default.yaml");
  track->add_option("--correction", arguments.correction, "Error correction: of movis calibrate correction");
  track->add_option("--options", arguments.options,
                    "Options of the stages: YAML with the maps scan, triangulation, localization, world");
  track->add_option("--triangulation", arguments.triangulation, "How bearings become points")
      ->check(CLI::IsMember(triangulator_names()))
      ->capture_default_str();
  track->add_option("--localizer", arguments.localizer, "How goals and lines become a pose")
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
  demo->add_option("--localizer", arguments.localizer, "How goals and lines become a pose")
      ->check(CLI::IsMember(localizer_names()))
      ->capture_default_str();
  demo->add_option("--rows", arguments.rows, "A CSV file, one row an episode");
  demo->callback([&arguments] { movis::app::demo(arguments); });
}

// CLI::Range, which lets nan pass, without nan.
CLI::Validator in_range(double least, double most) {
  const auto is_number = [](const std::string& text) {
    double value = 0.0;
    return CLI::detail::lexical_cast(text, value) && std::isnan(value) ? text + " is no number" : std::string();
  };
  return CLI::Range(least, most) & CLI::Validator(is_number, "");
}

constexpr const char* kPlaceSigma =
    "How exactly the known places were measured: sigma of x and of y, metres; 0: exactly";

void add_calibrate_correction(CLI::App& calibrate, movis::app::CalibrateCorrectionArguments& arguments) {
  CLI::App* correction =
      calibrate.add_subcommand("correction", "The error correction of the bearings, from balls at known places");
  correction->add_option("--data", arguments.data, "The data set: balls near and far all around, with truth.csv")
      ->required();
  correction->add_option("--out", arguments.out, "The correction, a YAML file for movis track --correction")
      ->required();
  correction->add_option("--rig", arguments.rig, "Another rig than the data set's rig.yaml");
  correction->add_option("--place-sigma", arguments.place_sigma, kPlaceSigma)
      ->check(in_range(0.0, 0.1))
      ->capture_default_str();
  correction->add_option("--colours", arguments.colours, "Colour classes; default: data/colours/default.yaml");
  correction->add_option("--options", arguments.options, "Options of the scan: YAML, as for movis track");
  correction->callback([&arguments] { movis::app::calibrate_correction(arguments); });
}

void add_calibrate_rig(CLI::App& calibrate, movis::app::CalibrateRigArguments& arguments) {
  CLI::App* rig = calibrate.add_subcommand(
      "rig", "The cameras' places and lenses, from balls at known places, or from goals and balls at unknown ones");
  rig->add_option("--data", arguments.data, "The data set: balls near and far all around; known places in truth.csv")
      ->required();
  rig->add_option("--out", arguments.out, "The calibrated rig.yaml")->required();
  rig->add_option("--rig", arguments.rig, "The nominal rig; default: the data set's rig.yaml");
  rig->add_option("--place-sigma", arguments.place_sigma, kPlaceSigma)->check(in_range(0.0, 0.1));
  rig->add_flag("--self", arguments.self, "Use no known places even where there is a truth.csv");
  rig->add_option("--field", arguments.field, "For --self: another field than the data set's field.yaml");
  rig->add_option("--colours", arguments.colours, "Colour classes; default: data/colours/default.yaml");
  rig->add_option("--options", arguments.options, "YAML with the maps scan, calibration");
  rig->callback([&arguments] { movis::app::calibrate_rig(arguments); });
}

void add_calibrate_curve(CLI::App& calibrate, movis::app::CalibrateCurveArguments& arguments) {
  CLI::App* curve = calibrate.add_subcommand(
      "curve", "The curve and image centre of a radial camera, from the white-line pixels of one picture");
  curve->add_option("--points", arguments.points, "The pixels: `column row` a line")->required();
  curve->add_option("--rig", arguments.rig, "The rig to start from")->required();
  curve->add_option("--field", arguments.field, "The field whose lines they are")->required();
  curve->add_option("--out", arguments.out, "The calibrated rig.yaml")->required();
  curve->add_option("--camera", arguments.camera, "Which one saw the pixels; needed where the rig has several");
  curve->add_flag("--holdout", arguments.holdout, "Also fit to every second pixel alone and measure the others");
  curve->callback([&arguments] { movis::app::calibrate_curve(arguments); });
}

void add_calibrate(CLI::App& program, movis::app::CalibrateRigArguments& rig,
                   movis::app::CalibrateCorrectionArguments& correction, movis::app::CalibrateCurveArguments& curve) {
  CLI::App* calibrate = program.add_subcommand("calibrate", "Tell a rig's individual differences from a data set");
  calibrate->require_subcommand(1);
  add_calibrate_rig(*calibrate, rig);
  add_calibrate_correction(*calibrate, correction);
  add_calibrate_curve(*calibrate, curve);
}

void add_locate(CLI::App& program, movis::app::LocateArguments& arguments) {
  CLI::App* locate = program.add_subcommand("locate", "One fix from the white-line pixels of one picture");
  locate->add_option("--points", arguments.points, "The pixels: `column row` a line")->required();
  locate->add_option("--rig", arguments.rig, "The cameras: a rig.yaml")->required();
  locate->add_option("--field", arguments.field, "The field whose lines they are")->required();
  locate->add_option("--guess", arguments.guess, "Look only around this pose: x,y,beta_deg; default: everywhere")
      ->delimiter(',')
      ->expected(3)
      ->check(in_range(-1e4, 1e4));
  locate->add_option("--camera", arguments.camera, "Which one saw the pixels; needed where the rig has several");
  locate->callback([&arguments] { movis::app::locate(arguments); });
}

void add_bound(CLI::App& program, movis::app::BoundArguments& arguments) {
  movis::triangulation::BoundMapOptions& options = arguments.options;
  CLI::App* bound = program.add_subcommand("bound", "Map how well a rig can measure a ball at best (Cramér–Rao)");
  bound->add_option("--rig", arguments.rig, "The cameras: a rig.yaml")->required();
  bound->add_option("--out", arguments.out, "The map, a CSV file")->required();
  bound->add_option("--page", arguments.page, "An HTML page with maps");
  const auto add = [&](const char* name, double& target, double least, double most, const char* text) {
    bound->add_option(name, target, text)->check(in_range(least, most))->capture_default_str();
  };
  add("--contrast", options.picture.contrast, 0.001, 450.0,
      "Between ball and surroundings, grey levels; root of the sum of squares over three channels");
  add("--noise", options.picture.noise, 0.001, 255.0, "Sigma of one channel of one pixel, grey levels");
  add("--blur", options.picture.blur_px, 0.0, 100.0, "Sigma of the lens's blur, pixels");
  add("--half-width", options.half_width, 0.01, 100.0, "Of the square floor around the robot, metres");
  add("--step", options.step, 0.001, 100.0, "Between the map's places, metres");
  add("--ball-radius", options.ball_radius, 0.001, 10.0, "Metres");
  bound->add_option("--height", arguments.height, "Of the ball's centre, metres; default: it lies on the floor")
      ->check(in_range(0.0, 100.0));
  add("--floor-sigma", options.floor_sigma, 0.0, 10.0, "How well that height is known where it is, metres; 0: exactly");
  bound->add_flag("--diameter", options.diameter, "The ball's apparent size tells its distance too");
  bound->add_flag("--free", arguments.free, "Table and page begin with a height that is not known");
  bound->callback([&arguments] { movis::app::bound(arguments); });
}

void add_experiment(CLI::App& program, movis::app::ExperimentArguments& arguments) {
  CLI::App* experiment = program.add_subcommand("experiment", "Run an experiment; its rows, summary and page");
  experiment->add_option("experiment", arguments.experiment, "A name in data/experiments, or a YAML file")->required();
  experiment->add_option("--out", arguments.out, "The folder of the results; default: movis-NAME");
  const CLI::Range whole_numbers(std::int64_t{0}, std::int64_t{1} << 53);
  CLI::Option* seed = experiment->add_option("--seed", arguments.seed, "Of all that is drawn at random")
                          ->check(whole_numbers)
                          ->capture_default_str();
  CLI::Option* jobs = experiment->add_option("--jobs", arguments.jobs, "Threads; default: as many as there are cores")
                          ->check(CLI::Range(1, 1024));
  experiment->add_flag("--quick", arguments.quick, "A small version, in seconds");
  CLI::Option* resume = experiment->add_flag("--resume", arguments.resume, "Go on with the rows that the folder holds");
  experiment->add_option("--replay", arguments.replay, "Recompute this row alone and print it beside the stored one")
      ->check(whole_numbers)
      ->excludes(seed)
      ->excludes(jobs)
      ->excludes(resume);
  experiment->callback([&arguments] { movis::app::experiment(arguments); });
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
  movis::app::CalibrateRigArguments rig_arguments;
  movis::app::CalibrateCorrectionArguments correction_arguments;
  movis::app::CalibrateCurveArguments curve_arguments;
  add_calibrate(program, rig_arguments, correction_arguments, curve_arguments);
  movis::app::LocateArguments locate_arguments;
  add_locate(program, locate_arguments);
  movis::app::BoundArguments bound_arguments;
  add_bound(program, bound_arguments);
  movis::app::ExperimentArguments experiment_arguments;
  add_experiment(program, experiment_arguments);
  try {
    program.parse(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
      std::fprintf(stderr, "movis: standard output cannot be written; is the disk full?\n");
      return kFailed;
    }
    return kDone;
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kWrongArguments;
  } catch (const movis::app::WrongArguments& error) {
    std::fprintf(stderr, "movis: %s\n", error.what());
    return kWrongArguments;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "movis: %s\n", error.what());
    return kFailed;
  }
}
