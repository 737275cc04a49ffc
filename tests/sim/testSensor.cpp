// Lens and sensor, seen from outside: what they do to the wall of a hall, which has one colour everywhere.
#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "render_scene.h"

namespace movis {
namespace {

using test::linear_of;
using test::RenderScene;
using test::srgb_byte;

// Walls of this linear red, green, blue, under light that is the same everywhere.
RenderScene walled_scene(const Eigen::Array3f& wall) {
  RenderScene scene;
  scene.look.hall << wall, 0.0F;
  scene.look.light = {1.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F};
  return scene;
}

// The pixels of the first camera that show nothing but wall, around them too: without blur and noise they have its
// colour.
cv::Mat1b wall_pixels(const RenderScene& scene) {
  RenderScene clean = scene;
  clean.look.sensor = {};
  const cv::Vec3d expected(srgb_byte(scene.look.hall[2]), srgb_byte(scene.look.hall[1]), srgb_byte(scene.look.hall[0]));
  const cv::Mat image = clean.images().memory[0];
  cv::Mat1b wall;
  cv::inRange(image, cv::Scalar(expected - cv::Vec3d::all(0.6)), cv::Scalar(expected + cv::Vec3d::all(0.6)), wall);
  cv::erode(wall, wall, cv::Mat::ones(9, 9, CV_8U));
  return wall;
}

struct Statistics {
  double count = 0.0, mean = 0.0, variance = 0.0, kurtosis = 0.0;
};

Statistics statistics(const std::vector<double>& values) {
  Statistics s;
  s.count = static_cast<double>(values.size());
  for (const double value : values) s.mean += value / s.count;
  double fourth = 0.0;
  for (const double value : values) {
    const double square = (value - s.mean) * (value - s.mean);
    s.variance += square / (s.count - 1.0);
    fourth += square * square / s.count;
  }
  s.kurtosis = fourth / (s.variance * s.variance);
  return s;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const Statistics of_a = statistics(a);
  const Statistics of_b = statistics(b);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  return sum / (of_a.count * std::sqrt(of_a.variance * of_b.variance));
}

// The linear light of a channel (0 blue, 1 green, 2 red) at the wall's pixels, moved by (du, dv).
std::vector<double> light_at(const cv::Mat& image, const cv::Mat1b& wall, int channel, int du = 0, int dv = 0) {
  std::vector<double> light;
  for (int v = 4; v < wall.rows - 4; ++v) {
    for (int u = 4; u < wall.cols - 4; ++u) {
      if (wall(v, u) != 0) light.push_back(linear_of(image.at<cv::Vec3b>(v + dv, u + du)[channel]));
    }
  }
  return light;
}

// Few electrons, so that 8 bits hold the noise well; signals that are not cut off at 0 or 1.
RenderScene noisy_scene() {
  RenderScene scene = walled_scene({0.10F, 0.30F, 0.55F});
  scene.look.sensor.full_well = 500.0;
  scene.look.sensor.read_noise = 4.0;
  return scene;
}

TEST(SensorNoise, VarianceMeanAndShape) {
  const RenderScene scene = noisy_scene();
  const cv::Mat1b wall = wall_pixels(scene);
  ASSERT_GT(cv::countNonZero(wall), 20000);
  const cv::Mat image = scene.images().memory[0];
  for (int channel = 0; channel < 3; ++channel) {
    const double signal = scene.look.hall[2 - channel];
    const double variance = (4.0 * 4.0 + signal * 500.0) / (500.0 * 500.0);  // EMVA 1288, as in look.h
    const Statistics s = statistics(light_at(image, wall, channel));
    EXPECT_NEAR(s.variance / variance, 1.0, 0.04) << channel;  // 4 sigma of a sample variance: 4·√(2/20000)
    EXPECT_NEAR(s.mean, signal, 4.0 * std::sqrt(variance / s.count) + 1e-4) << channel;
    EXPECT_NEAR(s.kurtosis, 2.7, 0.1) << channel;  // that of the sum of four uniform numbers, 3 − 6/(5·4)
  }
}

TEST(SensorNoise, ExposureScalesTheSignalWithItsNoise) {
  RenderScene scene = noisy_scene();
  scene.look.sensor.exposure = 1.5;
  const cv::Mat1b wall = wall_pixels(scene);
  const Statistics s = statistics(light_at(scene.images().memory[0], wall, 1));
  const double variance = 1.5 * 1.5 * (4.0 * 4.0 + 0.30 * 500.0) / (500.0 * 500.0);
  EXPECT_NEAR(s.mean, 0.45, 0.001);
  EXPECT_NEAR(s.variance / variance, 1.0, 0.04);
}

// A correlation of n independent pairs has the standard deviation 1/√n: 0.007 here.
TEST(SensorNoise, IndependentBetweenPixelsChannelsCamerasAndFrames) {
  const RenderScene scene = noisy_scene();
  const cv::Mat1b wall = wall_pixels(scene);
  const grab::FrameSet images = scene.images(1);
  const grab::FrameSet others = scene.images(2);
  const cv::Mat& image = images.memory[0];
  const auto green = light_at(image, wall, 1);
  constexpr double kMost = 0.03;
  EXPECT_LT(std::abs(correlation(green, light_at(image, wall, 0))), kMost);
  EXPECT_LT(std::abs(correlation(green, light_at(image, wall, 2))), kMost);
  EXPECT_LT(std::abs(correlation(light_at(image, wall, 0), light_at(image, wall, 2))), kMost);
  for (const int step : {1, 2, 3, 4}) {
    EXPECT_LT(std::abs(correlation(green, light_at(image, wall, 1, step, 0))), kMost) << step;
    EXPECT_LT(std::abs(correlation(green, light_at(image, wall, 1, 0, step))), kMost) << step;
  }
  EXPECT_LT(std::abs(correlation(green, light_at(images.memory[1], wall, 1))), kMost);
  EXPECT_LT(std::abs(correlation(green, light_at(others.memory[0], wall, 1))), kMost);
}

TEST(SensorNoise, NotTheSameOneRowLowerWithTheNextSeed) {
  const RenderScene scene = noisy_scene();
  const cv::Mat1b wall = wall_pixels(scene);
  const auto green = light_at(scene.images(1).memory[0], wall, 1);
  const cv::Mat next = scene.images(2).memory[0];
  for (const int step : {-1, 1})
    EXPECT_LT(std::abs(correlation(green, light_at(next, wall, 1, 0, step))), 0.03) << step;
}

TEST(Sensor, ExposureAndWhiteBalance) {
  RenderScene scene = walled_scene({0.20F, 0.30F, 0.25F});
  scene.look.sensor.exposure = 1.5;
  scene.look.sensor.red_gain = 1.2;
  scene.look.sensor.blue_gain = 0.8;
  const cv::Mat1b wall = wall_pixels(scene);
  const cv::Scalar mean = cv::mean(scene.images().memory[0], wall);
  EXPECT_NEAR(mean[2], srgb_byte(0.20 * 1.5 * 1.2), 0.6);
  EXPECT_NEAR(mean[1], srgb_byte(0.30 * 1.5), 0.6);
  EXPECT_NEAR(mean[0], srgb_byte(0.25 * 1.5 * 0.8), 0.6);
}

TEST(Sensor, SaturatesAtWhite) {
  RenderScene scene = walled_scene({0.20F, 0.30F, 0.25F});
  const cv::Mat1b wall = wall_pixels(scene);
  scene.look.sensor.exposure = 6.0;
  const cv::Scalar mean = cv::mean(scene.images().memory[0], wall);
  for (int channel = 0; channel < 3; ++channel) EXPECT_DOUBLE_EQ(mean[channel], 255.0) << channel;
}

// Both sides of the curve's linear part, and both ends.
TEST(Sensor, SrgbCurve) {
  for (const Eigen::Array3f& wall : {Eigen::Array3f(0.0F, 0.002F, 0.0031F), Eigen::Array3f(0.0033F, 0.01F, 0.03F),
                                     Eigen::Array3f(0.5F, 0.98F, 1.0F)}) {
    const cv::Mat image = walled_scene(wall).images().memory[0];
    const auto& bgr = image.at<cv::Vec3b>(240, 110);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(bgr[2 - i], srgb_byte(wall[i]), 0.55) << wall[i];
  }
}

// OpenCV's filter on the picture without blur, in linear light. The sharp picture has 8 bits only, hence the tolerance.
TEST(SensorBlur, IsAGaussian) {
  RenderScene scene;
  scene.arena.field = read_field(data_file("fields/paper.yaml"));
  cv::Mat sharp;
  scene.images().memory[0].convertTo(sharp, CV_64F);
  sharp.forEach<cv::Vec3d>([](cv::Vec3d& bgr, const int*) {
    for (int i = 0; i < 3; ++i) bgr[i] = linear_of(static_cast<std::uint8_t>(bgr[i]));
  });
  cv::Mat1b mirror(sharp.size(), 0);
  cv::circle(mirror, {320, 240}, 224, 255, cv::FILLED);
  for (const double sigma : {0.4, 0.7, 1.0}) {
    cv::Mat expected;
    cv::GaussianBlur(sharp, expected, cv::Size(13, 13), sigma);
    expected.forEach<cv::Vec3d>([](cv::Vec3d& bgr, const int*) {
      for (int i = 0; i < 3; ++i) bgr[i] = srgb_byte(bgr[i]);
    });
    scene.look.sensor.blur_px = sigma;
    cv::Mat difference;
    cv::subtract(scene.images().memory[0], expected, difference, mirror, CV_64F);
    EXPECT_LT(cv::norm(difference, cv::NORM_INF), 2.0) << sigma;
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(cv::mean(difference, mirror)[i], 0.0, 0.02) << sigma;
  }
}

}  // namespace
}  // namespace movis
