#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "membership.h"
#include "movis/core/angle.h"
#include "movis/scan/refine.h"

namespace movis::scan {
namespace {

using Span = RefineScratch::Span;

struct Rows {
  int begin = 0, end = 0;
};

// The columns from the first to the last hit in every row.
Rows collect_spans(const PolarMap& map, const std::vector<Hit>& hits, const std::vector<std::uint8_t>& selected,
                   std::vector<Span>& spans) {
  Rows rows{static_cast<int>(spans.size()), 0};
  for (const Hit& hit : hits) {
    if (hit.object != ObjectClass::ball || selected[map.bin[map.index(hit.u, hit.v)]] == 0) continue;
    if (hit.v >= rows.end) {  // hits come in memory order: a new row
      if (rows.end == 0) rows.begin = hit.v;
      for (int v = std::max(rows.end, rows.begin); v <= hit.v; ++v) spans[v] = {};
      spans[hit.v] = {hit.u, hit.u + 1};
      rows.end = hit.v + 1;
    } else {
      spans[hit.v].end = hit.u + 1;
    }
  }
  return rows;
}

// The union of the spans within `border` rows, widened by as many columns.
Span widened(const std::vector<Span>& spans, Rows rows, int v, int border, int width) {
  Span wide{width, 0};
  for (int near = std::max(rows.begin, v - border); near < std::min(rows.end, v + border + 1); ++near) {
    if (spans[near].begin >= spans[near].end) continue;
    wide.begin = std::min(wide.begin, spans[near].begin);
    wide.end = std::max(wide.end, spans[near].end);
  }
  if (wide.begin >= wide.end) return {};
  return {std::max(0, wide.begin - border), std::min(width, wide.end + border)};
}

// The hue of the hits in linear light, and their saturation: the 80 % quantile, as border pixels are mixed.
Membership object_colour(const ImageView& image, const PolarMap& map, const std::vector<Hit>& hits,
                         const std::vector<std::uint8_t>& selected, double dark, std::vector<float>& values) {
  const auto of_object = [&](const Hit& hit) {
    return hit.object == ObjectClass::ball && selected[map.bin[map.index(hit.u, hit.v)]] != 0;
  };
  float sum_alpha = 0.0F;
  float sum_beta = 0.0F;
  for (const Hit& hit : hits) {
    if (!of_object(hit)) continue;
    const Light light = light_at(image, hit.u, hit.v);
    sum_alpha += alpha(light);
    sum_beta += beta(light);
  }
  Membership membership;
  const float length = std::hypot(sum_alpha, sum_beta);
  membership.saturation = {sum_alpha / length, sum_beta / length, static_cast<float>(dark)};
  values.clear();
  for (const Hit& hit : hits) {
    if (of_object(hit)) values.push_back(membership.saturation(light_at(image, hit.u, hit.v)));
  }
  const auto quantile = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 4 / 5);
  std::nth_element(values.begin(), quantile, values.end());
  membership.inside = *quantile;
  return membership;
}

}  // namespace

RefineScratch::RefineScratch(int image_width, int image_height) : spans(image_height) {
  constexpr std::size_t kSamples = 1 << 13;
  values.reserve(static_cast<std::size_t>(image_width) * image_height);
  samples.reserve(kSamples);
}

bool refine_ball(const ImageView& image, const PolarMap& map, const std::vector<Hit>& hits,
                 const std::vector<std::uint8_t>& selected, const RefineOptions& options, RefineScratch& scratch,
                 Bearing& bearing) {
  const Rows rows = collect_spans(map, hits, selected, scratch.spans);
  if (rows.begin >= rows.end) return false;
  const int border = options.border_px;
  Membership membership = object_colour(image, map, hits, selected, options.dark, scratch.values);

  // The surroundings: the ends of every row's span.
  scratch.values.clear();
  for (int v = std::max(0, rows.begin - border); v < std::min(map.height, rows.end + border); ++v) {
    const Span span = widened(scratch.spans, rows, v, border, map.width);
    if (span.begin >= span.end) continue;
    for (const int u : {span.begin, span.end - 1}) {
      if (map.contains(u, v)) scratch.values.push_back(membership.saturation(light_at(image, u, v)));
    }
  }
  if (scratch.values.empty()) return false;
  const auto median = scratch.values.begin() + static_cast<std::ptrdiff_t>(scratch.values.size() / 2);
  std::nth_element(scratch.values.begin(), median, scratch.values.end());
  membership.outside = std::min(*median, 0.5F * membership.inside);

  // Σ w Ω r, and how much of the border is dark.
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double covered = 0.0;  // Σ w Ω
  double weight = 0.0;   // Σ w
  int surround = 0;
  int dark = 0;
  int beyond = 0;  // outside the scanned domain
  constexpr float kDark = 0.035F;  // linear light
  for (int v = std::max(0, rows.begin - border); v < std::min(map.height, rows.end + border); ++v) {
    const Span span = widened(scratch.spans, rows, v, border, map.width);
    for (int u = span.begin; u < span.end; ++u) {
      if (!map.contains(u, v)) {
        ++beyond;
        continue;
      }
      const Light light = light_at(image, u, v);
      const double w = membership(light);
      const PixelRay& ray = map.ray[map.index(u, v)];
      const double area = w * ray.solid_angle;
      sum += area * Eigen::Vector3d(ray.x, ray.y, ray.z);
      covered += area;
      weight += w;
      if (w < 0.1) {
        ++surround;
        if (brightness(light) < kDark) ++dark;
      }
    }
  }
  if (!(weight > 0.0) || !(sum.norm() > 0.0)) return false;
  const Eigen::Vector3d direction = sum.normalized();
  bearing.azimuth = std::atan2(direction.y(), direction.x());
  bearing.elevation = std::asin(direction.z());
  bearing.weight = weight;

  // A disc of angular radius γ covers 2π (1 − cos γ); its tangents differ from its centre by asin(sin γ / cos e).
  const double cos_radius = std::max(-1.0, 1.0 - covered / (2.0 * kPi));
  const double radius = std::acos(cos_radius);
  const double cos_elevation = std::sqrt(1.0 - direction.z() * direction.z());
  const double half_width = std::asin(std::min(1.0, std::sin(std::min(radius, kPi / 2.0)) / cos_elevation));
  bearing.left = wrap_angle(bearing.azimuth + half_width);
  bearing.right = wrap_angle(bearing.azimuth - half_width);

  // Each border pixel places the outline to pixel_sigma; there are about 2π γ / pixel of them.
  const double pixel = std::sqrt(covered / weight);
  const double border_pixels = std::max(4.0, 2.0 * kPi * radius / pixel);
  const double variance = options.pixel_sigma * options.pixel_sigma * pixel * pixel / border_pixels;
  const double azimuth_floor = radians(options.azimuth_floor_deg);
  const double elevation_floor = radians(options.elevation_floor_deg);
  bearing.covariance = Eigen::Vector2d(variance / (cos_elevation * cos_elevation) + azimuth_floor * azimuth_floor,
                                       variance + elevation_floor * elevation_floor)
                           .asDiagonal();
  bearing.left_variance = bearing.right_variance = 4.0 * bearing.covariance(0, 0);
  if (beyond > 0) bearing.flags |= kCutByDomain;
  if (dark > surround / 8) bearing.flags |= kCutByBody;
  return true;
}

}  // namespace movis::scan
