#include "movis/scan/colours.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/yaml.h"

namespace movis::scan {
namespace {

constexpr Range kFraction{0.0, 1.0};
constexpr double kNarrowestDeg = 1.0;  // hue borders are kept to 0.45°

void read_bounds(const YamlMap& map, const char* key, double& min, double& max) {
  const std::vector<double> bounds = map.numbers(key, 2, kFraction);
  min = bounds[0];
  max = bounds[1];
  constexpr double kGreyLevel = 1.0 / 255.0;
  if (!(max - min >= kGreyLevel)) map.fail(key, "must be [smaller, larger], at least 1/255 apart");
}

ColourClass read_class(const YamlMap& map, ObjectClass object) {
  if (object == ObjectClass::field || object == ObjectClass::line) {
    map.allow({"hue_deg", "chroma", "brightness", "typical"});
  } else {
    map.allow({"hue_deg", "chroma", "brightness"});
  }
  ColourClass colour;
  colour.object = object;
  const std::vector<double> hue = map.numbers("hue_deg", 2, {-360.0, 360.0});
  const double width_deg = std::fmod(hue[1] - hue[0] + 720.0, 360.0);
  const bool all_hues = hue[1] - hue[0] == 360.0;
  if (!all_hues && !(width_deg >= kNarrowestDeg && width_deg < 180.0)) {
    map.fail("hue_deg",
             "must span from 1° to less than 180°, counter-clockwise from the first to the second, or be [0, 360]");
  }
  colour.hue_from = all_hues ? 0.0 : radians(std::fmod(hue[0] + 360.0, 360.0));
  colour.hue_width = all_hues ? 2.0 * kPi : radians(width_deg);
  read_bounds(map, "chroma", colour.chroma_min, colour.chroma_max);
  read_bounds(map, "brightness", colour.brightness_min, colour.brightness_max);
  return colour;
}

// What is wrong about a colour of the class; empty where nothing is. Red, green, blue in bytes.
std::string outside(const ColourClass& colour, const Eigen::Vector3d& rgb) {
  const double brightness = rgb.maxCoeff() / 255.0;
  const double chroma = brightness - rgb.minCoeff() / 255.0;
  const auto within = [](double value, double min, double max) { return value >= min && value <= max; };
  if (!within(brightness, colour.brightness_min, colour.brightness_max)) {
    return fmt::format("brightness {:.3f}, outside [{}, {}]", brightness, colour.brightness_min, colour.brightness_max);
  }
  if (!within(chroma, colour.chroma_min, colour.chroma_max)) {
    return fmt::format("chroma {:.3f}, outside [{}, {}]", chroma, colour.chroma_min, colour.chroma_max);
  }
  if (chroma == 0.0) return {};  // no hue
  constexpr double kRounding = 1e-9;
  const double hue = std::atan2(std::sqrt(3.0) / 2.0 * (rgb[1] - rgb[2]), rgb[0] - 0.5 * (rgb[1] + rgb[2]));
  if (std::fmod(hue - colour.hue_from + kRounding + 4.0 * kPi, 2.0 * kPi) <= colour.hue_width + 2.0 * kRounding) {
    return {};
  }
  return fmt::format("hue {:.1f}°, outside [{:g}, {:g}]", degrees(std::fmod(hue + 2.0 * kPi, 2.0 * kPi)),
                     degrees(colour.hue_from), degrees(std::fmod(colour.hue_from + colour.hue_width, 2.0 * kPi)));
}

std::optional<Eigen::Vector3d> read_typical(const YamlMap& map, const ColourClass& colour) {
  if (!map.has("typical")) return std::nullopt;
  const std::vector<double> bytes = map.numbers("typical", 3, {1.0, 255.0});
  const Eigen::Vector3d rgb(bytes[0], bytes[1], bytes[2]);
  if (const std::string what = outside(colour, rgb); !what.empty()) {
    map.fail("typical", fmt::format("is no colour of its own class: it has {}; give [red, green, blue] as most of its "
                                    "pixels show it, or correct the class's bounds",
                                    what));
  }
  return rgb;
}

}  // namespace

Colours read_colours(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"ball", "yellow_goal", "blue_goal", "field", "line", "obstacle"});
  Colours colours;
  for (int i = 0; i < kObjectClasses; ++i) {
    const auto object = static_cast<ObjectClass>(i);
    if (!map.has(name(object))) continue;
    const YamlMap bounds = map.map(name(object));
    const ColourClass& colour = colours.classes.emplace_back(read_class(bounds, object));
    if (object == ObjectClass::field) colours.typical.field = read_typical(bounds, colour);
    if (object == ObjectClass::line) colours.typical.line = read_typical(bounds, colour);
  }
  const bool detects = std::any_of(colours.classes.begin(), colours.classes.end(), [](const ColourClass& colour) {
    return colour.object == ObjectClass::ball || colour.object == ObjectClass::yellow_goal ||
           colour.object == ObjectClass::blue_goal;
  });
  if (!detects) map.fail("names none of the classes that are detected: ball, yellow_goal, blue_goal");
  return colours;
}

}  // namespace movis::scan
