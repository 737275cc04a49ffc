#include "strip.h"

#include <algorithm>
#include <limits>

namespace movis::sim {
namespace {

// Rows of light that are kept: a row of tiles, and what the blur needs above and below it.
constexpr int kRing = kTile + 8;
static_assert(kRing >= kTile + 2 * kMostRadius + 1);

// The finalizer of SplitMix64 (G. L. Steele et al., OOPSLA 2014).
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31);
}

float* light_row(Workspace& work, const SensorRow& sensor, int row, int channel) {
  return work.light.data() + static_cast<std::size_t>(3 * (row % kRing) + channel) * sensor.row_floats;
}

struct HallView {
  const Eye& eye;
  const Standpoint& standpoint;
  const Stage& stage;

  // The light at the upper corners of a row's pixels, for a part of it.
  void see_corners(int row, Eye::Span span, Workspace::Row& light) const {
    see_hall(stage.hall, stage.shadows, standpoint, eye.corner_row(span.begin, row), span.end - span.begin,
             planes(light, span.begin));
  }
  // The light at their middles.
  void see_middles(int row, Eye::Span span, const std::array<float*, 3>& out) const {
    see_hall_between(stage.hall, stage.shadows, standpoint, eye.corner_row(span.begin, row), eye.stride,
                     span.end - span.begin, {out[0] + span.begin, out[1] + span.begin, out[2] + span.begin});
  }

 private:
  static LightPlanes planes(Workspace::Row& light, int u) {
    return {light[0].data() + u, light[1].data() + u, light[2].data() + u};
  }
};

// Floor and hall. Where the floor may be seen, half of the light is from the pixels' middles and half from their
// corners; the light at the upper corners is there already where the row above was painted just before.
void paint_hall(const HallView& view, int row, bool continued, Workspace& work, const std::array<float*, 3>& out) {
  const Eye& eye = view.eye;
  if (continued) {
    std::swap(work.above, work.below);
  } else {
    for (const Eye::Span& span : eye.floor_corners[row]) view.see_corners(row, span, work.above);
  }
  for (const Eye::Span& span : eye.floor_corners[row + 1]) view.see_corners(row + 1, span, work.below);
  for (const Eye::Span& span : eye.open[row]) view.see_middles(row, span, out);
  for (const Eye::Span& span : eye.floor[row]) {
    for (int channel = 0; channel < 3; ++channel) {
      const float* above = work.above[channel].data();
      const float* below = work.below[channel].data();
      float* pixel = out[channel];
      for (int u = span.begin; u < span.end; ++u) {
        pixel[u] = 0.5F * pixel[u] + 0.125F * (above[u] + above[u + 1] + below[u] + below[u + 1]);
      }
    }
  }
}

// What another unit's mirror shows there.
Colour reflected(const Reflection& reflection, const Standpoint& standpoint, const Stage& stage) {
  Ray ray{standpoint.to_field(reflection.origin), standpoint.to_field(reflection.direction)};
  ray.origin.head<2>() += standpoint.robot;
  const Prop* nearest = nullptr;
  Hit hit{}, candidate{};
  for (const Prop& prop : stage.props) {
    if (!intersect(prop, ray, candidate) || (nearest != nullptr && candidate.distance >= hit.distance)) continue;
    nearest = &prop;
    hit = candidate;
  }
  if (nearest == nullptr) return stage.hall.colour(ray, stage.shadows);
  return colour_of(*nearest, ray, hit, stage.hall.light());
}

// The own robot over everything else.
void paint_robot(const HallView& view, int row, const std::array<float*, 3>& out) {
  const Eye& eye = view.eye;
  const std::size_t first = static_cast<std::size_t>(row) * eye.width;
  const float* open = eye.own.open.data() + first;
  for (const Eye::Span& span : eye.own_robot[row]) {
    for (int channel = 0; channel < 3; ++channel) {
      const float* own = eye.own.planes[channel].data() + first;
      float* light = out[channel];
      for (int u = span.begin; u < span.end; ++u) light[u] = open[u] * light[u] + own[u];
    }
  }
  const auto [begin, end] = eye.reflections_of(row);
  for (const Reflection* reflection = begin; reflection != end; ++reflection) {
    const Colour shown = reflection->weight * reflected(*reflection, view.standpoint, view.stage);
    for (int channel = 0; channel < 3; ++channel) out[channel][reflection->column] += shown[channel];
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

// A row of tiles into the light of a work.
void paint_tiles(const HallView& view, const SensorRow& sensor, const Colour& beside, TilePainter& painter,
                 int tile_row, Workspace& work) {
  const Eye& eye = view.eye;
  const int top = tile_row * kTile;
  const int rows = std::min(kTile, eye.height - top);
  LightRowsOut light{};
  for (int v = 0; v < rows; ++v) {
    std::array<float*, 3> out{};
    for (int channel = 0; channel < 3; ++channel) {
      out[channel] = light_row(work, sensor, top + v, channel) + sensor.radius();
      light.rows[channel][v] = out[channel];
    }
    paint_hall(view, top + v, v > 0, work, out);
    paint_beside(eye.mirror[top + v], beside, sensor, out);
  }
  for (int column = 0; column < eye.tile_columns; ++column) painter.paint(column, tile_row, light);
  for (int v = 0; v < rows; ++v) paint_robot(view, top + v, {light.rows[0][v], light.rows[1][v], light.rows[2][v]});
}

// What the spans of a row and of those up to `radius` rows from it cover together.
Eye::Span around_row(const std::vector<Eye::Span>& spans, int row, int radius) {
  Eye::Span all{std::numeric_limits<int>::max(), 0};
  const int last = std::min(row + radius, static_cast<int>(spans.size()) - 1);
  for (int i = std::max(0, row - radius); i <= last; ++i) {
    if (spans[i].empty()) continue;
    all = {std::min(all.begin, spans[i].begin), std::max(all.end, spans[i].end)};
  }
  return all;
}

void expose_row(const CameraParts& camera, int row, std::uint64_t seed, Workspace& work, std::uint8_t* bgr) {
  const SensorRow& sensor = camera.sensor;
  const int radius = sensor.radius();
  for (int channel = 0; channel < 3; ++channel) {
    for (int i = -radius; i <= radius; ++i) {
      const int around = std::clamp(row + i, 0, camera.eye.height - 1);
      work.rows[channel][i + radius] = light_row(work, sensor, around, channel);
    }
  }
  const auto key = static_cast<std::uint32_t>(mixed(mixed(seed) + static_cast<std::uint64_t>(row)));
  const Eye::Span mirror = around_row(camera.eye.mirror, row, radius);
  const int begin = mirror.empty() ? 0 : std::max(0, mirror.begin - radius);
  const int end = mirror.empty() ? 0 : std::min(sensor.width, mirror.end + radius);
  camera.surrounding.copy(key, 0, begin, bgr);
  expose(work.rows, sensor, begin, end, key, work.scratch.data(), bgr);
  camera.surrounding.copy(key, end, sensor.width, bgr);
}

}  // namespace

Workspace::Workspace(int row_floats, int corners)
    : light(static_cast<std::size_t>(kRing) * 3 * row_floats), scratch(static_cast<std::size_t>(3) * row_floats) {
  for (auto& plane : rows) plane.resize(2 * kMostRadius + 1);
  for (auto* row : {&above, &below}) {
    for (auto& plane : *row) plane.resize(static_cast<std::size_t>(corners));
  }
}

void make_strip(const CameraParts& camera, const Stage& stage, const Pose2& world_from_robot, int first_row,
                int end_row, std::uint64_t noise_seed, Workspace& work, std::uint8_t* bgr) {
  const Eye& eye = camera.eye;
  const int radius = camera.sensor.radius();
  const Standpoint standpoint = make_standpoint(eye.position, world_from_robot);
  TilePainter painter(eye, standpoint, stage, work.tiles);
  const HallView view{eye, standpoint, stage};

  const int first = std::max(0, first_row - radius);
  const int end = std::min(eye.height, end_row + radius);
  int exposed = first_row;
  for (int tile_row = first / kTile; tile_row * kTile < end; ++tile_row) {
    paint_tiles(view, camera.sensor, camera.beside, painter, tile_row, work);
    const int painted = std::min((tile_row + 1) * kTile, eye.height);
    const int ready = painted == eye.height ? end_row : std::min(painted - radius, end_row);
    for (; exposed < ready; ++exposed) {
      expose_row(camera, exposed, noise_seed, work, bgr + static_cast<std::ptrdiff_t>(3) * eye.width * exposed);
    }
  }
}

}  // namespace movis::sim
