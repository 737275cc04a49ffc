#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "measurement_bench.h"
#include "movis/core/angle.h"
#include "movis/core/yaml.h"
#include "movis/experiments/measurement.h"
#include "movis/sim/scene.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo), of what the settings were read from.
class Digest {
 public:
  void add(const std::string& bytes) {
    for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  }
  void add_file(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    add(std::string(std::istreambuf_iterator<char>(stream), {}));
  }
  std::string text() const { return fmt::format("{:016x}", value_); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

fs::path named_file(const YamlMap& map, const char* key, Digest& digest) {
  fs::path file = map.file().parent_path() / map.text(key);
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    map.fail(key, fmt::format("names {}, which is a folder; name a YAML file", file.string()));
  }
  if (!fs::exists(file, ignored)) {
    map.fail(key, fmt::format("names {}, which does not exist; paths are relative to the experiment's folder",
                              file.string()));
  }
  digest.add_file(file);
  return file;
}

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

void read_differences(const YamlMap& map, omni::Deviation& sigma) {
  map.allow({"position", "yaw_deg", "tilt_deg", "focal", "principal_point_px"});
  const auto read = [&](const char* key, Range range, double unit, int first, int count) {
    if (map.has(key)) sigma.segment(first, count).setConstant(unit * map.number(key, range));
  };
  read("position", {0.0, 0.05}, 1.0, 0, 3);
  read("yaw_deg", {0.0, 10.0}, radians(1.0), 3, 1);
  read("tilt_deg", {0.0, 5.0}, radians(1.0), 4, 2);
  read("focal", {0.0, 0.1}, 1.0, 6, 1);
  read("principal_point_px", {0.0, 20.0}, 1.0, 7, 2);
}

constexpr Range kDraws{0, 10000};
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
  if (clearance_of(settings) > settings.half_width) {
    map.fail("lattice",
             fmt::format("has a half width of {} m, of which the robot, {} m in radius, and a ball beside it "
                         "cover {} m; raise half_width, or name a smaller robot",
                         settings.half_width, settings.robot.radius, clearance_of(settings)));
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
