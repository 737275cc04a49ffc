// Three rendered 640×480 images of the small field, with the lens's blur and the sensor's noise, on one thread. Its
// parts: the light alone, with blur, with both. The peer is OpenCV doing only the lens and the sensor on light that is
// there already as float images: GaussianBlur, randn scaled by each pixel's own sigma, and the sRGB curve by a look-up
// table.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "movis/core/paths.h"
#include "movis/sim/renderer.h"
#include "ratio_table.h"
#include "sensor.h"

namespace {

using namespace movis;

struct Scene {
  omni::Rig rig = omni::read_rig(data_file("rigs/movis.yaml"));
  control::RobotModel robot = control::read_robot(data_file("robots/miniature.yaml"));
  sim::Look look = sim::read_look(data_file("looks/hall.yaml"));
  sim::Arena arena;

  Scene() { arena.field = read_field(data_file("fields/paper.yaml")); }
};

// The robot drives a circle, the ball lies before it, now nearer, now farther.
sim::State state_at(int frame) {
  const double angle = 0.1 * frame;
  const double distance = 0.8 + 0.4 * std::sin(0.37 * frame);
  const Pose2 pose{0.7 * std::cos(angle), 0.7 * std::sin(angle), angle};
  const Eigen::Vector2d ball = pose * Eigen::Vector2d(0.0, distance);
  return {frame / 30.0, pose, {ball.x(), ball.y(), sim::kBallRadius}};
}

void run(benchmark::State& state, const Scene& scene, int threads = 1) {
  cv::setNumThreads(threads);
  sim::Renderer renderer(scene.rig, scene.arena, scene.robot, scene.look);
  grab::FrameSet images;
  int frame = 0;
  for (auto _ : state) {
    renderer.render(state_at(frame), static_cast<std::uint64_t>(frame), images);
    benchmark::DoNotOptimize(images.memory[0].data);
    ++frame;
  }
}

void render(benchmark::State& state) {
  run(state, Scene());
}
BENCHMARK(render)->Unit(benchmark::kMicrosecond);

void render_light(benchmark::State& state) {
  Scene scene;
  scene.look.sensor = {};
  run(state, scene);
}
BENCHMARK(render_light)->Unit(benchmark::kMicrosecond);

void render_light_blur(benchmark::State& state) {
  Scene scene;
  scene.look.sensor.full_well = scene.look.sensor.read_noise = 0.0;
  run(state, scene);
}
BENCHMARK(render_light_blur)->Unit(benchmark::kMicrosecond);

void render_two_opponents(benchmark::State& state) {
  Scene scene;
  scene.arena.obstacles = {{{0.6, 1.3}}, {{-0.9, -0.4}}};
  run(state, scene);
}
BENCHMARK(render_two_opponents)->Unit(benchmark::kMicrosecond);

void render_two_threads(benchmark::State& state) {
  run(state, Scene(), 2);
}
BENCHMARK(render_two_threads)->Unit(benchmark::kMicrosecond)->UseRealTime();

// The sensor of look.h by OpenCV. The curve goes by the root of the light, so that a table of 256 is enough.
class OpenCvSensor {
 public:
  explicit OpenCvSensor(const sim::Sensor& sensor) : sensor_(sensor), curve_(1, 256, CV_8U) {
    for (int i = 0; i < 256; ++i) {
      const double light = i * i / (255.0 * 255.0);
      const double value = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
      curve_.at<std::uint8_t>(i) = cv::saturate_cast<std::uint8_t>(255.0 * value);
    }
  }

  void operator()(const cv::Mat& light, cv::Mat& image) {
    cv::GaussianBlur(light, signal_, cv::Size(3, 3), sensor_.blur_px);
    const double read = sensor_.read_noise / sensor_.full_well;
    signal_.convertTo(sigma_, CV_32F, 1.0 / sensor_.full_well, read * read);
    cv::sqrt(sigma_, sigma_);
    noise_.create(light.size(), light.type());
    cv::randn(noise_, cv::Scalar::all(0.0), cv::Scalar::all(1.0));
    cv::multiply(noise_, sigma_, noise_);
    cv::add(signal_, noise_, signal_);
    cv::max(signal_, 0.0, signal_);
    cv::sqrt(signal_, signal_);
    signal_.convertTo(root_, CV_8U, 255.0);
    cv::LUT(root_, curve_, image);
  }

 private:
  sim::Sensor sensor_;
  cv::Mat curve_, signal_, sigma_, noise_, root_;
};

// Linear light of three images, blue, green, red.
std::array<cv::Mat, 3> linear_light(Scene scene) {
  scene.look.sensor = {};
  sim::Renderer renderer(scene.rig, scene.arena, scene.robot, scene.look);
  grab::FrameSet images;
  renderer.render(state_at(0), 1, images);
  std::array<cv::Mat, 3> light;
  for (std::size_t i = 0; i < light.size(); ++i) {
    images.memory[i].convertTo(light[i], CV_32F, 1.0 / 255.0);
    cv::pow(light[i], 2.2, light[i]);
  }
  return light;
}

void opencv_sensor(benchmark::State& state) {
  cv::setNumThreads(1);
  const Scene scene;
  OpenCvSensor sensor(scene.look.sensor);
  const std::array<cv::Mat, 3> light = linear_light(scene);
  std::array<cv::Mat, 3> exposed;
  for (auto _ : state) {
    for (std::size_t i = 0; i < light.size(); ++i) sensor(light[i], exposed[i]);
    benchmark::DoNotOptimize(exposed[0].data);
  }
}
BENCHMARK(opencv_sensor)->Unit(benchmark::kMicrosecond);

// The same light in our own planes: whole pictures, also beside the mirror.
void sensor(benchmark::State& state) {
  const Scene scene;
  const std::array<cv::Mat, 3> light = linear_light(scene);
  const sim::SensorRow row = sim::make_sensor_row(scene.look.sensor, light[0].cols);
  const int radius = row.radius();
  std::array<std::array<cv::Mat, 3>, 3> planes;  // of each image: red, green, blue, with the blur's margin
  for (std::size_t i = 0; i < light.size(); ++i) {
    cv::Mat padded;
    cv::copyMakeBorder(light[i], padded, 0, 0, radius, row.row_floats - radius - row.width, cv::BORDER_REPLICATE);
    for (int channel = 0; channel < 3; ++channel) cv::extractChannel(padded, planes[i][channel], 2 - channel);
  }
  sim::LightRows rows;
  for (auto& channel : rows) channel.resize(static_cast<std::size_t>(2 * radius + 1));
  std::vector<float> scratch(static_cast<std::size_t>(3) * row.row_floats);
  cv::Mat exposed(light[0].size(), CV_8UC3);
  std::uint32_t key = 0;
  for (auto _ : state) {
    for (const auto& image : planes) {
      for (int v = 0; v < exposed.rows; ++v) {
        for (int channel = 0; channel < 3; ++channel) {
          for (int i = -radius; i <= radius; ++i) {
            rows[channel][i + radius] = image[channel].ptr<float>(std::clamp(v + i, 0, exposed.rows - 1));
          }
        }
        sim::expose(rows, row, 0, row.width, key += 0x9E3779B9U, scratch.data(), exposed.ptr(v));
      }
    }
    benchmark::DoNotOptimize(exposed.data);
  }
}
BENCHMARK(sensor)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  return movis::bench::run_and_compare(argc, argv, {{"sensor", "opencv_sensor"}, {"render", "opencv_sensor"}});
}
