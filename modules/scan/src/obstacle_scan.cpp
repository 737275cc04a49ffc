#include <algorithm>
#include <array>
#include <cmath>

#include "membership.h"
#include "movis/core/angle.h"
#include "movis/scan/floor_scan.h"

namespace movis::scan {
namespace {

constexpr int kStride = 2;    // pixels between those that are looked at
constexpr int kSoftFoot = 8;  // pixels between the last of the carpet and what is dark: shadow, a line

float range_of(const PixelRay& ray, double height) {
  return static_cast<float>(height) * std::hypot(ray.x, ray.y) / -ray.z;
}

// The distance to a round foot in the azimuth δ beside its middle, over that in its middle; `sine` is that of its half
// width: (cos δ − √(sin² α − sin² δ))/(1 − sin α).
double round_foot(double sine, double delta) {
  const double beside = std::sin(delta);
  return (std::cos(delta) - std::sqrt(std::max(0.0, sine * sine - beside * beside))) / (1.0 - sine);
}

// Dark carpet is green: the shadow between a ball and the own robot.
bool is_dark(int r, int g, int b, int dark) {
  constexpr int kNoise = 4;  // bytes
  return std::max({r, g, b}) < dark && 4 * (g - std::max(r, b) - kNoise) <= g;
}

}  // namespace

void FloorScan::find_feet(const ImageView& image, const PolarMap& map, const Carpet& carpet) {
  const int bytes = channels(image.format);
  const int red = image.format == PixelFormat::bgr8 ? 2 : 0;
  const int dark = static_cast<int>(options_.obstacle_dark * static_cast<double>(carpet.g));
  const auto look = [&](int ray) {
    if (feet_[ray].unknown) return;
    feet_[ray].hidden = true;  // until carpet is seen
    int last_carpet = -1;
    int dark_from = -1;
    for (int i = ray_begin_[ray]; i < ray_begin_[ray + 1]; i += kStride) {
      const std::uint8_t* at = image.row(rays_[i].v) + rays_[i].u * bytes;
      if (is_dark(at[red], at[1], at[2 - red], dark)) {
        if (dark_from < 0) dark_from = i;
        if (i - dark_from + kStride < options_.obstacle_pixels) continue;
        if (last_carpet >= 0 && dark_from - last_carpet <= kSoftFoot) {
          feet_[ray] = foot_at(image, map, ray, dark_from);
          return;
        }
        continue;  // the own body, or something beyond the carpet
      }
      dark_from = -1;
      if (belongs(field_, at[red], at[1], at[2 - red])) {
        last_carpet = i;
        feet_[ray].hidden = false;
      }
    }
  };
  // Every other azimuth, and between them where there is something: an obstacle covers more than two of them.
  const auto rays = static_cast<int>(feet_.size());
  for (Foot& foot : feet_) foot = {0.0F, 0.0F, foot.unknown, foot.unknown};
  for (int ray = 0; ray < rays; ray += 2) look(ray);
  for (int ray = 1; ray < rays; ray += 2) {
    const Foot& before = feet_[ray - 1];
    const Foot& after = feet_[(ray + 1) % rays];
    if (before.range > 0.0F || after.range > 0.0F || before.hidden || after.hidden) look(ray);
  }
}

// Where the carpet's light has fallen half way to that of what is dark, around a pixel of a ray.
FloorScan::Foot FloorScan::foot_at(const ImageView& image, const PolarMap& map, int ray, int dark_from) const {
  constexpr int kAround = 5;
  const auto& linear = linear_light();
  const int bytes = channels(image.format);
  const auto green = [&](int i) { return linear[image.row(rays_[i].v)[rays_[i].u * bytes + 1]]; };
  const int first = std::max(ray_begin_[ray], dark_from - kAround);
  const int last = std::min(ray_begin_[ray + 1] - 1, dark_from + kAround);
  const float half = 0.5F * (green(first) + green(last));
  int i = first;
  while (i + 1 < last && green(i + 1) > half) ++i;
  const float fall = green(i) - green(i + 1);
  const float part = fall > 0.0F ? std::clamp((green(i) - half) / fall, 0.0F, 1.0F) : 0.5F;
  const auto range = [&](int at) { return range_of(map.ray[map.index(rays_[at].u, rays_[at].v)], height_); };
  const PixelRay& beyond = map.ray[map.index(rays_[i + 1].u, rays_[i + 1].v)];
  if (!(beyond.z < 0.0F)) return {};
  Foot foot;
  foot.range = range(i) + part * (range(i + 1) - range(i));
  foot.sigma = static_cast<float>(options_.foot_sigma_px) * std::abs(range(i + 1) - range(i));
  if (foot.range > static_cast<float>(options_.max_range)) foot.range = 0.0F;
  return foot;
}

void FloorScan::join_feet(std::vector<ObstacleSight>& obstacles) const {
  constexpr int kMissing = 1;                        // azimuths without a foot within an obstacle
  const std::size_t first_sight = obstacles.size();  // of this camera
  const auto rays = static_cast<int>(feet_.size());
  const auto wrapped = [&](int i) { return i < rays ? i : i - rays; };
  const auto empty = [&](int i) { return !feet_[i].hidden && feet_[i].range <= 0.0F; };
  int start = 0;  // behind a gap, so that no obstacle crosses the start
  while (start < rays && !(empty(start) && empty(wrapped(start + 1)))) ++start;
  int first = -1;
  int last = -1;
  const auto end = [&] {
    if (first >= 0) add_obstacle(first, last, first_sight, obstacles);
    first = -1;
  };
  for (int i = start; i < start + rays; ++i) {
    const Foot& foot = feet_[i % rays];
    if (foot.hidden) continue;
    if (foot.range <= 0.0F) {
      int known = 0;  // since the last foot
      for (int k = last + 1; first >= 0 && k <= i; ++k) known += feet_[k % rays].hidden ? 0 : 1;
      if (known > kMissing) end();
      continue;
    }
    if (first >= 0) {
      const float before = feet_[last % rays].range;
      if (std::abs(foot.range - before) > std::max(0.1F, 0.25F * before)) end();
    }
    if (first < 0) first = i;
    last = i;
  }
  end();
}

// Of the azimuths from `first` to `last`, which may go beyond the full turn.
void FloorScan::add_obstacle(int first, int last, std::size_t first_sight,
                             std::vector<ObstacleSight>& obstacles) const {
  constexpr double kWidest = radians(60.0);  // half: beyond, the robot would stand in it
  const auto rays = static_cast<int>(feet_.size());
  const double step = 2.0 * kPi / rays;
  const double half_width = 0.5 * (last - first + 1) * step;
  if (2.0 * half_width < radians(options_.obstacle_width_deg)) return;
  if (obstacles.size() >= first_sight + kMostSights) return;
  const double sine = std::sin(std::min(half_width, kWidest));
  // Towards its sides a foot's distance tells little about that in its middle.
  constexpr double kInner = 0.7;  // of the half width
  std::array<float, kRays> nearest{};
  int count = 0;
  double sigma = 0.0;
  for (int i = first; i <= last; ++i) {
    const Foot& foot = feet_[i % rays];
    const double delta = (i - 0.5 * (first + last)) * step;
    if (foot.range <= 0.0F || std::abs(delta) > kInner * half_width) continue;
    nearest[count++] = foot.range / static_cast<float>(round_foot(sine, delta));
    sigma += static_cast<double>(foot.sigma);
  }
  if (count == 0) return;
  std::nth_element(nearest.begin(), nearest.begin() + count / 2, nearest.begin() + count);
  ObstacleSight sight;
  sight.camera = camera_index_;
  const double middle = azimuth_of(0) + 0.5 * (first + last) * step;
  sight.left = wrap_angle(middle + half_width);
  sight.right = wrap_angle(middle - half_width);
  sight.distance = static_cast<double>(nearest[count / 2]);
  sight.sigma = sigma / count;
  obstacles.push_back(sight);
}

}  // namespace movis::scan
