#include "calibrate_command.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "interrupt.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset.h"
#include "movis/grab/truth.h"
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

// The recording is worth more than what is made of it.
void refuse_to_overwrite_input(const CalibrateRigArguments& arguments, const grab::Dataset& dataset) {
  std::vector<fs::path> inputs{dataset.rig_file, dataset.folder / "frames.csv", dataset.folder / "truth.csv",
                               dataset.folder / "field.yaml"};
  for (const auto& file : {arguments.field, arguments.colours, arguments.options}) {
    if (file) inputs.push_back(*file);
  }
  for (const omni::Camera& camera : dataset.rig.cameras) inputs.push_back(camera.mask);
  for (const grab::DatasetFrame& frame : dataset.frames) {
    for (const grab::DatasetImage& image : frame.images) inputs.push_back(image.file);
  }
  std::error_code ignored;
  for (const fs::path& input : inputs) {
    if (input.empty() || !fs::equivalent(arguments.out, input, ignored)) continue;
    throw Error("--out {}: is the input file {}; name another file", arguments.out.string(), input.string());
  }
}

Field find_field(const CalibrateRigArguments& arguments, const grab::Dataset& dataset) {
  if (arguments.field) return read_field(*arguments.field);
  if (dataset.field_file) return read_field(*dataset.field_file);
  throw Error(
      "{}: without truth.csv a calibration needs the goals of a known field; name its file by --field, or put the "
      "balls' "
      "places into truth.csv",
      dataset.folder.string());
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
  const calibration::KnownPlaces places =
      self ? calibration::KnownPlaces{} : calibration::known_places(grab::read_truth(truth_file));
  const std::optional<Field> field =
      self ? std::optional<Field>(find_field(arguments, dataset)) : std::optional<Field>();
  const Options options = arguments.options ? read_options(*arguments.options) : Options{};
  refuse_to_overwrite_input(arguments, dataset);

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
