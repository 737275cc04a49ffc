#include "movis/core/field.h"

#include "movis/core/yaml.h"

namespace movis {
namespace {

constexpr Range kLength{0.01, 100.0};
constexpr Range kOptionalLength{0.0, 100.0};

Field::Area read_area(const YamlMap& map, const char* key) {
  if (!map.has(key)) return {};
  const YamlMap area = map.map(key);
  area.allow({"depth", "width"});
  return {area.number("depth", kLength), area.number("width", kLength)};
}

}  // namespace

Field read_field(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"half_width", "half_length", "circle", "line", "Fd", "Fw", "goal_height", "goal_depth", "goal_thickness",
             "goals", "penalty_area", "goal_area", "corner_arc"});
  Field field;
  field.half_width = map.number("half_width", kLength);
  field.half_length = map.number("half_length", kLength);
  field.circle = map.number("circle", kOptionalLength);
  field.line = map.number("line", kOptionalLength);
  field.Fd = map.number("Fd", kLength);
  field.Fw = map.number("Fw", kLength);
  field.goal_height = map.number("goal_height", kLength);
  field.goal_depth = map.number("goal_depth", kOptionalLength);
  field.goal_thickness = map.number("goal_thickness", {0.0, 1.0});
  if (map.has("goals")) {
    field.goals = map.one_of("goals", {"coloured", "white"}) == "white" ? Field::Goals::white : Field::Goals::coloured;
  }
  field.penalty_area = read_area(map, "penalty_area");
  field.goal_area = read_area(map, "goal_area");
  if (map.has("corner_arc")) field.corner_arc = map.number("corner_arc", kOptionalLength);
  if (field.Fw >= field.half_width) map.fail("Fw", "the goal is wider than the field; Fw is half the goal's width");
  return field;
}

}  // namespace movis
