#include <algorithm>
#include <cmath>
#include <optional>

#include "membership.h"
#include "movis/core/angle.h"
#include "movis/scan/refine.h"

namespace movis::scan {
namespace {

using Sample = RefineScratch::Sample;

// One of the goal's two edges, coarsely: the outer side of the segment's outermost bin.
struct Edge {
  int outermost_bin;
  int inwards;  // +1: the right edge, azimuth grows inwards; −1: the left edge
  double azimuth;
};

Edge make_edge(const PolarMap& map, int outermost_bin, int inwards) {
  const double width = 2.0 * kPi / map.bins;
  return {outermost_bin, inwards, -kPi + (outermost_bin + (inwards > 0 ? 0 : 1)) * width};
}

// How many bins inwards of the edge a bin lies: 0 is the outermost one of the goal, −1 its neighbour outside.
int bins_inwards(const PolarMap& map, const Edge& edge, int bin) {
  int difference = bin - edge.outermost_bin;
  if (difference > map.bins / 2) difference -= map.bins;
  if (difference < -map.bins / 2) difference += map.bins;
  return edge.inwards * difference;
}

struct Goal {
  ObjectClass object = ObjectClass::yellow_goal;
  float dark = 0.0F;  // ε of refine.h
  Chromaticity hue;   // the goal's own, of length 1
  double mean_z = 0.0;
  double pixels = 0.0;
};

// Calls `use` for every hit of the goal.
template <typename Use>
void for_goal(const PolarMap& map, const std::vector<Hit>& hits, const std::vector<std::uint8_t>& selected,
              ObjectClass object, Use use) {
  for (const Hit& hit : hits) {
    if (hit.object != object) continue;
    const std::size_t index = map.index(hit.u, hit.v);
    if (selected[map.bin[index]] != 0) use(hit, index);
  }
}

// The part of the goal near an edge: the band of z in which the edge is sought, and a box around it in the image.
struct Region {
  float z_low, z_high;
  int u_begin, u_end, v_begin, v_end;
  double window;  // half width in azimuth, radians
};

double azimuth_size(const PixelRay& ray) {
  return std::sqrt(ray.solid_angle / (1.0F - ray.z * ray.z));
}

std::optional<Region> find_region(const PolarMap& map, const std::vector<Hit>& hits,
                                  const std::vector<std::uint8_t>& selected, ObjectClass object, const Edge& edge,
                                  int bins, const RefineOptions& options, std::vector<float>& values) {
  const double bins_per_degree = map.bins / 360.0;
  const int from = std::min(static_cast<int>(bins_per_degree), bins / 3);
  const int to = std::max(from + 1, std::min(static_cast<int>(3.0 * bins_per_degree), bins / 2));
  values.clear();
  double size = 0.0;
  for_goal(map, hits, selected, object, [&](const Hit&, std::size_t index) {
    const int inwards = bins_inwards(map, edge, map.bin[index]);
    if (inwards < from || inwards >= to) return;
    values.push_back(map.ray[index].z);
    size = azimuth_size(map.ray[index]);
  });
  constexpr std::size_t kFewest = 4;
  if (values.size() < kFewest) return std::nullopt;
  const auto tenth = static_cast<std::ptrdiff_t>(values.size() / 10);
  std::nth_element(values.begin(), values.begin() + tenth, values.end());
  const float bottom = values[tenth];
  std::nth_element(values.begin(), values.end() - 1 - tenth, values.end());
  const float top = *(values.end() - 1 - tenth);
  const float margin = static_cast<float>(0.5 * (1.0 - options.edge_band)) * (top - bottom);

  Region region{bottom + margin,
                top - margin,
                map.width,
                0,
                map.height,
                0,
                std::max(radians(options.edge_window_deg), 4.0 * size)};
  const int window_bins = static_cast<int>(region.window / (2.0 * kPi) * map.bins) + 1;
  for_goal(map, hits, selected, object, [&](const Hit& hit, std::size_t index) {
    const float z = map.ray[index].z;
    if (z < bottom || z > top || bins_inwards(map, edge, map.bin[index]) > window_bins) return;
    region.u_begin = std::min<int>(region.u_begin, hit.u);
    region.u_end = std::max<int>(region.u_end, hit.u + 1);
    region.v_begin = std::min<int>(region.v_begin, hit.v);
    region.v_end = std::max<int>(region.v_end, hit.v + 1);
  });
  if (region.u_begin >= region.u_end) return std::nullopt;
  const int border = static_cast<int>(region.window / size) + 2;
  region.u_begin = std::max(0, region.u_begin - border);
  region.u_end = std::min(map.width, region.u_end + border);
  region.v_begin = std::max(0, region.v_begin - border);
  region.v_end = std::min(map.height, region.v_end + border);
  return region;
}

// The pixels of the window; their membership is still the bare saturation.
void collect_samples(const ImageView& image, const PolarMap& map, const Goal& goal, const Edge& edge,
                     const Region& region, std::vector<Sample>& samples) {
  const float cos_edge = static_cast<float>(std::cos(edge.azimuth));
  const float sin_edge = static_cast<float>(std::sin(edge.azimuth));
  const auto inwards = static_cast<float>(edge.inwards);
  const auto window = static_cast<float>(std::tan(std::min(region.window, 1.0)));
  samples.clear();
  for (int v = region.v_begin; v < region.v_end; ++v) {
    for (int u = region.u_begin; u < region.u_end; ++u) {
      const PixelRay& ray = map.ray[map.index(u, v)];
      if (ray.solid_angle <= 0.0F || ray.z < region.z_low || ray.z > region.z_high) continue;
      const float along = ray.x * cos_edge + ray.y * sin_edge;
      const float across = inwards * (ray.y * cos_edge - ray.x * sin_edge);
      if (along <= 0.0F || std::abs(across) > window * along) continue;
      if (samples.size() == samples.capacity()) return;
      samples.push_back({std::atan(across / along), static_cast<float>(azimuth_size(ray)),
                         dot(chromaticity(light_at(image, u, v), goal.dark), goal.hue)});
    }
  }
}

// Saturation to membership by its means at the window's two ends. False where the two do not differ.
bool normalize(std::vector<Sample>& samples, double window) {
  double inside = 0.0, outside = 0.0;
  int inner = 0, outer = 0;
  for (const Sample& sample : samples) {
    if (sample.offset > 0.5 * window) {
      inside += sample.membership;
      ++inner;
    } else if (sample.offset < -0.5 * window) {
      outside += sample.membership;
      ++outer;
    }
  }
  constexpr int kFewest = 3;
  if (inner < kFewest || outer < kFewest) return false;
  inside /= inner;
  outside /= outer;
  constexpr double kLeastContrast = 0.1;
  if (inside - outside < kLeastContrast) return false;
  for (Sample& sample : samples) {
    sample.membership = std::clamp(static_cast<float>((sample.membership - outside) / (inside - outside)), 0.0F, 1.0F);
  }
  return true;
}

struct Crossing {
  double offset;    // from the coarse edge, inwards
  double variance;  // rad²
};

// The step position at which Σ w = Σ S: Newton's method within a bracket, as Σ S falls with the position in straight
// pieces. Nothing where it lies beyond the window.
std::optional<Crossing> solve_step(const std::vector<Sample>& samples, double window, double pixel_sigma) {
  constexpr int kMaxSteps = 50;
  constexpr double kTolerance = 1e-7;  // radians
  double weight = 0.0;
  for (const Sample& sample : samples) weight += sample.membership;
  double low = -window;
  double high = window;
  double edge = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    double sum = 0.0;
    double slope = 0.0;  // −dΣS/d edge
    for (const Sample& sample : samples) {
      const double x = (sample.offset - edge) / sample.size + 0.5;
      sum += std::clamp(x, 0.0, 1.0);
      if (x > 0.0 && x < 1.0) slope += 1.0 / sample.size;
    }
    (sum > weight ? low : high) = edge;
    double next = slope > 0.0 ? edge + (sum - weight) / slope : high;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const double change = next - edge;
    edge = next;
    if (std::abs(change) > kTolerance) continue;
    if (std::abs(edge) > 0.9 * window) return std::nullopt;
    // Each of the rows that cross the edge places it to pixel_sigma; slope · size is about their number.
    const double size = samples.front().size;
    return Crossing{edge, pixel_sigma * pixel_sigma * size * size / std::max(1.0, slope * size)};
  }
  return std::nullopt;
}

std::optional<Crossing> refine_edge(const ImageView& image, const PolarMap& map, const std::vector<Hit>& hits,
                                    const std::vector<std::uint8_t>& selected, const Goal& goal, const Edge& edge,
                                    int bins, const RefineOptions& options, RefineScratch& scratch) {
  const auto region = find_region(map, hits, selected, goal.object, edge, bins, options, scratch.values);
  if (!region) return std::nullopt;
  collect_samples(image, map, goal, edge, *region, scratch.samples);
  if (!normalize(scratch.samples, region->window)) return std::nullopt;
  return solve_step(scratch.samples, region->window, options.pixel_sigma);
}

Goal describe(const ImageView& image, const PolarMap& map, const std::vector<Hit>& hits,
              const std::vector<std::uint8_t>& selected, ObjectClass object, double dark) {
  Goal goal;
  goal.object = object;
  goal.dark = static_cast<float>(dark);
  for_goal(map, hits, selected, object, [&](const Hit& hit, std::size_t index) {
    goal.hue = goal.hue + chromaticity(light_at(image, hit.u, hit.v), goal.dark);
    goal.mean_z += map.ray[index].z;
    goal.pixels += 1.0;
  });
  if (goal.pixels > 0.0) goal.mean_z /= goal.pixels;
  if (const float length = saturation(goal.hue); length > 0.0F) goal.hue = goal.hue * (1.0F / length);
  return goal;
}

}  // namespace

bool refine_goal(const ImageView& image, const PolarMap& map, const std::vector<Hit>& hits,
                 const std::vector<std::uint8_t>& selected, int first_bin, int bins, const RefineOptions& options,
                 RefineScratch& scratch, Bearing& bearing) {
  const Goal goal = describe(image, map, hits, selected, bearing.object, options.dark);
  const Edge right = make_edge(map, first_bin, +1);
  const Edge left = make_edge(map, (first_bin + bins - 1) % map.bins, -1);
  if (!(goal.pixels > 0.0)) return false;
  // An edge that something hides is known to a bin only.
  const double bin = 2.0 * kPi / map.bins;
  const Crossing coarse{0.0, bin * bin};
  const auto crossing_at = [&](const Edge& edge) {
    const auto crossing = refine_edge(image, map, hits, selected, goal, edge, bins, options, scratch);
    if (!crossing) bearing.flags |= kCutByObject;
    return crossing.value_or(coarse);
  };
  const Crossing at_right = crossing_at(right);
  const Crossing at_left = crossing_at(left);

  const double floor = radians(options.azimuth_floor_deg);
  bearing.right = wrap_angle(right.azimuth + at_right.offset);
  bearing.left = wrap_angle(left.azimuth - at_left.offset);
  bearing.right_variance = at_right.variance + floor * floor;
  bearing.left_variance = at_left.variance + floor * floor;
  bearing.azimuth = wrap_angle(bearing.right + 0.5 * turn(bearing.right, bearing.left));
  bearing.elevation = std::asin(goal.mean_z);
  bearing.weight = goal.pixels;
  const double elevation_sigma = radians(options.elevation_floor_deg) + std::sqrt(bearing.left_variance);
  bearing.covariance =
      Eigen::Vector2d(0.25 * (bearing.left_variance + bearing.right_variance), elevation_sigma * elevation_sigma)
          .asDiagonal();
  return true;
}

}  // namespace movis::scan
