#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "movis/core/error.h"
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

// Each key alone, with a value that is not its default: it lands in its own member and nowhere else.
template <typename Part>
struct Key {
  const char* name;
  double value;
  std::function<double(const Part&)> member;
};

template <typename Part>
void expect_every_key_is_read(const std::string& map, Part ScanOptions::*part, const std::vector<Key<Part>>& keys) {
  const Part defaults = ScanOptions{}.*part;
  for (const Key<Part>& key : keys) {
    ASSERT_NE(key.member(defaults), key.value) << key.name << ": the test's value is the default";
    const Part read = options_of(fmt::format("{}: {{{}: {}}}\n", map, key.name, key.value)).*part;
    for (const Key<Part>& other : keys) {
      EXPECT_EQ(other.member(read), &other == &key ? key.value : other.member(defaults))
          << key.name << " is set, " << other.name << " is compared";
    }
  }
}

// What the error about an unknown key lists, which is all that is allowed.
template <typename Part>
void expect_no_other_key(const std::string& map, const std::vector<Key<Part>>& keys) {
  std::string message;
  try {
    options_of(map + ": {nothing: 1}\n");
  } catch (const Error& error) {
    message = error.what();
  }
  const std::string list = message.substr(std::min(message.size(), message.rfind(": ") + 2));
  EXPECT_EQ(std::count(list.begin(), list.end(), ',') + 1, static_cast<std::ptrdiff_t>(keys.size())) << message;
  for (const Key<Part>& key : keys) EXPECT_NE(list.find(key.name), std::string::npos) << key.name << ": " << message;
}

TEST(ScanOptions, EveryKeyOfFloor) {
  using F = FloorOptions;
  const std::vector<Key<F>> keys{{"max_range", 7.5, [](const F& f) { return f.max_range; }},
                                 {"line_step", 3, [](const F& f) { return f.line_step; }},
                                 {"most_line_points", 77, [](const F& f) { return f.most_line_points; }},
                                 {"white_contrast", 0.55, [](const F& f) { return f.white_contrast; }},
                                 {"white_balance", 0.65, [](const F& f) { return f.white_balance; }},
                                 {"least_pixels", 0.75, [](const F& f) { return f.least_pixels; }},
                                 {"position_floor", 0.25, [](const F& f) { return f.position_floor; }},
                                 {"floor_sigma", 0.0125, [](const F& f) { return f.floor_sigma; }},
                                 {"obstacle_dark", 0.35, [](const F& f) { return f.obstacle_dark; }},
                                 {"obstacle_pixels", 9, [](const F& f) { return f.obstacle_pixels; }},
                                 {"obstacle_width_deg", 4.5, [](const F& f) { return f.obstacle_width_deg; }},
                                 {"foot_sigma_px", 0.85, [](const F& f) { return f.foot_sigma_px; }}};
  expect_every_key_is_read("floor", &ScanOptions::floor, keys);
  expect_no_other_key("floor", keys);
}

TEST(ScanOptions, EveryKeyOfLight) {
  using L = LightOptions;
  const std::vector<Key<L>> keys{{"brightness_band", 0.25, [](const L& l) { return l.brightness_band; }},
                                 {"balance_band", 0.0875, [](const L& l) { return l.balance_band; }},
                                 {"least_gain", 0.45, [](const L& l) { return l.least_gain; }},
                                 {"most_gain", 3.5, [](const L& l) { return l.most_gain; }},
                                 {"least_share", 0.35, [](const L& l) { return l.least_share; }}};
  expect_every_key_is_read("light", &ScanOptions::light, keys);
  expect_no_other_key("light", keys);
}

}  // namespace
}  // namespace movis::scan
