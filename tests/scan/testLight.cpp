#include <fmt/format.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/grab/dataset_source.h"
#include "movis/scan/light.h"
#include "movis/scan/scanner.h"
#include "support/degrade.h"

namespace movis::scan {
namespace {

// Numbers that divide well: a byte of the carpet plus the 14 of sRGB's curve is 64, 144, 88.
const Eigen::Vector3d kCarpet(50, 130, 74);
const Eigen::Vector3d kLine(230, 230, 230);
constexpr int kWidth = 200;
constexpr int kHeight = 96;

Colours typical_colours() {
  Colours colours;
  colours.typical = {kCarpet, kLine};
  return colours;
}

// A camera that looks at the floor with every pixel.
PolarMap floor_map() {
  PolarMap map;
  map.width = kWidth;
  map.height = kHeight;
  map.bins = 1;
  map.bin.resize(static_cast<std::size_t>(kWidth) * kHeight);
  map.ray.assign(map.bin.size(), {0.8F, 0.0F, -0.6F, 1e-4F});
  for (int v = 0; v < kHeight; ++v) map.runs.push_back({v, 0, kWidth});
  return map;
}

class Floor {
 public:
  explicit Floor(const Eigen::Vector3d& carpet) { fill(0, kWidth, carpet); }

  // Columns [begin, end).
  void fill(int begin, int end, const Eigen::Vector3d& rgb) {
    for (int v = 0; v < kHeight; ++v) {
      for (int u = begin; u < end; ++u) set(u, v, rgb);
    }
  }
  void set(int u, int v, const Eigen::Vector3d& rgb) {
    for (int c = 0; c < 3; ++c) bytes_[3 * (v * kWidth + u) + 2 - c] = static_cast<std::uint8_t>(std::lround(rgb[c]));
  }
  // White lines three pixels wide.
  void draw_lines(const Eigen::Vector3d& rgb) {
    for (int u = 20; u < kWidth; u += 20) fill(u, u + 3, rgb);
  }
  ImageView view() const { return {bytes_.data(), kWidth, kHeight, 3 * kWidth, PixelFormat::bgr8}; }

 private:
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(3 * static_cast<std::size_t>(kWidth) * kHeight);
};

Illumination light_of(const ImageView& image, const Colours& colours = typical_colours()) {
  const PolarMap map = floor_map();
  LightAdapter adapter(map, colours, {});
  const ImageView adapted = adapter.adapt(image);
  const bool differs = adapter.light().differs();
  EXPECT_EQ(adapted.data == image.data, !differs);  // the image itself, or a copy
  return adapter.light();
}

void expect_gains(const Illumination& light, double r, double g, double b, double tolerance = 1e-12) {
  EXPECT_NEAR(light.gains.r, r, tolerance);
  EXPECT_NEAR(light.gains.g, g, tolerance);
  EXPECT_NEAR(light.gains.b, b, tolerance);
}

// The median of equal bytes is that byte: 40/50, 130/130, 111/74.
TEST(Light, ColouredLightIsKnownByTheCarpet) {
  const Illumination light = light_of(Floor({40, 130, 111}).view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  expect_gains(light, 0.8, 1.0, 1.5);
}

// Half of the pixels have 60 and half 61: the median lies between them. Gains of 1.21 · 50 = 60.5 and so on.
TEST(Light, MedianIsFinerThanAByte) {
  Floor floor({60, 130, 48});
  floor.fill(0, kWidth / 2, {61, 130, 48});
  const Illumination light = light_of(floor.view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  EXPECT_NEAR(light.gains.r, 1.21, 1e-9);
}

// Bytes times ½: (25, 65, 37).
TEST(Light, DimmedBytesAreWhiteLight) {
  const Illumination light = light_of(Floor({25, 65, 37}).view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  expect_gains(light, 0.5, 0.5, 0.5);
}

// Light times a factor: bytes plus 14 times ½ is (32, 72, 44), the bytes are (18, 58, 30). Carpet tells gains of 0.36,
// 0.446 and 0.405, yet the light is white, and bright colours have lost about as much as its green.
TEST(Light, DimmedLightIsWhiteLight) {
  const Illumination light = light_of(Floor({18, 58, 30}).view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  expect_gains(light, 58.0 / 130.0, 58.0 / 130.0, 58.0 / 130.0);
}

TEST(Light, WithinTheBandsNothingIsAdapted) {
  for (const Eigen::Vector3d& gains : {Eigen::Vector3d(1, 1, 1), {1.05, 1, 0.95}, {0.9, 0.9, 0.9}, {1.1, 1.1, 1.1}}) {
    const Illumination light = light_of(Floor(kCarpet.cwiseProduct(gains)).view());
    EXPECT_EQ(light.status, LightStatus::reference) << gains.transpose();
    expect_gains(light, 1.0, 1.0, 1.0);
  }
}

// Lines of (184, 207, 161) are 0.8, 0.9 and 0.7 of (230, 230, 230).
TEST(Light, LinesTellIt) {
  Floor floor(kCarpet.cwiseProduct(Eigen::Vector3d(0.8, 0.9, 0.7)));
  floor.draw_lines({184, 207, 161});
  const Illumination light = light_of(floor.view());
  EXPECT_EQ(light.status, LightStatus::by_lines);
  expect_gains(light, 0.8, 0.9, 0.7);
}

TEST(Light, AnotherCarpetWithWhiteLinesIsNoOtherLight) {
  Floor floor(kCarpet.cwiseProduct(Eigen::Vector3d(1.3, 1.0, 1.4)));
  EXPECT_EQ(light_of(floor.view()).status, LightStatus::by_carpet);
  floor.draw_lines(kLine);
  EXPECT_EQ(light_of(floor.view()).status, LightStatus::reference);
}

// Half of the light of a line that the pixel shares with carpet: greener than the line is.
TEST(Light, MixedLinesYieldToTheCarpet) {
  Floor floor(kCarpet.cwiseProduct(Eigen::Vector3d(0.8, 1.0, 0.8)));
  floor.draw_lines(0.8 * kLine.cwiseProduct(Eigen::Vector3d(0.75, 1.0, 0.78)));
  const Illumination light = light_of(floor.view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  expect_gains(light, 0.8, 1.0, 59.0 / 74.0);
}

TEST(Light, ClippedLinesTellNothing) {
  Floor floor(kCarpet.cwiseProduct(Eigen::Vector3d(1.3, 1.0, 1.0)));
  floor.draw_lines({255, 230, 230});
  const Illumination light = light_of(floor.view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  EXPECT_NEAR(light.gains.r, 1.3, 1e-12);
}

TEST(Light, WithoutTypicalColoursNothingIsAdapted) {
  EXPECT_EQ(light_of(Floor({25, 65, 37}).view(), Colours{}).status, LightStatus::unknown);
}

// Shadows on a fifth of the carpet, a ball, a robot's black body and bands on it.
TEST(Light, OtherThingsOnTheCarpet) {
  Floor floor({25, 65, 37});
  floor.fill(0, 40, {12, 33, 19});
  floor.fill(40, 60, {115, 64, 18});
  floor.fill(60, 80, {22, 22, 22});
  floor.fill(80, 90, {106, 44, 101});
  floor.fill(90, 100, {44, 106, 116});
  const Illumination light = light_of(floor.view());
  EXPECT_EQ(light.status, LightStatus::by_carpet);
  expect_gains(light, 0.5, 0.5, 0.5, 0.01);
}

TEST(DegenerateLight, BlackImage) {
  EXPECT_EQ(light_of(Floor({0, 0, 0}).view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, WhiteImage) {
  EXPECT_EQ(light_of(Floor({255, 255, 255}).view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, GreyFloor) {
  EXPECT_EQ(light_of(Floor({120, 125, 118}).view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, OrangeEverywhere) {
  EXPECT_EQ(light_of(Floor({230, 128, 37}).view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, Noise) {
  Floor floor({0, 0, 0});
  RandomStream stream = make_stream(3, 0);
  std::uniform_real_distribution<double> byte(0.0, 255.0);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) floor.set(u, v, {byte(stream), byte(stream), byte(stream)});
  }
  EXPECT_EQ(light_of(floor.view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, TooLittleCarpet) {
  Floor floor({120, 120, 120});
  floor.fill(0, kWidth / 10, {25, 65, 37});
  EXPECT_EQ(light_of(floor.view()).status, LightStatus::unknown);
}

TEST(DegenerateLight, ClippedCarpet) {
  EXPECT_EQ(light_of(Floor({100, 255, 148}).view()).status, LightStatus::unknown);
}

// 0.28 of the typical bytes.
TEST(DegenerateLight, TooDarkToBelieve) {
  EXPECT_EQ(light_of(Floor({14, 36, 21}).view()).status, LightStatus::unknown);
}

// A balance is believed from 1/1.6 to 1.6. Of 50 and 74 beside 130, these are 31.25 and 80, 46.25 and 118.4. Beyond, no
// pixel is recognized as carpet, and the image is taken as it is.
TEST(DegenerateLight, BalanceAtTheLimitOfBelief) {
  for (const auto& [red, blue] : {std::pair{32, 74}, {79, 74}, {50, 47}, {50, 118}}) {
    const Illumination light = light_of(Floor(Eigen::Vector3d(red, 130, blue)).view());
    EXPECT_EQ(light.status, LightStatus::by_carpet) << red << " " << blue;
    expect_gains(light, red / 50.0, 1.0, blue / 74.0);
  }
  for (const auto& [red, blue] : {std::pair{30, 74}, {82, 74}, {50, 45}, {50, 120}}) {
    const Illumination light = light_of(Floor(Eigen::Vector3d(red, 130, blue)).view());
    EXPECT_EQ(light.status, LightStatus::unknown) << red << " " << blue;
    expect_gains(light, 1.0, 1.0, 1.0, 0.0);
  }
}

// With gains of ½, 1 and 2 each byte is doubled, kept and halved, rounded up; beyond 255 it is cut off. Rows of any
// length, with a gap behind each.
TEST(RemoveGains, IsADivisionInEveryFormat) {
  RandomStream stream = make_stream(4, 0);
  std::uniform_int_distribution<int> byte(0, 255);
  for (const PixelFormat format : {PixelFormat::bgr8, PixelFormat::rgb8, PixelFormat::rgba8}) {
    const int bytes_a_pixel = channels(format);
    const int red = format == PixelFormat::bgr8 ? 2 : 0;
    for (const int width : {1, 7, 32, 65, 131, 192}) {
      const int stride = bytes_a_pixel * width + 5;
      std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stride) * 2);
      for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(byte(stream));
      std::vector<std::uint8_t> to(static_cast<std::size_t>(bytes_a_pixel) * width * 2);
      remove_gains({bytes.data(), width, 2, stride, format}, {{0, 0, width}, {1, 0, width}}, {0.5, 1.0, 2.0},
                   to.data());
      for (int v = 0; v < 2; ++v) {
        for (int u = 0; u < width; ++u) {
          const std::uint8_t* from = &bytes[static_cast<std::size_t>(v) * stride + bytes_a_pixel * u];
          const std::uint8_t* result = &to[(static_cast<std::size_t>(v) * width + u) * bytes_a_pixel];
          ASSERT_EQ(result[red], std::min(255, 2 * from[red]));
          ASSERT_EQ(result[1], from[1]);
          ASSERT_EQ(result[2 - red], (from[2 - red] + 1) / 2);
          if (bytes_a_pixel == 4) {
            ASSERT_EQ(result[3], from[3]);
          }
        }
      }
    }
  }
}

// A quotient to half a byte, and the factor to 1/512.
TEST(RemoveGains, AnyGainThatIsBelieved) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < 256; ++i) bytes.insert(bytes.end(), 3, static_cast<std::uint8_t>(i));
  std::vector<std::uint8_t> to(bytes.size());
  for (double gain = 0.3; gain < 2.5; gain += 0.01) {
    remove_gains({bytes.data(), 256, 1, 768, PixelFormat::rgb8}, {{0, 0, 256}}, {gain, gain, gain}, to.data());
    for (int i = 0; i < 768; ++i) ASSERT_NEAR(to[i], std::min(255.0, bytes[i] / gain), 0.5 + bytes[i] / 512.0);
  }
}

// A map of a few columns: the copy holds them and some more, and is black elsewhere, whatever was scanned before.
TEST(LightAdapter, CopiesWhatIsScanned) {
  PolarMap map = floor_map();
  map.runs.clear();
  for (int v = 16; v < 80; ++v) map.runs.push_back({v, 64, 96});
  LightAdapter adapter(map, typical_colours(), {});
  const Floor dim({25, 65, 37});
  const ImageView copy = adapter.adapt(dim.view());
  ASSERT_EQ(adapter.light().status, LightStatus::by_carpet);
  EXPECT_EQ(copy.row(16)[3 * 64 + 1], 130);
  EXPECT_EQ(copy.row(79)[3 * 95 + 2], 50);
  EXPECT_EQ(copy.row(40)[3 * 60], 74);  // beside it
  EXPECT_EQ(copy.row(40)[3 * 190], 0);
  EXPECT_EQ(copy.row(5)[3 * 70], 0);
  EXPECT_EQ(adapter.adapted(dim.view()).data, copy.data);

  const Floor reference(kCarpet);
  EXPECT_EQ(adapter.adapt(reference.view()).data, reference.view().data);
  EXPECT_EQ(adapter.adapted(reference.view()).data, reference.view().data);
}

// Shipped ray-traced images as they are, and the same in other light: bytes times gains.
class OtherLight : public testing::Test {
 protected:
  OtherLight() {
    grab::DatasetSource source(grab::read_dataset(data_file("images/field")));
    const Colours colours = read_colours(data_file("colours/default.yaml"));
    scanners_.reserve(3);
    for (int k = 0; k < 3; ++k) scanners_.emplace_back(source.dataset().rig, k, colours, ScanOptions{});
    source.open();
    for (grab::FrameSet images; source.acquire(images);) {
      for (int k = 0; k < 3; ++k) seen_.push_back({k, images.memory[k].clone(), scan(k, images.memory[k])});
    }
  }

  std::vector<Bearing> scan(int k, const cv::Mat& bgr) {
    std::vector<Bearing> bearings;
    scanners_[k].scan({bgr.data, bgr.cols, bgr.rows, static_cast<std::ptrdiff_t>(bgr.step), PixelFormat::bgr8}, 0.0,
                      bearings);
    return bearings;
  }

  // The same objects, and where they are clean, azimuths to hundredths of a degree.
  void expect_same_bearings(double red, double green, double blue) {
    const testing::ScopedTrace trace(__FILE__, __LINE__, fmt::format("gains {}, {}, {}", red, green, blue));
    RandomStream random = make_stream(1, 0);
    for (const Seen& seen : seen_) {
      cv::Mat other = seen.image.clone();
      test::degrade(other, {0.0, 0.0, {red, green, blue}}, random);
      const std::vector<Bearing> bearings = scan(seen.camera, other);
      EXPECT_TRUE(scanners_[seen.camera].light().differs());
      ASSERT_EQ(bearings.size(), seen.bearings.size());
      for (std::size_t i = 0; i < bearings.size(); ++i) compare(seen.bearings[i], bearings[i]);
    }
    EXPECT_GE(edges_, 20);
  }

 private:
  struct Seen {
    int camera;
    cv::Mat image;
    std::vector<Bearing> bearings;
  };

  void compare(const Bearing& expected, const Bearing& bearing) {
    ASSERT_EQ(bearing.object, expected.object);
    if (!expected.clean()) return;
    EXPECT_TRUE(bearing.clean());
    EXPECT_NEAR(turn(expected.azimuth, bearing.azimuth), 0.0, radians(0.05));
    if (bearing.object == ObjectClass::ball) return;
    EXPECT_NEAR(turn(expected.left, bearing.left), 0.0, radians(0.08));
    EXPECT_NEAR(turn(expected.right, bearing.right), 0.0, radians(0.08));
    edges_ += 2;
  }

  std::vector<Scanner> scanners_;
  std::vector<Seen> seen_;
  int edges_ = 0;
};

TEST_F(OtherLight, DimmerOrBrighter) {
  for (const double gain : {0.35, 0.5, 0.7, 1.3}) expect_same_bearings(gain, gain, gain);
}

TEST_F(OtherLight, RedOrBlueByAFifth) {
  for (const double red : {0.8, 1.0, 1.2}) {
    for (const double blue : {0.8, 1.0, 1.2}) {
      if (red != 1.0 || blue != 1.0) expect_same_bearings(red, 1.0, blue);
    }
  }
}

}  // namespace
}  // namespace movis::scan
