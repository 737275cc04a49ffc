#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "line_crossing.h"

namespace movis::scan {
namespace {

// The direction across the line in the image, from the structure tensor of 3 × 3 gradients around a pixel.
Eigen::Vector2f across(const ImageView& image, int u, int v) {
  const auto& linear = linear_light();
  const int bytes = channels(image.format);
  std::array<std::array<float, 5>, 5> s{};
  for (int y = 0; y < 5; ++y) {
    const std::uint8_t* pixel = image.row(v + y - 2) + (u - 2) * bytes;
    for (int x = 0; x < 5; ++x, pixel += bytes) s[y][x] = linear[pixel[0]] + linear[pixel[2]];
  }
  float uu = 0.0F;
  float uv = 0.0F;
  float vv = 0.0F;
  for (int y = 1; y < 4; ++y) {
    for (int x = 1; x < 4; ++x) {
      const float du = s[y][x + 1] - s[y][x - 1];
      const float dv = s[y + 1][x] - s[y - 1][x];
      uu += du * du;
      uv += du * dv;
      vv += dv * dv;
    }
  }
  const float angle = 0.5F * std::atan2(2.0F * uv, uu - vv);
  return {std::cos(angle), std::sin(angle)};
}

// Is there white on both sides along the line too? A line so thin that the pixels' sampling breaks it up is none.
bool goes_on(const ImageView& image, const PolarMap& map, int u, int v, const Eigen::Vector2f& normal, bool column,
             float level) {
  constexpr float kAlong = 2.5F;  // pixels
  const auto& linear = linear_light();
  const int bytes = channels(image.format);
  for (const float along : {-kAlong, kAlong}) {
    const int at_u = u - static_cast<int>(std::lround(along * normal.y()));
    const int at_v = v + static_cast<int>(std::lround(along * normal.x()));
    if (!map.contains(at_u - 1, at_v - 1) || !map.contains(at_u + 1, at_v + 1)) return false;
    float most = 0.0F;
    for (int i = -1; i <= 1; ++i) {  // the line may bend, or its direction be rough
      const std::uint8_t* pixel = image.row(column ? at_v + i : at_v) + (column ? at_u : at_u + i) * bytes;
      most = std::max(most, linear[pixel[0]] + linear[pixel[2]]);
    }
    if (most < level) return false;
  }
  return true;
}

// The floor under a place between two pixels' middles, from under the camera; metres.
struct FloorMap {
  const PolarMap& map;
  float height;

  Eigen::Vector2f at(int u, int v) const {
    const PixelRay& ray = map.ray[map.index(u, v)];
    return Eigen::Vector2f(ray.x, ray.y) * (-height / ray.z);
  }
  Eigen::Vector2f along(int u, int v, bool column, float place) const {
    const float whole = std::floor(place);
    const float part = place - whole;
    const int i = static_cast<int>(whole);
    const PixelRay& a = map.ray[column ? map.index(u, v + i) : map.index(u + i, v)];
    const PixelRay& b = map.ray[column ? map.index(u, v + i + 1) : map.index(u + i + 1, v)];
    const float x = a.x + part * (b.x - a.x);
    const float y = a.y + part * (b.y - a.y);
    const float z = a.z + part * (b.z - a.z);
    return Eigen::Vector2f(x, y) * (-height / z);
  }
};

}  // namespace

void FloorScan::cross(const ImageView& image, const PolarMap& map, const Carpet& carpet, int u, int v, int length,
                      bool column) {
  constexpr float kSteep = 0.6F;   // cosine of the angle between the scan and the line's normal
  constexpr float kNarrow = 0.5F;  // of the line's width: less is none
  constexpr float kWide = 3.0F;    // more is none: one that is crossed obliquely is longer
  constexpr float kSlack = 1.0F;   // pixels that blur and sampling add to a width
  if (length > kLongest) return;
  const int before_u = column ? u : u - kBeside;
  const int before_v = column ? v - kBeside : v;
  const int after_u = column ? u : u + length - 1 + kBeside;
  const int after_v = column ? v + length - 1 + kBeside : v;
  if (!map.contains(before_u, before_v) || !map.contains(after_u, after_v)) return;
  const int bytes = channels(image.format);
  const Track track{image.row(v) + u * bytes, column ? image.stride : bytes, image.format == PixelFormat::bgr8 ? 2 : 0};
  for (const int i : {-3, -2, length + 1, length + 2}) {
    if (!track.is(field_, i)) return;
  }
  const std::optional<LineCrossing> crossing = measure_crossing(track, length, carpet, options_);
  if (!crossing) return;

  const int edge = static_cast<int>(std::lround(crossing->middle - 0.5F * crossing->width));
  const int edge_u = column ? u : u + edge;
  const int edge_v = column ? v + edge : v;
  if (!map.contains(edge_u - 2, edge_v - 2) || !map.contains(edge_u + 2, edge_v + 2)) return;
  const Eigen::Vector2f normal = across(image, edge_u, edge_v);
  const float steepness = std::abs(column ? normal.y() : normal.x());
  if (steepness < kSteep) return;

  const int centre = static_cast<int>(std::lround(crossing->middle));
  const int cu = column ? u : u + centre;
  const int cv = column ? v + centre : v;
  if (!goes_on(image, map, cu, cv, normal, column, crossing->level)) return;

  const FloorMap floor{map, static_cast<float>(height_)};
  const auto chord = [&](float width) {
    const Eigen::Vector2f a = floor.along(u, v, column, crossing->middle - 0.5F * width);
    const Eigen::Vector2f b = floor.along(u, v, column, crossing->middle + 0.5F * width);
    return std::make_pair(a, b);
  };
  const auto line = static_cast<float>(line_width_);
  const auto [a, b] = chord(crossing->width);
  const auto inner = chord(std::max(crossing->width - kSlack, 0.0F));
  if ((b - a).norm() < kNarrow * line || (inner.second - inner.first).norm() > kWide * line) return;
  const Eigen::Vector2f from_camera =
      crossing->resolved ? Eigen::Vector2f(0.5F * (a + b)) : floor.along(u, v, column, crossing->middle);

  if (from_camera.norm() > static_cast<float>(options_.max_range)) return;

  // Along the line's tangent in the image runs its tangent on the floor; what a pixel along the scan moves across it.
  const Eigen::Vector2f by_u = 0.5F * (floor.at(cu + 1, cv) - floor.at(cu - 1, cv));
  const Eigen::Vector2f by_v = 0.5F * (floor.at(cu, cv + 1) - floor.at(cu, cv - 1));
  const Eigen::Vector2f tangent = (-normal.y() * by_u + normal.x() * by_v).normalized();
  const Eigen::Vector2f across_floor(-tangent.y(), tangent.x());

  Candidate candidate;
  candidate.noise_gain = crossing->noise_gain;
  candidate.carpet_noise = crossing->carpet_noise;
  candidate.steepness = steepness;
  candidate.across_per_pixel = std::abs(across_floor.dot(column ? by_v : by_u));
  if (static_cast<float>(options_.least_pixels) * candidate.across_per_pixel > line) return;
  LinePoint& point = candidate.point;
  const Eigen::Vector3d sight(from_camera.x(), from_camera.y(), -height_);
  point.camera = camera_index_;
  point.azimuth = std::atan2(sight.y(), sight.x());
  point.elevation = std::atan2(sight.z(), sight.head<2>().norm());
  point.point = under_camera_ + sight.head<2>();
  // What an angle across the line moves on the floor: the part of the normal across the sight, over the distance.
  const Eigen::Vector3d n(across_floor.x(), across_floor.y(), 0.0);
  point.sigma = n.cross(sight).norm() / sight.squaredNorm();  // radians a metre, until noise is known
  candidates_.push_back(candidate);
}

void FloorScan::scan_lines(const ImageView& image, const PolarMap& map, const Carpet& carpet,
                           std::vector<LinePoint>& lines) {
  constexpr float kWayToWhite = 0.35F;  // of the channels' ratios, from the carpet's to one
  constexpr float kDarker = 0.6F;       // than the mean carpet, where there is shadow
  const auto bound = [&](float channel) {
    const float ratio = std::min(channel / carpet.g, 1.0F);
    return static_cast<std::uint16_t>(256.0F * (ratio + kWayToWhite * (1.0F - ratio)));
  };
  const WhiteBounds bounds{bound(carpet.r), bound(carpet.b), static_cast<std::uint8_t>(kDarker * carpet.g)};
  white_.clear();
  candidates_.clear();
  find_white(image, runs_, bounds, white_);

  const int bytes = channels(image.format);
  const int red = image.format == PixelFormat::bgr8 ? 2 : 0;
  const auto white_at = [&](int u, int v) {
    const std::uint8_t* pixel = image.row(v) + u * bytes;
    return may_be_white(bounds, pixel[red], pixel[1], pixel[2 - red]);
  };
  const int step = options_.line_step;
  for (const Stretch& stretch : white_) {
    const int v = stretch.row;
    if (v % step == 0) cross(image, map, carpet, stretch.begin, v, stretch.end - stretch.begin, false);
    for (int u = (stretch.begin + step - 1) / step * step; u < stretch.end; u += step) {
      if (v == 0 || white_at(u, v - 1)) continue;  // the column's white began above
      int length = 1;
      while (length <= kLongest && v + length < image.height && white_at(u, v + length)) ++length;
      cross(image, map, carpet, u, v, length, true);
    }
  }
  add_evenly(lines);
}

// As many as wanted of the candidates, evenly over the image, with the noise of the image.
void FloorScan::add_evenly(std::vector<LinePoint>& lines) const {
  const auto found = static_cast<int>(candidates_.size());
  if (found == 0) return;
  double variance = 0.0;
  for (const Candidate& candidate : candidates_) variance += static_cast<double>(candidate.carpet_noise);
  variance = variance / found + 1.0 / 12.0;  // of a byte's rounding
  const double floor = options_.position_floor * options_.position_floor;
  const int kept = std::min(found, options_.most_line_points);
  for (int i = 0; i < kept; ++i) {
    const Candidate& candidate = candidates_[static_cast<std::size_t>(i) * found / kept];
    LinePoint point = candidate.point;
    const double steep = static_cast<double>(candidate.steepness);
    const double pixels = std::sqrt(variance * static_cast<double>(candidate.noise_gain) + floor / (steep * steep));
    point.sigma_on_floor = std::hypot(pixels * static_cast<double>(candidate.across_per_pixel), options_.floor_sigma);
    point.sigma *= point.sigma_on_floor;
    lines.push_back(point);
  }
}

}  // namespace movis::scan
