#include <fmt/format.h>

#include <cmath>

#include "drawn_rig.h"
#include "movis/core/yaml.h"
#include "movis/experiments/measurement.h"
#include "movis/sim/scene.h"
#include "settings_file.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

void read_rigs(const YamlMap& map, MeasurementSettings& settings, Digest& digest) {
  constexpr std::array<const char*, kRigs> kKeys{"single", "vertical", "vertical_short", "movis"};
  constexpr std::array<std::size_t, kRigs> kCameras{1, 2, 2, 3};
  map.allow({"single", "vertical", "vertical_short", "movis"});
  for (std::size_t i = 0; i < kRigs; ++i) {
    settings.rigs[i] = omni::read_rig(named_file(map, kKeys[i], digest));
    if (settings.rigs[i].cameras.size() != kCameras[i]) {
      map.fail(kKeys[i], fmt::format("has {} cameras; it must have {}", settings.rigs[i].cameras.size(), kCameras[i]));
    }
    for (const omni::Camera& camera : settings.rigs[i].cameras) {
      if (camera.position.z() > sim::kBallRadius) continue;
      map.fail(kKeys[i], fmt::format("has camera '{}' no higher than the ball's centre, {} m; raise it", camera.name,
                                     sim::kBallRadius));
    }
  }
}

constexpr Range kStep{0.05, 4.0};  // metres

void read_bearings(const YamlMap& map, MeasurementSettings& settings) {
  map.allow({"draws", "detector_factor", "contrast", "noise", "blur_px"});
  map.read_integer("draws", kDraws, settings.bearing_draws);
  map.read_number("detector_factor", {0.1, 100.0}, settings.detector_factor);
  map.read_number("contrast", {1.0, 442.0}, settings.picture.contrast);
  map.read_number("noise", {0.01, 100.0}, settings.picture.noise);
  map.read_number("blur_px", {0.0, 10.0}, settings.picture.blur_px);
}

void read_quick(const YamlMap& map, MeasurementSettings& settings) {
  map.allow({"step", "alone_step", "calibration_points", "bearing_draws", "image_draws", "alone_draws"});
  map.read_number("step", kStep, settings.step);
  map.read_number("alone_step", kStep, settings.alone_step);
  map.read_integer("calibration_points", {1, 1000}, settings.calibration_points);
  map.read_integer("bearing_draws", kDraws, settings.bearing_draws);
  map.read_integer("image_draws", kDraws, settings.image_draws);
  map.read_integer("alone_draws", kDraws, settings.alone_draws);
}

void check_draws(const YamlMap& map, const MeasurementSettings& settings) {
  if (settings.bearing_draws + settings.image_draws + settings.alone_draws > 0) return;
  map.fail("has 0 draws of bearings, of images and of one_difference: nothing to measure; raise one of them");
}

void check_steps(const YamlMap& map, const MeasurementSettings& settings) {
  for (const double step : {settings.step, settings.alone_step}) {
    const double steps = settings.half_width / step;
    if (std::abs(steps - std::round(steps)) < 1e-9 && steps > 0.5) continue;
    map.fail(fmt::format("a step of {} m does not divide the lattice's half width of {} m; choose one that does", step,
                         settings.half_width));
  }
  if (clearance_of(settings.robot.radius) > settings.half_width) {
    map.fail("lattice",
             fmt::format("has a half width of {} m, of which the robot, {} m in radius, and a ball beside it "
                         "cover {} m; raise half_width, or name a smaller robot",
                         settings.half_width, settings.robot.radius, clearance_of(settings.robot.radius)));
  }
  const double corner = settings.half_width * std::sqrt(2.0) + sim::kBallRadius;
  if (corner > settings.look.hall_half_width * std::sqrt(2.0)) {
    map.fail("lattice", fmt::format("reaches beyond the look's hall, whose walls are {} m from the centre",
                                    settings.look.hall_half_width));
  }
}

}  // namespace

MeasurementSettings read_measurement(const fs::path& file, bool quick) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"experiment", "rigs", "robot", "look", "colours", "lattice", "calibration_points", "bearings", "images",
             "one_difference", "differences", "quick"});
  map.one_of("experiment", {"measurement"});
  Digest digest;
  digest.add_file(file);
  digest.add(quick ? "quick" : "");
  MeasurementSettings settings;
  settings.name = file.stem().string();
  read_rigs(map.map("rigs"), settings, digest);
  settings.robot = control::read_robot(named_file(map, "robot", digest));
  settings.look = sim::read_look(named_file(map, "look", digest));
  settings.colours = scan::read_colours(named_file(map, "colours", digest));
  if (map.has("lattice")) {
    const YamlMap lattice = map.map("lattice");
    lattice.allow({"half_width", "step"});
    lattice.read_number("half_width", {0.5, 30.0}, settings.half_width);
    lattice.read_number("step", kStep, settings.step);
  }
  map.read_integer("calibration_points", {1, 1000}, settings.calibration_points);
  if (map.has("bearings")) read_bearings(map.map("bearings"), settings);
  if (map.has("images")) {
    const YamlMap images = map.map("images");
    images.allow({"draws"});
    images.read_integer("draws", kDraws, settings.image_draws);
  }
  if (map.has("one_difference")) {
    const YamlMap alone = map.map("one_difference");
    alone.allow({"draws", "step"});
    alone.read_integer("draws", kDraws, settings.alone_draws);
    alone.read_number("step", kStep, settings.alone_step);
  }
  if (map.has("differences")) read_differences(map.map("differences"), settings.differences);
  if (map.has("quick")) {
    MeasurementSettings checked = settings;  // also where it is not asked for
    read_quick(map.map("quick"), quick ? settings : checked);
  }
  check_draws(map, settings);
  check_steps(map, settings);
  settings.digest = digest.text();
  return settings;
}

}  // namespace movis::experiments
