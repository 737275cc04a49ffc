#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "movis/core/paths.h"
#include "movis/sim/look.h"
#include "support/temporary_folder.h"

namespace movis::sim {
namespace {

// The shipped look with one line replaced.
class LookFile : public ::testing::Test {
 protected:
  LookFile() {
    std::ifstream file(data_file("looks/hall.yaml"));
    shipped_ = {std::istreambuf_iterator<char>(file), {}};
  }

  Look read(const std::string& content) { return read_look(folder_.write("look.yaml", content)); }
  std::string with(const std::string& line, const std::string& instead) const {
    const auto at = shipped_.find(line);
    EXPECT_NE(at, std::string::npos) << line;
    std::string changed = shipped_;
    return changed.replace(at, shipped_.find('\n', at) - at, instead);
  }
  void expect_refused(const std::string& line, const std::string& instead, std::initializer_list<const char*> parts) {
    test::expect_error([&] { read(with(line, instead)); }, parts);
  }

  std::string shipped_;
  test::TemporaryFolder folder_;
};

// sRGB's own numbers: 0 is 0, 255 is 1, 188 is half the light (0.5029).
TEST_F(LookFile, ColoursAreEightBitsAndBecomeLinear) {
  const Look look = read(with("  ball:", "  ball: [255, 0, 188]"));
  EXPECT_FLOAT_EQ(look.ball[0], 1.0F);
  EXPECT_FLOAT_EQ(look.ball[1], 0.0F);
  EXPECT_NEAR(look.ball[2], 0.5029F, 1e-4F);
  EXPECT_EQ(look.ball[3], 0.0F);
}

TEST_F(LookFile, EveryNumber) {
  const std::string head = shipped_.substr(0, shipped_.find("floor_margin"));
  const Look look = read(head + R"(
floor_margin: 0.5
hall_half_width: 12
light: {ambient: 0.4, sky: 0.2, lamp: 0.3, lamp_height: 4, shadow: 0.5, gloss: 0.1}
sensor: {blur_px: 0.6, full_well: 9000, read_noise: 5, exposure: 1.5, red_gain: 1.2, blue_gain: 0.8}
)");
  EXPECT_EQ(look.floor_margin, 0.5);
  EXPECT_EQ(look.hall_half_width, 12.0);
  EXPECT_EQ(look.light.ambient, 0.4F);
  EXPECT_EQ(look.light.sky, 0.2F);
  EXPECT_EQ(look.light.lamp, 0.3F);
  EXPECT_EQ(look.light.lamp_height, 4.0F);
  EXPECT_EQ(look.light.shadow, 0.5F);
  EXPECT_EQ(look.light.gloss, 0.1F);
  EXPECT_EQ(look.sensor.blur_px, 0.6);
  EXPECT_EQ(look.sensor.full_well, 9000.0);
  EXPECT_EQ(look.sensor.read_noise, 5.0);
  EXPECT_EQ(look.sensor.exposure, 1.5);
  EXPECT_EQ(look.sensor.red_gain, 1.2);
  EXPECT_EQ(look.sensor.blue_gain, 0.8);
}

TEST_F(LookFile, OnlyColoursAreNeeded) {
  const Look look = read(shipped_.substr(0, shipped_.find("floor_margin")));
  EXPECT_EQ(look.sensor.blur_px, 0.0);
  EXPECT_EQ(look.sensor.full_well, 0.0);
  EXPECT_EQ(look.sensor.exposure, 1.0);
  EXPECT_EQ(look.light.shadow, Light{}.shadow);
}

TEST_F(LookFile, UnknownKeys) {
  expect_refused("floor_margin:", "floor_margn: 0.3", {"look.yaml", "floor_margn"});
  expect_refused("  ball:", "  bal: [231, 128, 37]", {"look.yaml", "bal"});
  expect_refused("light:", "light: {ambiance: 0.5}", {"look.yaml", "ambiance"});
  expect_refused("  blur_px:", "  blur: 0.5", {"look.yaml", "blur"});
}

TEST_F(LookFile, MissingColour) {
  expect_refused("  hull:", "", {"look.yaml", "hull"});
}

TEST_F(LookFile, ColoursOutOfRange) {
  expect_refused("  floor:", "  floor: [51, 256, 71]", {"look.yaml:4", "floor", "256"});
  expect_refused("  floor:", "  floor: [51, -1, 71]", {"look.yaml:4", "floor", "-1"});
  expect_refused("  floor:", "  floor: [51, 129]", {"look.yaml:4", "floor"});
  expect_refused("  floor:", "  floor: [51, green, 71]", {"look.yaml:4", "floor", "number"});
}

TEST_F(LookFile, NumbersOutOfRange) {
  expect_refused("hall_half_width:", "hall_half_width: 1", {"hall_half_width", "1"});
  expect_refused("light:", "light: {shadow: 1}", {"shadow", "1"});
  expect_refused("  blur_px:", "  blur_px: 1.1", {"blur_px", "1.1"});
  expect_refused("  read_noise:", "  exposure: 0", {"exposure", "0"});
  expect_refused("  read_noise:", "  red_gain: .nan", {"red_gain"});
}

TEST_F(LookFile, ReadNoiseNeedsAFullWell) {
  expect_refused("  full_well:", "", {"look.yaml", "read_noise", "full_well"});
}

TEST_F(LookFile, NoSuchFile) {
  test::expect_error([&] { read_look(folder_.path() / "absent.yaml"); }, {"absent.yaml"});
}

}  // namespace
}  // namespace movis::sim
