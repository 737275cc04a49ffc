#include "calibrate_curve.h"

#include <fmt/format.h>

#include "line_pixels.h"
#include "movis/calibration/curve_calibration.h"
#include "movis/core/error.h"
#include "movis/core/output_file.h"
#include "outputs.h"

namespace movis::app {
namespace {

using Pixels = std::vector<Eigen::Vector2d>;

std::string curve_text(const omni::Camera& camera) {
  const auto& model = std::get<omni::Radial>(camera.model);
  return fmt::format("a {:.5f} m, b {:.7f}, centre {:.2f} {:.2f} px", model.a, model.b, model.u0, model.v0);
}

// Throws where the curve does not help pixels that it was not fitted to.
void check_holdout(const Pixels& pixels, const omni::Camera& start, const localization::FieldMap& map) {
  Pixels used, held_out;
  for (std::size_t i = 0; i < pixels.size(); ++i) (i % 2 == 0 ? used : held_out).push_back(pixels[i]);
  const calibration::CurveCalibration half = calibration::calibrate_curve(used, start, map);
  const double before = calibration::median_distance(held_out, start, half.before.fix.world_from_robot, map);
  const double after = calibration::median_distance(held_out, half.camera, half.world_from_robot, map);
  fmt::print("held out  {} pixels: median {:.4f} m before, {:.4f} m after (fitted to the other half)\n",
             held_out.size(), before, after);
  if (after > before) {
    throw Error(
        "the curve fitted to one half of the pixels leaves the other half farther from the lines than before "
        "({:.4f} m, not {:.4f} m): it is no better than the start; keep that, or give more pixels",
        after, before);
  }
}

}  // namespace

void calibrate_curve(const CalibrateCurveArguments& arguments) {
  omni::Rig rig = omni::read_rig(arguments.rig);
  const localization::FieldMap map(read_field(arguments.field));
  omni::Camera& camera = rig.cameras[choose_camera(rig, arguments.camera, arguments.rig)];
  const Pixels pixels = read_line_pixels(arguments.points, camera);
  refuse_to_overwrite({{"--out", arguments.out}}, files_of(rig, arguments.rig), {arguments.points, arguments.field});
  { const OutputFile writable(arguments.out); }  // throws now, not after the fit

  const calibration::CurveCalibration result = calibration::calibrate_curve(pixels, camera, map);
  const std::string medians =
      fmt::format("median {:.4f} m before, {:.4f} m after", result.before.median, result.after.median);
  fmt::print("start     {}\ncurve     {}\nused      {} of {} pixels: {}\n", curve_text(camera),
             curve_text(result.camera), result.pixels, pixels.size(), medians);
  if (arguments.holdout) check_holdout(pixels, camera, map);
  camera = result.camera;
  omni::write_rig(rig, arguments.out,
                  {fmt::format("Curve of camera {} calibrated from {} white-line pixels, distance from the lines: {}.",
                               camera.name, result.pixels, medians)});
  fmt::print("rig: {}\n", arguments.out.string());
}

}  // namespace movis::app
