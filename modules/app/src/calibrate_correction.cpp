#include "calibrate_correction.h"

#include <fmt/format.h>

#include <vector>

#include "interrupt.h"
#include "movis/calibration/correction_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset.h"
#include "movis/grab/truth.h"
#include "movis/pipeline/pipeline.h"
#include "outputs.h"
#include "progress.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

void print_table(const calibration::CorrectionFit& fit) {
  fmt::print("            azimuth, rms                          elevation, rms\n");
  fmt::print("            before °  after °  left °  terms      before °  after °  left °  terms\n");
  for (std::size_t i = 0; i < fit.correction.cameras.size(); ++i) {
    const triangulation::CameraCorrection& camera = fit.correction.cameras[i];
    fmt::print("  {:<8}  {:>8.4f} {:>8.4f} {:>7.4f} {:>6}      {:>8.4f} {:>8.4f} {:>7.4f} {:>6}\n", camera.camera,
               degrees(fit.azimuth_rms_before[i]), degrees(fit.azimuth_rms[i]), degrees(camera.azimuth_sigma),
               camera.azimuth.size(), degrees(fit.elevation_rms_before[i]), degrees(fit.elevation_rms[i]),
               degrees(camera.elevation_sigma), camera.elevation.size());
  }
  fmt::print("  after: of balls that the fit did not know (cross-validated); left: beyond the bearings' own sigma\n");
}

void print_rejected(const calibration::CorrectionFit& fit) {
  for (const calibration::RejectedSighting& rejected : fit.rejected) {
    const std::string who = rejected.camera < 0 ? "" : ", " + fit.correction.cameras[rejected.camera].camera;
    fmt::print("  left out: frame {}{}: {}\n", rejected.frame, who, rejected.reason);
  }
}

}  // namespace

void calibrate_correction(const CalibrateCorrectionArguments& arguments) {
  const grab::Dataset dataset = grab::read_dataset(arguments.data, arguments.rig);
  const fs::path truth_file = arguments.data / "truth.csv";
  if (!fs::exists(truth_file)) {
    throw Error("{}: is missing; the correction is fitted to balls at known places, which stand there",
                truth_file.string());
  }
  const calibration::KnownPlaces places = calibration::known_places(grab::read_truth(truth_file), truth_file);
  refuse_to_overwrite({{"--out", arguments.out}}, files_of(dataset), {arguments.colours, arguments.options});
  const scan::Colours colours =
      scan::read_colours(arguments.colours ? *arguments.colours : data_file("colours/default.yaml"));
  const pipeline::Options options =
      arguments.options ? pipeline::read_options(*arguments.options) : pipeline::Options{};

  Progress progress("calibrate correction", dataset.frames.size());
  const calibration::Sightings sightings =
      calibration::collect_sightings(dataset, dataset.rig, colours, options.scan, places, [&] {
        check_interrupts();
        progress.advance();
      });
  progress.finish();
  const calibration::CorrectionFit fit = calibration::fit_correction(sightings, {arguments.place_sigma});
  triangulation::write_correction(fit.correction, arguments.out);

  fmt::print("error correction from {} sets of {} images\n", dataset.frames.size(), dataset.rig.cameras.size());
  print_table(fit);
  print_rejected(fit);
  fmt::print("correction: {}\n", arguments.out.string());
}

}  // namespace movis::app
