#include "movis/pipeline/pipeline.h"

namespace movis::pipeline {

Options read_options(const std::filesystem::path& file) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"scan", "triangulation", "localization", "world"});
  Options options;
  if (map.has("scan")) options.scan = scan::read_scan_options(map.map("scan"));
  if (map.has("triangulation")) options.triangulation = triangulation::read_options(map.map("triangulation"));
  if (map.has("localization")) options.localization = localization::read_options(map.map("localization"));
  if (map.has("world")) options.world = world::read_world_options(map.map("world"));
  return options;
}

}  // namespace movis::pipeline
