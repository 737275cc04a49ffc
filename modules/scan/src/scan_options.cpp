#include "movis/scan/scanner.h"

namespace movis::scan {
namespace {

ThresholdOptions read_threshold_options(const YamlMap& map) {
  map.allow({"minimum", "sigmas", "peak_fraction"});
  ThresholdOptions options;
  map.read_number("minimum", {1.0, 1e6}, options.minimum);
  map.read_number("sigmas", {0.0, 100.0}, options.sigmas);
  map.read_number("peak_fraction", {0.0, 0.99}, options.peak_fraction);
  return options;
}

LightOptions read_light_options(const YamlMap& map) {
  map.allow({"brightness_band", "balance_band", "least_gain", "most_gain", "least_share"});
  LightOptions options;
  map.read_number("brightness_band", {0.0, 1.0}, options.brightness_band);
  map.read_number("balance_band", {0.0, 1.0}, options.balance_band);
  map.read_number("least_gain", {0.1, 1.0}, options.least_gain);
  map.read_number("most_gain", {1.0, 5.0}, options.most_gain);
  map.read_number("least_share", {0.01, 1.0}, options.least_share);
  return options;
}

}  // namespace

RefineOptions read_refine_options(const YamlMap& map) {
  map.allow({"dark", "border_px", "edge_window_deg", "edge_band", "pixel_sigma", "azimuth_floor_deg",
             "elevation_floor_deg", "radius_floor_deg"});
  RefineOptions options;
  map.read_number("dark", {0.001, 1.0}, options.dark);
  map.read_integer("border_px", {1.0, 10.0}, options.border_px);
  map.read_number("edge_window_deg", {0.2, 10.0}, options.edge_window_deg);
  map.read_number("edge_band", {0.1, 1.0}, options.edge_band);
  map.read_number("pixel_sigma", {0.01, 10.0}, options.pixel_sigma);
  map.read_number("azimuth_floor_deg", {0.0, 10.0}, options.azimuth_floor_deg);
  map.read_number("elevation_floor_deg", {0.0, 10.0}, options.elevation_floor_deg);
  map.read_number("radius_floor_deg", {0.0, 10.0}, options.radius_floor_deg);
  return options;
}

ScanOptions read_scan_options(const YamlMap& map) {
  map.allow({"bins", "min_elevation_deg", "max_elevation_deg", "min_object_pixels", "ball_gap_deg", "goal_gap_deg",
             "sensor_radius", "threshold", "refine", "floor", "light"});
  ScanOptions options;
  map.read_integer("bins", {180.0, 7200.0}, options.bins);
  map.read_number("min_elevation_deg", {-90.0, 90.0}, options.min_elevation_deg);
  map.read_number("max_elevation_deg", {-90.0, 90.0}, options.max_elevation_deg);
  if (!(options.min_elevation_deg < options.max_elevation_deg)) {
    map.fail("min_elevation_deg", "must be below max_elevation_deg");
  }
  map.read_integer("min_object_pixels", {1.0, 1e6}, options.min_object_pixels);
  map.read_number("ball_gap_deg", {0.0, 90.0}, options.ball_gap_deg);
  map.read_number("goal_gap_deg", {0.0, 90.0}, options.goal_gap_deg);
  map.read_number("sensor_radius", {0.0, 1.0}, options.sensor_radius);
  if (map.has("threshold")) options.threshold = read_threshold_options(map.map("threshold"));
  if (map.has("refine")) options.refine = read_refine_options(map.map("refine"));
  if (map.has("light")) options.light = read_light_options(map.map("light"));
  if (map.has("floor")) options.floor = read_floor_options(map.map("floor"));
  return options;
}

}  // namespace movis::scan
