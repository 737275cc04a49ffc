#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/scan/polar_map.h"
#include "omni_scene.h"
#include "support/temporary_folder.h"

namespace movis::scan {
namespace {

using test::expect_error;
using test::TemporaryFolder;

constexpr int kBins = 720;
constexpr double kBin = 2.0 * kPi / kBins;

int bins_apart(int a, int b) {
  const int apart = std::abs(a - b) % kBins;
  return std::min(apart, kBins - apart);
}

// The points of an upright post keep their azimuth at every height, in the robot's axes, whatever the camera's tilt:
// here it would bend a post by up to 9° · tan 25°, eight bins, between its foot and the horizon. The pixel that is
// nearest to a point lies up to half a pixel, less than a bin, beside it.
TEST(PolarMap, UprightPostsStandUpright) {
  for (omni::Camera camera : {hyperboloid_camera(), unified_camera()}) {
    camera.position = {0.1, -0.05, 0.6};
    camera.yaw = radians(40.0);
    camera.tilt_x = radians(7.0);
    camera.tilt_y = radians(-6.0);
    const PolarMap map = make_polar_map(camera, kBins, radians(-60.0), radians(30.0));
    int seen = 0;
    for (double azimuth_deg = -179.9; azimuth_deg < 180.0; azimuth_deg += 5.1) {
      const double azimuth = radians(azimuth_deg);
      const int expected = static_cast<int>(std::floor((azimuth + kPi) / kBin));
      for (double z = 0.0; z <= 0.9; z += 0.1) {
        const Eigen::Vector3d point(camera.position.x() + 1.3 * std::cos(azimuth),
                                    camera.position.y() + 1.3 * std::sin(azimuth), z);
        const auto pixel = project(camera, point);
        if (!pixel) continue;
        const int u = static_cast<int>(std::lround(pixel->x()));
        const int v = static_cast<int>(std::lround(pixel->y()));
        if (!map.contains(u, v)) continue;
        EXPECT_LE(bins_apart(map.bin[map.index(u, v)], expected), 1) << azimuth_deg << "° " << z << " m";
        ++seen;
      }
    }
    EXPECT_GT(seen, 600);
  }
}

// Bin i covers [−π + i w, −π + (i + 1) w): against the rays of all pixels, those at a border left out, where the last
// digit decides.
TEST(PolarMap, BinsAndRaysAreThoseOfThePixels) {
  omni::Camera camera = hyperboloid_camera();
  camera.yaw = radians(-150.0);
  camera.tilt_x = radians(3.0);
  const PolarMap map = make_polar_map(camera, kBins, radians(-70.0), radians(10.0));
  std::size_t scanned = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (!map.contains(u, v)) continue;
      ++scanned;
      const auto truth = unproject(camera, Eigen::Vector2d(u, v));
      ASSERT_TRUE(truth);
      const PixelRay& ray = map.ray[map.index(u, v)];
      ASSERT_LT((Eigen::Vector3d(ray.x, ray.y, ray.z) - *truth).norm(), 1e-6);
      ASSERT_GT(ray.z, std::sin(radians(-70.0)) - 1e-6);
      ASSERT_LT(ray.z, std::sin(radians(10.0)) + 1e-6);
      const double bins = (std::atan2(truth->y(), truth->x()) + kPi) / kBin;
      if (std::abs(bins - std::round(bins)) < 1e-6) continue;
      ASSERT_EQ(map.bin[map.index(u, v)], static_cast<int>(std::floor(bins))) << u << " " << v;
    }
  }
  EXPECT_EQ(scanned, map.scanned_pixels());
  EXPECT_GT(scanned, 50000U);
}

// Runs are the scanned pixels and nothing else, in memory order, with a gap between any two.
TEST(PolarMap, RunsCoverTheScannedPixels) {
  const omni::Camera camera = unified_camera();
  const PolarMap map = make_polar_map(camera, kBins, radians(-40.0), radians(5.0));
  std::vector<char> covered(static_cast<std::size_t>(map.width) * map.height);
  scan::Run last{-1, 0, 0};
  for (const scan::Run& run : map.runs) {
    ASSERT_LT(run.begin, run.end);
    ASSERT_TRUE(run.row > last.row || (run.row == last.row && run.begin > last.end)) << run.row << " " << run.begin;
    for (int u = run.begin; u < run.end; ++u) covered[map.index(u, run.row)] = 1;
    last = run;
  }
  for (int v = 0; v < map.height; ++v) {
    for (int u = 0; u < map.width; ++u) ASSERT_EQ(covered[map.index(u, v)] != 0, map.contains(u, v)) << u << " " << v;
  }
  EXPECT_FALSE(map.contains(-1, 0));
  EXPECT_FALSE(map.contains(0, -1));
  EXPECT_FALSE(map.contains(map.width, 0));
  EXPECT_FALSE(map.contains(0, map.height));
}

// Between the elevations e1 and e2 lie 2π (sin e2 − sin e1) steradians. Both ranges are inside the picture all around;
// pixels at a range's border count or not as their centre does. Measured: within 0.025 %.
TEST(PolarMap, SolidAnglesAddUp) {
  for (omni::Camera camera : {hyperboloid_camera(), unified_camera()}) {
    camera.tilt_x = radians(4.0);
    camera.tilt_y = radians(-3.0);
    for (const auto& [low_deg, high_deg] : {std::pair{-60.0, 0.0}, {-40.0, 3.0}, {-75.0, -30.0}}) {
      const double low = radians(low_deg);
      const double high = radians(high_deg);
      const PolarMap map = make_polar_map(camera, kBins, low, high);
      double sum = 0.0;
      for (const PixelRay& ray : map.ray) sum += ray.solid_angle;
      const double expected = 2.0 * kPi * (std::sin(high) - std::sin(low));
      EXPECT_NEAR(sum, expected, 0.002 * expected) << low_deg << "° to " << high_deg << "°";
    }
  }
}

TEST(PolarMap, MaskedPixelsAreNotScanned) {
  const TemporaryFolder folder;
  omni::Camera camera = hyperboloid_camera();
  const PolarMap open = make_polar_map(camera, kBins, radians(-60.0), radians(0.0));
  cv::Mat mask(camera.height, camera.width, CV_8UC1, cv::Scalar(255));
  mask.colRange(0, 300) = cv::Scalar(0);
  mask.at<std::uint8_t>(200, 400) = 0;
  mask.at<std::uint8_t>(200, 410) = 60;  // black and white of a JPEG are not quite
  mask.at<std::uint8_t>(200, 420) = 200;
  camera.mask = folder.path() / "mask.png";
  ASSERT_TRUE(cv::imwrite(camera.mask.string(), mask));
  const PolarMap masked = make_polar_map(camera, kBins, radians(-60.0), radians(0.0));
  ASSERT_TRUE(open.contains(400, 200) && open.contains(410, 200) && open.contains(420, 200));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const bool hidden = u < 300 || (v == 200 && (u == 400 || u == 410));
      ASSERT_EQ(masked.contains(u, v), open.contains(u, v) && !hidden) << u << " " << v;
    }
  }
}

TEST(PolarMap, MaskOfAnotherSizeIsAnError) {
  const TemporaryFolder folder;
  omni::Camera camera = hyperboloid_camera();
  camera.mask = folder.path() / "small.png";
  ASSERT_TRUE(cv::imwrite(camera.mask.string(), cv::Mat(480, 639, CV_8UC1, cv::Scalar(255))));
  expect_error([&] { make_polar_map(camera, kBins, -1.0, 0.0); }, {"small.png", "'M1'", "639×480", "640×480"});
}

TEST(PolarMap, MaskThatCannotBeReadIsAnError) {
  const TemporaryFolder folder;
  omni::Camera camera = hyperboloid_camera();
  camera.mask = folder.path() / "absent.png";
  expect_error([&] { make_polar_map(camera, kBins, -1.0, 0.0); }, {"absent.png", "'M1'"});
  camera.mask = folder.write("text.png", "not an image\n");
  expect_error([&] { make_polar_map(camera, kBins, -1.0, 0.0); }, {"text.png", "'M1'"});
}

TEST(PolarMap, CameraThatSeesNothingIsAnError) {
  omni::Camera camera = hyperboloid_camera();
  expect_error([&] { make_polar_map(camera, kBins, radians(70.0), radians(80.0)); }, {"'M1'", "nothing", "70", "80"});
  const TemporaryFolder folder;
  camera.mask = folder.path() / "black.png";
  ASSERT_TRUE(cv::imwrite(camera.mask.string(), cv::Mat(480, 640, CV_8UC1, cv::Scalar(0))));
  expect_error([&] { make_polar_map(camera, kBins, -1.0, 0.0); }, {"'M1'", "nothing"});
}

}  // namespace
}  // namespace movis::scan
