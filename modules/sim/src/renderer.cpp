#include "movis/sim/renderer.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "eye.h"
#include "movis/grab/views.h"
#include "sensor.h"
#include "stage.h"
#include "tile.h"

namespace movis::sim {
namespace {

constexpr int kRing = 2 * kTile;  // rows of light that are kept: a row of tiles and what the blur needs around it
constexpr int kStripTiles = 8;    // rows of tiles in a strip

// Red, green, blue of each corner of a row.
struct Row {
  std::array<std::vector<float>, 3> planes;

  explicit Row(int floats) {
    for (auto& plane : planes) plane.resize(static_cast<std::size_t>(floats));
  }
};

// A part of a picture that one thread makes: some rows of tiles, and memory for the light of the rows at hand.
struct Strip {
  Strip(std::size_t index, const Eye& eye, const SensorRow& sensor, int first)
      : camera(index),
        first_row(first),
        end_row(std::min(first + kStripTiles * kTile, eye.height)),
        light(static_cast<std::size_t>(kRing) * 3 * sensor.row_floats),
        scratch(static_cast<std::size_t>(3) * sensor.row_floats),
        above(eye.stride),
        below(eye.stride) {
    for (auto& plane : rows) plane.resize(static_cast<std::size_t>(2 * sensor.radius() + 1));
  }

  std::size_t camera;
  int first_row, end_row;    // of the picture
  std::vector<float> light;  // kRing rows of three planes
  std::vector<float> scratch;
  LightRows rows;
  Row above, below;  // light at the upper and lower corners of a row of pixels
};

// The finalizer of SplitMix64 (G. L. Steele et al., OOPSLA 2014).
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31);
}

float* light_row(Strip& strip, const SensorRow& sensor, int row, int channel) {
  const int slot = (row + kRing) % kRing;
  return strip.light.data() + static_cast<std::size_t>(3 * slot + channel) * sensor.row_floats;
}

struct HallView {
  const Eye& eye;
  const Standpoint& standpoint;
  const Stage& stage;

  // The light at the upper corners of a row's pixels, for a part of it.
  void see_corners(int row, Eye::Span span, Row& light) const {
    see_hall(stage.hall, stage.shadows, standpoint, eye.corner_row(span.begin, row), span.end - span.begin,
             planes(light, span.begin));
  }
  // The light at their middles.
  void see_middles(int row, Eye::Span span, const std::array<float*, 3>& out) const {
    see_hall_between(stage.hall, stage.shadows, standpoint, eye.corner_row(span.begin, row), eye.stride,
                     span.end - span.begin, {out[0] + span.begin, out[1] + span.begin, out[2] + span.begin});
  }

 private:
  static LightPlanes planes(Row& light, int u) {
    return {light.planes[0].data() + u, light.planes[1].data() + u, light.planes[2].data() + u};
  }
};

// Floor and hall. Where the floor may be seen, half of the light is from the pixels' middles and half from their
// corners; the light at the upper corners is there already where the row above was painted just before.
void paint_hall(const HallView& view, int row, bool continued, Strip& strip, const std::array<float*, 3>& out) {
  const Eye& eye = view.eye;
  if (continued) {
    std::swap(strip.above, strip.below);
  } else {
    for (const Eye::Span& span : eye.floor_corners[row]) view.see_corners(row, span, strip.above);
  }
  for (const Eye::Span& span : eye.floor_corners[row + 1]) view.see_corners(row + 1, span, strip.below);
  for (const Eye::Span& span : eye.open[row]) view.see_middles(row, span, out);
  for (const Eye::Span& span : eye.floor[row]) {
    for (int channel = 0; channel < 3; ++channel) {
      const float* above = strip.above.planes[channel].data();
      const float* below = strip.below.planes[channel].data();
      float* pixel = out[channel];
      for (int u = span.begin; u < span.end; ++u) {
        pixel[u] = 0.5F * pixel[u] + 0.125F * (above[u] + above[u + 1] + below[u] + below[u + 1]);
      }
    }
  }
}

// The colour beside the mirror, on both sides of it.
void paint_beside(Eye::Span mirror, const Colour& colour, const SensorRow& sensor, const std::array<float*, 3>& row) {
  for (int channel = 0; channel < 3; ++channel) {
    float* begin = row[channel] - sensor.radius();
    std::fill(begin, row[channel] + mirror.begin, colour[channel]);
    std::fill(row[channel] + mirror.end, begin + sensor.row_floats, colour[channel]);
  }
}

// A row of tiles into the light of a strip.
void paint_tiles(const HallView& view, const SensorRow& sensor, const Colour& beside, TilePainter& painter,
                 int tile_row, Strip& strip) {
  const Eye& eye = view.eye;
  const int top = tile_row * kTile;
  const int rows = std::min(kTile, eye.height - top);
  LightRowsOut light{};
  for (int v = 0; v < rows; ++v) {
    std::array<float*, 3> out{};
    for (int channel = 0; channel < 3; ++channel) {
      out[channel] = light_row(strip, sensor, top + v, channel) + sensor.radius();
      light.rows[channel][v] = out[channel];
    }
    paint_hall(view, top + v, v > 0, strip, out);
    paint_beside(eye.mirror[top + v], beside, sensor, out);
  }
  for (int column = 0; column < eye.tile_columns; ++column) painter.paint(column, tile_row, light);
}

// What a camera's sensor makes of the even colour beside the mirror: enough of it to begin somewhere else in every row.
class Surrounding {
 public:
  Surrounding(const Colour& colour, const Sensor& sensor, int width) {
    const int count = kOffsets + width;
    const SensorRow row = make_sensor_row(sensor, count);
    LightRows light;
    std::array<std::vector<float>, 3> planes;
    for (int channel = 0; channel < 3; ++channel) {
      planes[channel].assign(static_cast<std::size_t>(row.row_floats), colour[channel]);
      light[channel].assign(static_cast<std::size_t>(2 * row.radius() + 1), planes[channel].data());
    }
    std::vector<float> scratch(static_cast<std::size_t>(3) * row.row_floats);
    bgr_.resize(static_cast<std::size_t>(3) * count);
    expose(light, row, 0, count, 0, scratch.data(), bgr_.data());
  }

  void copy(std::uint32_t key, int begin, int end, std::uint8_t* bgr) const {
    const std::uint8_t* row = bgr_.data() + 3 * (key % kOffsets);
    if (begin < end) std::copy(row + 3 * begin, row + 3 * end, bgr + 3 * begin);
  }

 private:
  static constexpr int kOffsets = 4096;
  std::vector<std::uint8_t> bgr_;
};

// Everything about a camera that stays.
struct CameraPart {
  Eye eye;
  SensorRow sensor;
  Surrounding surrounding;
};

void expose_row(const CameraPart& camera, int row, std::uint64_t seed, Strip& strip, cv::Mat& image) {
  const SensorRow& sensor = camera.sensor;
  const int radius = sensor.radius();
  for (int channel = 0; channel < 3; ++channel) {
    for (int i = -radius; i <= radius; ++i) {
      const int around = std::clamp(row + i, 0, camera.eye.height - 1);
      strip.rows[channel][i + radius] = light_row(strip, sensor, around, channel);
    }
  }
  const auto key =
      static_cast<std::uint32_t>(mixed(seed ^ mixed(strip.camera * 0x10000U + static_cast<unsigned>(row))));
  const Eye::Span mirror = camera.eye.mirror[row];
  const int begin = mirror.empty() ? 0 : std::max(0, mirror.begin - radius);
  const int end = mirror.empty() ? 0 : std::min(sensor.width, mirror.end + radius);
  camera.surrounding.copy(key, 0, begin, image.ptr(row));
  expose(strip.rows, sensor, begin, end, key, strip.scratch.data(), image.ptr(row));
  camera.surrounding.copy(key, end, sensor.width, image.ptr(row));
}

}  // namespace

struct Renderer::Cameras {
  Cameras(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look);

  void make_strip(const State& state, std::uint64_t seed, Strip& strip, cv::Mat& image) const;

  Stage stage;
  Colour beside;
  std::vector<CameraPart> cameras;
  std::vector<Strip> strips;
};

Renderer::Cameras::Cameras(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look)
    : stage(arena, robot, look), beside(look.outside) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const int width = rig.cameras[i].width;
    cameras.push_back(
        {Eye(rig, i, robot, look), make_sensor_row(look.sensor, width), Surrounding(look.outside, look.sensor, width)});
    const CameraPart& camera = cameras.back();
    for (int row = 0; row < camera.eye.height; row += kStripTiles * kTile) {
      strips.emplace_back(i, camera.eye, camera.sensor, row);
    }
  }
}

void Renderer::Cameras::make_strip(const State& state, std::uint64_t seed, Strip& strip, cv::Mat& image) const {
  const Eye& eye = cameras[strip.camera].eye;
  const SensorRow& sensor = cameras[strip.camera].sensor;
  const Pose2& pose = state.world_from_robot;
  Standpoint standpoint{{},
                        pose.translation().cast<float>(),
                        static_cast<float>(std::cos(pose.beta)),
                        static_cast<float>(std::sin(pose.beta))};
  standpoint.origin = standpoint.to_field(eye.position);
  standpoint.origin.head<2>() += standpoint.robot;
  TilePainter painter(eye, standpoint, stage);
  const HallView view{eye, standpoint, stage};

  const int first = std::max(0, strip.first_row - sensor.radius());
  const int end = std::min(eye.height, strip.end_row + sensor.radius());
  int exposed = strip.first_row;
  for (int tile_row = first / kTile; tile_row * kTile < end; ++tile_row) {
    paint_tiles(view, sensor, beside, painter, tile_row, strip);
    const int painted = std::min((tile_row + 1) * kTile, eye.height);
    const int ready = painted == eye.height ? strip.end_row : std::min(painted - sensor.radius(), strip.end_row);
    for (; exposed < ready; ++exposed) expose_row(cameras[strip.camera], exposed, seed, strip, image);
  }
}

Renderer::Renderer(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look)
    : cameras_(std::make_unique<Cameras>(rig, arena, robot, look)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::render(const State& state, std::uint64_t noise_seed, grab::FrameSet& images) {
  auto& cameras = cameras_->cameras;
  images.memory.resize(cameras.size());
  images.frames.resize(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    images.memory[i].create(cameras[i].eye.height, cameras[i].eye.width, CV_8UC3);
    images.frames[i] = {grab::view_of(images.memory[i]), state.time_s};
  }
  cameras_->stage.set(state);
  auto& strips = cameras_->strips;
  cv::parallel_for_(cv::Range(0, static_cast<int>(strips.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) {
      cameras_->make_strip(state, noise_seed, strips[i], images.memory[strips[i].camera]);
    }
  });
}

}  // namespace movis::sim
