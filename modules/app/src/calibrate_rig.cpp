#include "calibrate_rig.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "interrupt.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset.h"
#include "movis/grab/truth.h"
#include "outputs.h"
#include "progress.h"
#include "rig_table.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

struct Options {
  scan::ScanOptions scan;
  calibration::RigOptions calibration;
};

Options read_options(const fs::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"scan", "calibration"});
  Options options;
  if (map.has("scan")) options.scan = scan::read_scan_options(map.map("scan"));
  if (map.has("calibration")) options.calibration = calibration::read_rig_options(map.map("calibration"));
  return options;
}

Field find_field(const CalibrateRigArguments& arguments, const grab::Dataset& dataset) {
  if (arguments.field) return read_field(*arguments.field);
  if (dataset.field_file) return read_field(*dataset.field_file);
  throw Error(
      "{}: a self-calibration needs the goals of a known field; name its file by --field, or {} to calibrate from "
      "balls "
      "at known places",
      dataset.folder.string(), arguments.self ? "leave --self out" : "add a truth.csv");
}

// What is seen depends slightly on the rig that is believed: so everything happens twice, the second time seen through
// the first result.
calibration::RigCalibration calibrate_twice(const grab::Dataset& dataset, const CalibrateRigArguments& arguments,
                                            const calibration::KnownPlaces& places, const Options& options,
                                            const std::optional<Field>& field) {
  const scan::Colours colours =
      scan::read_colours(arguments.colours ? *arguments.colours : data_file("colours/default.yaml"));
  Progress progress("calibrate rig", 2 * dataset.frames.size());
  const auto calibrate = [&](const omni::Rig& believed) {
    const calibration::Sightings sightings =
        calibration::collect_sightings(dataset, believed, colours, options.scan, places, [&] {
          check_interrupts();
          progress.advance();
        });
    return field ? calibration::self_calibrate_rig(dataset.rig, sightings, *field, options.calibration)
                 : calibration::calibrate_rig(dataset.rig, sightings, options.calibration);
  };
  return calibrate(calibrate(dataset.rig).rig);
}

std::string what_was_done(const calibration::RigCalibration& result, bool self, std::size_t frames) {
  if (!self) return fmt::format("from balls at the known places of truth.csv: {} of {} frames", result.balls, frames);
  return fmt::format(
      "by itself, from balls at unknown places on the floor ({} of {} frames) and the goals of the known field ({})",
      result.balls, frames, result.goals);
}

}  // namespace

void calibrate_rig(const CalibrateRigArguments& arguments) {
  const grab::Dataset dataset = grab::read_dataset(arguments.data, arguments.rig);
  const fs::path truth_file = arguments.data / "truth.csv";
  const bool self = arguments.self || !fs::exists(truth_file);
  if (arguments.field && !self) {
    throw Error("--field {}: balls at the known places of {} calibrate without a field; add --self, or leave it out",
                arguments.field->string(), truth_file.string());
  }
  const calibration::KnownPlaces places =
      self ? calibration::KnownPlaces{} : calibration::known_places(grab::read_truth(truth_file), truth_file);
  const std::optional<Field> field =
      self ? std::optional<Field>(find_field(arguments, dataset)) : std::optional<Field>();
  Options options = arguments.options ? read_options(*arguments.options) : Options{};
  if (arguments.place_sigma) options.calibration.place_sigma = *arguments.place_sigma;
  refuse_to_overwrite({{"--out", arguments.out}}, files_of(dataset),
                      {arguments.field, arguments.colours, arguments.options});

  const calibration::RigCalibration result = calibrate_twice(dataset, arguments, places, options, field);
  const std::string done = what_was_done(result, self, dataset.frames.size());
  std::vector<std::string> comments = rig_comments(result);
  comments.insert(comments.begin(), "Calibrated " + done + ".");
  omni::write_rig(result.rig, arguments.out, comments);

  fmt::print("calibrated {}\n{}", done, rig_table(result));
  if (self) fmt::print("  turn and shift of the whole rig in the robot frame: nothing tells them, kept as drawn\n");
  fmt::print("rig: {}\n", arguments.out.string());
}

}  // namespace movis::app
