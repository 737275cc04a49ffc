#include "movis/sim/look.h"

#include <cmath>

#include "movis/core/yaml.h"

namespace movis::sim {
namespace {

// The sRGB curve (IEC 61966-2-1) backwards; values in 0…1.
double linear_of_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

Colour read_colour(const YamlMap& map, const char* key) {
  const std::vector<double> rgb = map.numbers(key, 3, {0.0, 255.0});
  return {static_cast<float>(linear_of_srgb(rgb[0] / 255.0)), static_cast<float>(linear_of_srgb(rgb[1] / 255.0)),
          static_cast<float>(linear_of_srgb(rgb[2] / 255.0)), 0.0F};
}

void read_float(const YamlMap& map, const char* key, Range range, float& target) {
  double value = target;
  map.read_number(key, range, value);
  target = static_cast<float>(value);
}

Light read_light(const YamlMap& map) {
  map.allow({"ambient", "sky", "lamp", "lamp_height", "shadow", "gloss"});
  Light light;
  read_float(map, "ambient", {0.0, 1.0}, light.ambient);
  read_float(map, "sky", {0.0, 1.0}, light.sky);
  read_float(map, "lamp", {0.0, 1.0}, light.lamp);
  read_float(map, "lamp_height", {1.0, 20.0}, light.lamp_height);
  read_float(map, "shadow", {0.0, 0.9}, light.shadow);
  read_float(map, "gloss", {0.0, 1.0}, light.gloss);
  return light;
}

Sensor read_sensor(const YamlMap& map) {
  map.allow({"blur_px", "full_well", "read_noise", "exposure", "red_gain", "blue_gain"});
  Sensor sensor;
  map.read_number("blur_px", {0.0, 1.0}, sensor.blur_px);
  map.read_number("full_well", {0.0, 1e6}, sensor.full_well);
  map.read_number("read_noise", {0.0, 1000.0}, sensor.read_noise);
  map.read_number("exposure", {0.05, 20.0}, sensor.exposure);
  map.read_number("red_gain", {0.2, 5.0}, sensor.red_gain);
  map.read_number("blue_gain", {0.2, 5.0}, sensor.blue_gain);
  if (sensor.read_noise > 0.0 && sensor.full_well == 0.0) {
    map.fail("read_noise", "needs a full_well above 0: noise is given in electrons");
  }
  return sensor;
}

}  // namespace

Look read_look(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"colours", "floor_margin", "hall_half_width", "light", "sensor"});
  const YamlMap colours = map.map("colours");
  colours.allow({"floor", "line", "surround", "wall", "hall", "ball", "yellow_goal", "blue_goal", "white_goal", "hull",
                 "cyan", "magenta", "outside"});
  Look look;
  look.floor = read_colour(colours, "floor");
  look.line = read_colour(colours, "line");
  look.surround = read_colour(colours, "surround");
  look.wall = read_colour(colours, "wall");
  look.hall = read_colour(colours, "hall");
  look.ball = read_colour(colours, "ball");
  look.yellow_goal = read_colour(colours, "yellow_goal");
  look.blue_goal = read_colour(colours, "blue_goal");
  look.white_goal = read_colour(colours, "white_goal");
  look.hull = read_colour(colours, "hull");
  look.cyan = read_colour(colours, "cyan");
  look.magenta = read_colour(colours, "magenta");
  look.outside = read_colour(colours, "outside");
  map.read_number("floor_margin", {0.0, 10.0}, look.floor_margin);
  map.read_number("hall_half_width", {2.0, 50.0}, look.hall_half_width);
  if (map.has("light")) look.light = read_light(map.map("light"));
  if (map.has("sensor")) look.sensor = read_sensor(map.map("sensor"));
  return look;
}

}  // namespace movis::sim
