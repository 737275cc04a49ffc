#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "ball_outline.h"
#include "membership.h"
#include "movis/core/angle.h"
#include "movis/scan/refine.h"
#include "silhouette.h"
#include "spans.h"

namespace movis::scan {
namespace {

using Eigen::Vector3d;
using Span = RefineScratch::Span;

// A disc in the image that holds the ball and leaves out scattered pixels of its colour in the same azimuths.
struct Disc {
  float u = 0.0F, v = 0.0F;
  float radius2 = 0.0F;  // squared, pixels

  bool holds(const ObjectPixel& pixel) const {
    const float du = pixel.u - u;
    const float dv = pixel.v - v;
    return du * du + dv * dv <= radius2;
  }
};

template <typename Coordinate>
float median(const std::vector<ObjectPixel>& object, std::size_t step, Coordinate coordinate,
             std::vector<float>& values) {
  values.clear();
  for (std::size_t i = 0; i < object.size(); i += step) values.push_back(coordinate(object[i]));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Around the median pixel, twice as large as a disc of as many pixels: half a ball fits in, wherever it is cut. Nothing
// where less than half of the pixels lie within: they are scattered, and no ball.
std::optional<Disc> find_disc(const std::vector<ObjectPixel>& object, std::vector<float>& values) {
  constexpr std::size_t kEnough = 500;  // pixels, for the median
  constexpr float kTimes = 2.0F;
  constexpr float kMore = 3.0F;  // pixels
  const std::size_t step = object.size() / kEnough + 1;
  Disc disc;
  disc.u = median(
      object, step, [](const ObjectPixel& pixel) { return static_cast<float>(pixel.u); }, values);
  disc.v = median(
      object, step, [](const ObjectPixel& pixel) { return static_cast<float>(pixel.v); }, values);
  const float radius = kTimes * std::sqrt(static_cast<float>(object.size()) / static_cast<float>(kPi)) + kMore;
  disc.radius2 = radius * radius;
  const auto held = std::count_if(object.begin(), object.end(), [&](const ObjectPixel& p) { return disc.holds(p); });
  if (2 * static_cast<std::size_t>(held) < object.size()) return std::nullopt;
  return disc;
}

// The ball's own chromaticity: that of its most saturated fifth, as pixels on its border are mixed. A thousand pixels
// are enough to know it.
Chromaticity ball_chromaticity(const ImageView& image, const std::vector<ObjectPixel>& object, float dark,
                               std::vector<float>& values) {
  constexpr std::size_t kEnough = 1000;
  const std::size_t step = object.size() / kEnough + 1;
  values.clear();
  for (std::size_t i = 0; i < object.size(); i += step) {
    values.push_back(saturation(chromaticity(light_at(image, object[i].u, object[i].v), dark)));
  }
  const auto quantile = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 4 / 5);
  std::nth_element(values.begin(), quantile, values.end());
  const float least = *quantile;
  Chromaticity sum;
  float count = 0.0F;
  for (std::size_t i = 0; i < object.size(); i += step) {
    const Chromaticity c = chromaticity(light_at(image, object[i].u, object[i].v), dark);
    if (saturation(c) < least) continue;
    sum = sum + c;
    count += 1.0F;
  }
  return sum * (1.0F / count);
}

// The chromaticity beside the ball: at one end of the rows around v.
Chromaticity surroundings(const ImageView& image, const std::vector<Span>& spans, Rows rows, int v, bool left,
                          float dark) {
  constexpr int kRowsAround = 1;
  Chromaticity sum;
  float count = 0.0F;
  for (int near = std::max(rows.begin, v - kRowsAround); near < std::min(rows.end, v + kRowsAround + 1); ++near) {
    if (spans[near].begin >= spans[near].end) continue;
    sum = sum + chromaticity(light_at(image, left ? spans[near].begin : spans[near].end - 1, near), dark);
    count += 1.0F;
  }
  return sum * (1.0F / count);
}

// Memberships of the pixels in the spans, row by row behind each other.
void fill_memberships(const ImageView& image, std::vector<Span>& spans, Rows rows, const Chromaticity& inside,
                      float dark, std::vector<float>& memberships) {
  // Grey, white, black and green surroundings do not lie towards the ball's colour and are all taken for grey, so that
  // where floor and wall meet behind the ball its left and right stay alike. Only a goal's colour is taken out.
  constexpr float kTowardsBall = 0.2F;
  constexpr float kLeastContrast = 0.15F;
  const auto grey_unless_similar = [&](const Chromaticity& c) {
    const bool similar = dot(c, inside) > kTowardsBall * dot(inside, inside);
    return similar && saturation(inside - c) > kLeastContrast ? c : Chromaticity{};
  };
  memberships.clear();
  for (int v = rows.begin; v < rows.end; ++v) {
    Span& span = spans[v];
    if (span.begin >= span.end) continue;
    span.first = memberships.size();
    const Chromaticity outside[2] = {grey_unless_similar(surroundings(image, spans, rows, v, true, dark)),
                                     grey_unless_similar(surroundings(image, spans, rows, v, false, dark))};
    const int middle = (span.begin + span.end) / 2;
    for (int u = span.begin; u < span.end; ++u) {
      memberships.push_back(membership(chromaticity(light_at(image, u, v), dark), outside[u < middle ? 0 : 1], inside));
    }
  }
}

struct Moments {
  Vector3d sum = Vector3d::Zero();  // Σ w Ω r
  double covered = 0.0;             // Σ w Ω
  double weight = 0.0;              // Σ w
  int around = 0;                   // pixels that are not the ball's
  int dark = 0;                     // of them, those that show something black
  bool beyond = false;              // the region reaches out of the scanned domain
};

Moments collect_moments(const ImageView& image, const PolarMap& map, const RefineScratch& scratch, Rows rows) {
  constexpr double kNotTheBall = 0.1;
  Moments moments;
  const float* membership_read = scratch.memberships.data();
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = scratch.widened[v].begin; u < scratch.widened[v].end; ++u) {
      const double w = *membership_read++;
      const PixelRay& ray = map.ray[map.index(u, v)];
      if (ray.solid_angle <= 0.0F) {
        moments.beyond = true;
        continue;
      }
      moments.sum += w * ray.solid_angle * Vector3d(ray.x, ray.y, ray.z);
      moments.covered += w * ray.solid_angle;
      moments.weight += w;
      if (w < kNotTheBall) {
        ++moments.around;
        if (brightness(light_at(image, u, v)) < kBlack) ++moments.dark;
      }
    }
  }
  return moments;
}

// The cone that the moments of the whole disc tell.
BallCone cone_of(const Moments& moments, const RefineOptions& options) {
  const Vector3d direction = moments.sum.normalized();
  BallCone cone;
  cone.azimuth = std::atan2(direction.y(), direction.x());
  cone.elevation = std::asin(direction.z());
  // A disc of angular radius γ covers 2π (1 − cos γ).
  cone.radius = std::acos(std::max(-1.0, 1.0 - moments.covered / (2.0 * kPi)));
  // Each border pixel places the outline to pixel_sigma; there are about 2π γ / pixel of them.
  const double pixel = std::sqrt(moments.covered / moments.weight);
  const double border_pixels = std::max(4.0, 2.0 * kPi * cone.radius / pixel);
  const double variance = options.pixel_sigma * options.pixel_sigma * pixel * pixel / border_pixels;
  const double horizontal2 = std::max(1e-6, 1.0 - direction.z() * direction.z());
  cone.covariance.diagonal() << variance / horizontal2, variance, variance;
  return cone;
}

// The cone that the visible part of the outline tells, where the moments are those of a part of the disc.
void take_axis(const Cone& fitted, BallCone& cone) {
  const double horizontal = fitted.axis.head<2>().norm();
  cone.azimuth = std::atan2(fitted.axis.y(), fitted.axis.x());
  cone.elevation = std::atan2(fitted.axis.z(), horizontal);
  cone.radius = fitted.radius;
  Eigen::Matrix<double, 2, 3> angles_by_axis;
  angles_by_axis << -fitted.axis.y() / (horizontal * horizontal), fitted.axis.x() / (horizontal * horizontal), 0.0,
      -fitted.axis.z() * fitted.axis.x() / horizontal, -fitted.axis.z() * fitted.axis.y() / horizontal, horizontal;
  cone.covariance.topLeftCorner<2, 2>() += angles_by_axis * fitted.axis_covariance * angles_by_axis.transpose();
}

// What lies within reach of the spans.
Box box_around(const std::vector<Span>& spans, Rows rows, int reach, const PolarMap& map) {
  Box box{map.width, 0, std::max(0, rows.begin - reach), std::min(map.height, rows.end + reach)};
  for (int v = rows.begin; v < rows.end; ++v) {
    if (spans[v].begin >= spans[v].end) continue;
    box.u_begin = std::min(box.u_begin, std::max(0, spans[v].begin - reach));
    box.u_end = std::max(box.u_end, std::min(map.width, spans[v].end + reach));
  }
  return box;
}

void take_cone(const BallCone& cone, const RefineOptions& options, Bearing& bearing) {
  bearing.azimuth = wrap_angle(cone.azimuth);
  bearing.elevation = cone.elevation;
  const Eigen::Vector3d floors = Eigen::Vector3d(
      radians(options.azimuth_floor_deg), radians(options.elevation_floor_deg), radians(options.radius_floor_deg));
  const Eigen::Matrix3d covariance = cone.covariance + Eigen::Matrix3d(floors.cwiseAbs2().asDiagonal());
  bearing.covariance = covariance.topLeftCorner<2, 2>();

  // A cone's tangents in azimuth differ from its axis by asin(sin γ / cos e).
  const double cosine = std::cos(cone.elevation);
  const double half_width = std::asin(std::min(1.0, std::sin(std::min(cone.radius, kPi / 2.0)) / cosine));
  bearing.left = wrap_angle(cone.azimuth + half_width);
  bearing.right = wrap_angle(cone.azimuth - half_width);
  bearing.left_variance = bearing.right_variance = covariance(0, 0) + covariance(2, 2) / (cosine * cosine);
}

}  // namespace

RefineScratch::RefineScratch(int image_width, int image_height) : spans(image_height), widened(image_height) {
  constexpr std::size_t kSamples = 1 << 13;
  const auto pixels = static_cast<std::size_t>(image_width) * image_height;
  values.reserve(pixels);
  memberships.reserve(pixels);
  samples.reserve(kSamples);
  outline.reserve(kSamples);
  border.reserve(static_cast<std::size_t>(24) * (image_width + image_height));  // a band as wide around the picture
}

bool refine_ball(const ImageView& image, const PolarMap& map, const std::vector<ObjectPixel>& object,
                 const RefineOptions& options, RefineScratch& scratch, Bearing& bearing) {
  if (object.empty()) return false;
  const auto dark = static_cast<float>(options.dark);
  const Chromaticity inside = ball_chromaticity(image, object, dark, scratch.values);
  const auto disc = find_disc(object, scratch.values);
  if (!disc) return false;
  const auto in_disc = [&](const ObjectPixel& pixel) { return disc->holds(pixel); };
  const Rows own = collect_spans(object, in_disc, scratch.spans);
  const Rows rows = widen(scratch.spans, own, options.border_px, map.width, map.height, scratch.widened);
  fill_memberships(image, scratch.widened, rows, inside, dark, scratch.memberships);
  const Moments moments = collect_moments(image, map, scratch, rows);
  if (!(moments.weight > 0.0) || !(moments.sum.norm() > 0.0)) return false;

  BallCone cone = cone_of(moments, options);
  bearing.weight = moments.weight;
  if (moments.beyond) bearing.flags |= kCutByDomain;
  constexpr int kTouchesBlack = 8;     // of the pixels around it, one in
  constexpr double kLargeDisc = 1200;  // pixels: highlights shift its moments more than noise its outline
  const bool cut = moments.dark > moments.around / kTouchesBlack;
  if (cut) bearing.flags |= kCutByBody;
  if (cut || moments.beyond || moments.weight > kLargeDisc) {
    collect_outline(image, map, rows, scratch);
    const double pixel = std::sqrt(moments.covered / moments.weight);
    if (const auto fitted = fit_cone(scratch.outline, pixel, scratch.values)) take_axis(*fitted, cone);
  }
  constexpr int kReach = 4;  // pixels beyond the mixed ones: the surroundings
  const Box box = box_around(scratch.widened, rows, kReach, map);
  const std::optional<BallCone> silhouette = fit_silhouette(image, map, box, cone, scratch);
  take_cone(silhouette ? *silhouette : cone, options, bearing);
  if (silhouette) {
    bearing.radius = silhouette->radius;
    bearing.radius_variance = silhouette->covariance(2, 2) + std::pow(radians(options.radius_floor_deg), 2);
    bearing.radius_covariance = silhouette->covariance.topRightCorner<2, 1>();
  }
  return true;
}

}  // namespace movis::scan
