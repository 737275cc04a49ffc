#include <algorithm>
#include <cmath>
#include <optional>

#include "membership.h"
#include "movis/core/angle.h"
#include "movis/scan/refine.h"
#include "spans.h"

namespace movis::scan {
namespace {

using Sample = RefineScratch::Sample;

// One of the goal's two edges, coarsely: the outer side of the segment's outermost bin.
struct Edge {
  int outermost;  // its place in the segment
  int inwards;    // +1: the right edge, azimuth grows inwards; −1: the left edge
  double azimuth;

  // How many bins inwards of the edge a pixel lies: 0 is the outermost bin of the goal, −1 its neighbour outside.
  int bins_inwards(const ObjectPixel& pixel) const { return inwards * (pixel.place - outermost); }
};

struct Goal {
  float dark = 0.0F;  // ε of refine.h
  Chromaticity hue;   // the goal's own, of length 1
  double mean_z = 0.0;
};

Goal describe(const ImageView& image, const std::vector<ObjectPixel>& object, double dark) {
  constexpr std::size_t kEnough = 500;  // pixels, to know the hue
  const std::size_t step = object.size() / kEnough + 1;
  Goal goal;
  goal.dark = static_cast<float>(dark);
  for (std::size_t i = 0; i < object.size(); i += step) {
    goal.hue = goal.hue + chromaticity(light_at(image, object[i].u, object[i].v), goal.dark);
  }
  if (const float length = saturation(goal.hue); length > 0.0F) goal.hue = goal.hue * (1.0F / length);
  for (const ObjectPixel& pixel : object) goal.mean_z += pixel.z;
  goal.mean_z /= static_cast<double>(object.size());
  return goal;
}

// The part of the goal near an edge in which the edge is sought.
struct Region {
  float z_low = 0.0F, z_high = 0.0F;  // of the pixels' rays
  double window = 0.0;                // half width in azimuth, radians
  Rows rows;                          // of scratch.widened
};

// The azimuth that a pixel covers; straight below the camera it would be without bound.
float azimuth_size(const PixelRay& ray) {
  constexpr float kLeast = 1e-3F;
  return std::sqrt(ray.solid_angle / std::max(kLeast, 1.0F - ray.z * ray.z));
}

std::optional<Region> find_region(const PolarMap& map, const std::vector<ObjectPixel>& object, const Edge& edge,
                                  int bins, const RefineOptions& options, RefineScratch& scratch) {
  // The goal's height near the edge, from the bins one to three degrees inwards of it.
  const double bins_per_degree = map.bins / 360.0;
  const int from = std::min(static_cast<int>(bins_per_degree), bins / 3);
  const int to = std::max(from + 1, std::min(static_cast<int>(3.0 * bins_per_degree), bins / 2));
  auto& heights = scratch.values;
  heights.clear();
  const ObjectPixel* inside = nullptr;
  for (const ObjectPixel& pixel : object) {
    const int inwards = edge.bins_inwards(pixel);
    if (inwards < from || inwards >= to) continue;
    heights.push_back(pixel.z);
    inside = &pixel;
  }
  constexpr std::size_t kFewest = 4;
  if (heights.size() < kFewest) return std::nullopt;
  const double size = azimuth_size(map.ray[map.index(inside->u, inside->v)]);
  const auto tenth = static_cast<std::ptrdiff_t>(heights.size() / 10);
  std::nth_element(heights.begin(), heights.begin() + tenth, heights.end());
  const float bottom = heights[tenth];
  std::nth_element(heights.begin(), heights.end() - 1 - tenth, heights.end());
  const float top = *(heights.end() - 1 - tenth);
  const float margin = static_cast<float>(0.5 * (1.0 - options.edge_band)) * (top - bottom);

  Region region;
  region.z_low = bottom + margin;
  region.z_high = top - margin;
  region.window = std::max(radians(options.edge_window_deg), 4.0 * size);
  const int window_bins = static_cast<int>(region.window / (2.0 * kPi) * map.bins) + 1;
  const auto near_edge = [&](const ObjectPixel& pixel) {
    return pixel.z >= region.z_low && pixel.z <= region.z_high && edge.bins_inwards(pixel) <= window_bins;
  };
  const Rows own = collect_spans(object, near_edge, scratch.spans);
  const int border = static_cast<int>(region.window / size) + 2;
  region.rows = widen(scratch.spans, own, border, map.width, map.height, scratch.widened);
  return region;
}

// The pixels of the window; their membership is still the chromaticity along the goal's hue.
void collect_samples(const ImageView& image, const PolarMap& map, const Goal& goal, const Edge& edge,
                     const Region& region, RefineScratch& scratch) {
  const auto cos_edge = static_cast<float>(std::cos(edge.azimuth));
  const auto sin_edge = static_cast<float>(std::sin(edge.azimuth));
  const auto inwards = static_cast<float>(edge.inwards);
  const auto window = static_cast<float>(std::tan(std::min(region.window, 1.0)));
  // The bins of the window: one comparison spares most pixels their ray.
  const double bins_per_radian = map.bins / (2.0 * kPi);
  const int edge_bin = static_cast<int>((edge.azimuth + kPi) * bins_per_radian);
  const int reach = static_cast<int>(region.window * bins_per_radian) + 1;
  const int first_bin = (edge_bin - reach + 2 * map.bins) % map.bins;
  scratch.samples.clear();
  for (int v = region.rows.begin; v < region.rows.end; ++v) {
    for (int u = scratch.widened[v].begin; u < scratch.widened[v].end; ++u) {
      const int beyond_first = map.bin[map.index(u, v)] - first_bin;
      if ((beyond_first < 0 ? beyond_first + map.bins : beyond_first) > 2 * reach) continue;
      const PixelRay& ray = map.ray[map.index(u, v)];
      if (ray.solid_angle <= 0.0F || ray.z < region.z_low || ray.z > region.z_high) continue;
      const float forward = ray.x * cos_edge + ray.y * sin_edge;
      const float sideways = inwards * (ray.y * cos_edge - ray.x * sin_edge);
      if (forward <= 0.0F || std::abs(sideways) > window * forward) continue;
      if (scratch.samples.size() == scratch.samples.capacity()) return;
      const float tangent = sideways / forward;
      const float offset = tangent * (1.0F - tangent * tangent * (1.0F / 3.0F - 0.2F * tangent * tangent));  // atan
      const Light light = light_at(image, u, v);
      scratch.samples.push_back(
          {offset, 1.0F / azimuth_size(ray), dot(chromaticity(light, goal.dark), goal.hue), brightness(light)});
    }
  }
}

// Is it mostly black just outside the edge?
bool ends_at_black(const std::vector<Sample>& samples, double window) {
  int outer = 0;
  int black = 0;
  for (const Sample& sample : samples) {
    if (sample.offset > -0.5 * window) continue;
    ++outer;
    if (sample.brightness < kBlack) ++black;
  }
  return 2 * black > outer;
}

// The two sides of the edge, from the window's ends: mean chromaticity along the goal's hue and mean brightness + ε.
struct Side {
  double chroma = 0.0;
  double brightness = 0.0;
  int pixels = 0;

  void add(const Sample& sample, float dark) {
    chroma += sample.membership;
    brightness += sample.brightness + dark;
    ++pixels;
  }
  void divide() {
    chroma /= pixels;
    brightness /= pixels;
  }
};

// Chromaticity to membership. Light mixes, chromaticities do not: of a pixel that shows the goal (c_o, brightness s_o)
// with a share f and its surroundings (c_b, s_b) with the rest, it is
//   c = (f s_o c_o + (1 − f) s_b c_b) / (f s_o + (1 − f) s_b)   ⇔   f = s_b (c − c_b) / (s_b (c − c_b) + s_o (c_o −
//   c)).
// False where the two sides do not differ.
bool normalize(std::vector<Sample>& samples, double window, float dark) {
  Side inside, outside;
  for (const Sample& sample : samples) {
    if (sample.offset > 0.5 * window) inside.add(sample, dark);
    if (sample.offset < -0.5 * window) outside.add(sample, dark);
  }
  constexpr int kFewest = 3;
  if (inside.pixels < kFewest || outside.pixels < kFewest) return false;
  inside.divide();
  outside.divide();
  constexpr double kLeastContrast = 0.1;
  if (inside.chroma - outside.chroma < kLeastContrast) return false;
  // Noise may exceed both sides: cut off there, it would no longer average out.
  constexpr double kExcess = 0.25;
  const double excess = kExcess * (inside.chroma - outside.chroma);
  for (Sample& sample : samples) {
    const double chroma = std::clamp<double>(sample.membership, outside.chroma - excess, inside.chroma + excess);
    const double goal = outside.brightness * (chroma - outside.chroma);
    const double other = inside.brightness * (inside.chroma - chroma);
    sample.membership = static_cast<float>(goal / (goal + other));
  }
  return true;
}

struct Crossing {
  double offset = 0.0;    // from the coarse edge, inwards
  double variance = 0.0;  // rad²
  bool hidden = false;    // something else ends there, the edge lies behind it
};

// The step position at which Σ w = Σ S: Newton's method within a bracket, as Σ S falls with the position in straight
// pieces. Nothing where it lies beyond the window.
std::optional<Crossing> solve_step(const std::vector<Sample>& samples, double window, double pixel_sigma) {
  constexpr int kMaxSteps = 50;
  constexpr double kTolerance = 1e-6;  // radians
  double weight = 0.0;
  for (const Sample& sample : samples) weight += sample.membership;
  double low = -window;
  double high = window;
  // Where the step would be if the samples were spread evenly: close already.
  double edge = window * (1.0 - 2.0 * weight / static_cast<double>(samples.size()));
  for (int step = 0; step < kMaxSteps; ++step) {
    float sum = 0.0F;
    float slope = 0.0F;  // −dΣS/d edge
    const auto position = static_cast<float>(edge);
    for (const Sample& sample : samples) {
      const float x = (sample.offset - position) * sample.scale + 0.5F;
      sum += std::clamp(x, 0.0F, 1.0F);
      slope += x > 0.0F && x < 1.0F ? sample.scale : 0.0F;
    }
    const double excess = sum - weight;
    (excess > 0.0 ? low : high) = edge;
    double next = slope > 0.0F ? edge + excess / slope : high;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = next - edge;
    edge = next;
    if (std::abs(change) > kTolerance) continue;
    if (std::abs(edge) > 0.9 * window) return std::nullopt;
    // Each of the rows that cross the edge places it to pixel_sigma; slope / scale is about their number.
    const double scale = samples.front().scale;
    return Crossing{edge, pixel_sigma * pixel_sigma / (scale * scale) / std::max(1.0, slope / scale), false};
  }
  return std::nullopt;
}

std::optional<Crossing> refine_edge(const ImageView& image, const PolarMap& map, const std::vector<ObjectPixel>& object,
                                    const Goal& goal, const Edge& edge, int bins, const RefineOptions& options,
                                    RefineScratch& scratch) {
  const auto region = find_region(map, object, edge, bins, options, scratch);
  if (!region) return std::nullopt;
  collect_samples(image, map, goal, edge, *region, scratch);
  if (!normalize(scratch.samples, region->window, goal.dark)) return std::nullopt;
  auto crossing = solve_step(scratch.samples, region->window, options.pixel_sigma);
  if (crossing) crossing->hidden = ends_at_black(scratch.samples, region->window);
  return crossing;
}

}  // namespace

bool refine_goal(const ImageView& image, const PolarMap& map, const std::vector<ObjectPixel>& object,
                 const Segment& segment, const RefineOptions& options, RefineScratch& scratch, Bearing& bearing) {
  if (object.empty()) return false;
  const Goal goal = describe(image, object, options.dark);
  const double bin = 2.0 * kPi / map.bins;
  const Edge right{0, +1, -kPi + segment.first * bin};
  const Edge left{segment.length - 1, -1, -kPi + (segment.first + segment.length) * bin};
  const auto crossing_at = [&](const Edge& edge, std::uint8_t& flags) {
    // Without a step to be found, the goal ends at the border of what is scanned, or behind something.
    const auto found = refine_edge(image, map, object, goal, edge, segment.length, options, scratch);
    Crossing crossing = found.value_or(Crossing{0.0, bin * bin, true});
    if (crossing.hidden) {
      flags |= kCutByObject;
      crossing.variance = std::max(crossing.variance, std::pow(0.5 * segment.length * bin, 2));
    }
    return crossing;
  };
  const Crossing at_right = crossing_at(right, bearing.right_flags);
  const Crossing at_left = crossing_at(left, bearing.left_flags);
  bearing.flags |= bearing.left_flags | bearing.right_flags;

  const double floor = radians(options.azimuth_floor_deg);
  bearing.right = wrap_angle(right.azimuth + at_right.offset);
  bearing.left = wrap_angle(left.azimuth - at_left.offset);
  bearing.right_variance = at_right.variance + floor * floor;
  bearing.left_variance = at_left.variance + floor * floor;
  bearing.azimuth = wrap_angle(bearing.right + 0.5 * turn(bearing.right, bearing.left));
  bearing.elevation = std::asin(goal.mean_z);
  bearing.weight = static_cast<double>(object.size());
  const double elevation_sigma = radians(options.elevation_floor_deg) + std::sqrt(bearing.left_variance);
  bearing.covariance =
      Eigen::Vector2d(0.25 * (bearing.left_variance + bearing.right_variance), elevation_sigma * elevation_sigma)
          .asDiagonal();
  return true;
}

}  // namespace movis::scan
