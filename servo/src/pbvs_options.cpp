#include "movis/core/yaml.h"
#include "movis/servo/position_based.h"

namespace movis::servo {

PbvsOptions read_pbvs_options(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"gain", "gap", "clearance", "lead_deg"});
  const YamlMap gain = map.map("gain");
  gain.allow({"at_zero", "at_infinity", "slope"});

  PbvsOptions options;
  options.gain_at_zero = gain.number("at_zero", {0.01, 100.0});
  options.gain_at_infinity = gain.number("at_infinity", {0.01, 100.0});
  options.gain_slope = gain.number("slope", {0.01, 1000.0});
  if (options.gain_at_infinity >= options.gain_at_zero) {
    gain.fail("at_infinity", "the gain must fall with the error; make it less than at_zero");
  }
  options.gap = map.number("gap", {-0.2, 1.0});
  options.clearance = map.number("clearance", {0.0, 2.0});
  if (options.clearance < options.gap) map.fail("clearance", "must be at least gap, or the way round would be nearer");
  options.lead = radians(map.number("lead_deg", {1.0, 80.0}));
  return options;
}

}  // namespace movis::servo
