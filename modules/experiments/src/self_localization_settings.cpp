#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawn_rig.h"
#include "movis/core/error.h"
#include "movis/core/yaml.h"
#include "movis/experiments/self_localization.h"
#include "movis/localization/localizer.h"
#include "settings_file.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

constexpr Range kPoints{1, 1000};
constexpr Range kHeadingStep{1, 180};

void read_spots(const YamlMap& map, SelfLocalizationSettings& settings) {
  for (const YamlMap& spot : map.list_of_maps("spots")) {
    spot.allow({"name", "place"});
    const std::vector<double> place = spot.numbers("place", 2, {-50.0, 50.0});
    const Spot read{spot.text("name"), {place[0], place[1]}};
    const bool twice = std::any_of(settings.spots.begin(), settings.spots.end(),
                                   [&](const Spot& other) { return other.name == read.name; });
    if (twice) spot.fail("name", fmt::format("is '{}', as that of a spot before; give each its own", read.name));
    if (read.name.find_first_of(",\n") != std::string::npos) spot.fail("name", "has a comma or a line's end in it");
    const double r = settings.robot.radius;
    if (std::abs(place[0]) + r > settings.field.half_width || std::abs(place[1]) + r > settings.field.half_length) {
      spot.fail("place", fmt::format("puts the robot, {} m in radius, beyond the field's lines, {} m × {} m from the "
                                     "centre spot; move it inwards",
                                     r, settings.field.half_width, settings.field.half_length));
    }
    settings.spots.push_back(read);
  }
  if (settings.spots.empty()) map.fail("spots", "is empty; give it at least one spot");
}

void read_calibration(const YamlMap& map, SelfLocalizationSettings& settings) {
  map.allow({"points", "half_width"});
  map.read_integer("points", kPoints, settings.calibration_points);
  map.read_number("half_width", {0.5, 30.0}, settings.calibration_half_width);
}

void read_quick(const YamlMap& map, SelfLocalizationSettings& settings) {
  map.allow({"heading_step_deg", "calibration_points", "coloured_draws", "white_draws"});
  map.read_integer("heading_step_deg", kHeadingStep, settings.heading_step_deg);
  map.read_integer("calibration_points", kPoints, settings.calibration_points);
  map.read_integer("coloured_draws", kDraws, settings.coloured_draws);
  map.read_integer("white_draws", kDraws, settings.white_draws);
}

void check(const YamlMap& map, const SelfLocalizationSettings& settings) {
  if (360 % settings.heading_step_deg != 0) {
    map.fail("heading_step_deg", fmt::format("is {}, which does not divide 360", settings.heading_step_deg));
  }
  if (settings.coloured_draws + settings.white_draws == 0) {
    map.fail("has 0 coloured_draws and 0 white_draws: nothing to measure; raise one of them");
  }
  if (clearance_of(settings.robot.radius) > settings.calibration_half_width) {
    map.fail("calibration", fmt::format("has a half width of {} m, of which the robot and a ball beside it cover {} m; "
                                        "raise it",
                                        settings.calibration_half_width, clearance_of(settings.robot.radius)));
  }
}

}  // namespace

SelfLocalizationSettings read_self_localization(const fs::path& file, bool quick) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"experiment", "rig", "robot", "look", "colours", "field", "spots", "heading_step_deg", "triangulation",
             "calibration", "coloured_draws", "white_draws", "differences", "quick"});
  map.one_of("experiment", {"self-localization"});
  Digest digest;
  digest.add_file(file);
  digest.add(quick ? "quick" : "");
  SelfLocalizationSettings settings;
  settings.name = file.stem().string();
  settings.rig = omni::read_rig(named_file(map, "rig", digest));
  settings.robot = control::read_robot(named_file(map, "robot", digest));
  settings.look = sim::read_look(named_file(map, "look", digest));
  settings.colours = scan::read_colours(named_file(map, "colours", digest));
  settings.field = read_field(named_file(map, "field", digest));
  if (settings.field.goals != Field::Goals::coloured) {
    map.fail("field", "has white goals; name one with coloured goals: white_draws paints them white");
  }
  read_spots(map, settings);
  map.read_integer("heading_step_deg", kHeadingStep, settings.heading_step_deg);
  if (map.has("triangulation")) settings.triangulation = map.text("triangulation");
  triangulation::find_triangulator(settings.triangulation).require(settings.rig);
  if (map.has("calibration")) read_calibration(map.map("calibration"), settings);
  map.read_integer("coloured_draws", kDraws, settings.coloured_draws);
  map.read_integer("white_draws", kDraws, settings.white_draws);
  if (map.has("differences")) read_differences(map.map("differences"), settings.differences);
  if (map.has("quick")) {
    SelfLocalizationSettings checked = settings;  // also where it is not asked for
    read_quick(map.map("quick"), quick ? settings : checked);
    check(map, checked);
  }
  check(map, settings);
  settings.digest = digest.text();
  return settings;
}

const char* word(Field::Goals goals) {
  return goals == Field::Goals::coloured ? "coloured" : "white";
}

std::vector<std::string_view> localizers_for(const SelfLocalizationSettings& settings, Field::Goals goals) {
  Field field = settings.field;
  field.goals = goals;
  std::vector<std::string_view> names;
  for (const std::string_view name : localization::localizer_names()) {
    const localization::Localizer localizer = localization::find_localizer(name);
    try {
      if (localizer.require != nullptr) localizer.require(field);
      names.push_back(name);
    } catch (const Error&) {  // it cannot: no contender there
    }
  }
  return names;
}

}  // namespace movis::experiments
