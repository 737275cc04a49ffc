#include <gtest/gtest.h>

#include "movis/scan/scanner.h"
#include "support/temporary_folder.h"

namespace movis::scan {
namespace {

using test::expect_error;

ScanOptions options_of(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_scan_options(YamlMap::read(folder.write("options.yaml", text)));
}

TEST(ScanOptions, AreReadStrictly) {
  const ScanOptions options = options_of(
      "bins: 360\nmin_elevation_deg: -60\nsensor_radius: 0.05\nthreshold: {sigmas: 3}\nrefine: {border_px: 3}\n");
  EXPECT_EQ(options.bins, 360);
  EXPECT_EQ(options.min_elevation_deg, -60.0);
  EXPECT_EQ(options.max_elevation_deg, ScanOptions{}.max_elevation_deg);
  EXPECT_EQ(options.sensor_radius, 0.05);
  EXPECT_EQ(options.threshold.sigmas, 3.0);
  EXPECT_EQ(options.threshold.minimum, ThresholdOptions{}.minimum);
  EXPECT_EQ(options.refine.border_px, 3);
  EXPECT_EQ(options.refine.dark, RefineOptions{}.dark);
  const ScanOptions dim = options_of("light: {brightness_band: 0.1, least_gain: 0.2}\n");
  EXPECT_EQ(dim.light.brightness_band, 0.1);
  EXPECT_EQ(dim.light.least_gain, 0.2);
  EXPECT_EQ(dim.light.balance_band, LightOptions{}.balance_band);
  expect_error([] { options_of("light: {band: 0.1}\n"); }, {"options.yaml:1", "'band'", "balance_band"});
  expect_error([] { options_of("light: {most_gain: 0.9}\n"); }, {"options.yaml:1", "light.most_gain", "range"});
  expect_error([] { options_of("bin: 360\n"); }, {"options.yaml:1", "'bin'", "bins"});
  expect_error([] { options_of("bins: 20\n"); }, {"options.yaml:1", "bins", "range"});
  expect_error([] { options_of("bins: 360.5\n"); }, {"options.yaml:1", "bins", "whole"});
  expect_error([] { options_of("min_elevation_deg: 50\n"); }, {"options.yaml:1", "min_elevation_deg", "below"});
  expect_error([] { options_of("threshold: {sigma: 3}\n"); }, {"options.yaml:1", "'sigma'", "threshold"});
  expect_error([] { options_of("refine: {edge_band: 2}\n"); }, {"options.yaml:1", "refine.edge_band", "range"});
}

}  // namespace
}  // namespace movis::scan
