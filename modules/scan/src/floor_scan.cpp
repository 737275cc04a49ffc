#include "movis/scan/floor_scan.h"

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"

namespace movis::scan {
namespace {

constexpr int kSampleStep = 9;  // of the carpet's sample, rows and columns
constexpr int kLeastCarpet = 20;

}  // namespace

FloorOptions read_floor_options(const YamlMap& map) {
  map.allow({"max_range", "line_step", "most_line_points", "white_contrast", "white_balance", "least_pixels",
             "position_floor", "floor_sigma", "obstacle_dark", "obstacle_pixels", "obstacle_width_deg",
             "foot_sigma_px"});
  FloorOptions options;
  map.read_number("max_range", {0.5, 50.0}, options.max_range);
  map.read_integer("line_step", {1.0, 64.0}, options.line_step);
  map.read_integer("most_line_points", {1.0, 10000.0}, options.most_line_points);
  map.read_number("white_contrast", {0.01, 10.0}, options.white_contrast);
  map.read_number("white_balance", {0.0, 1.0}, options.white_balance);
  map.read_number("least_pixels", {0.1, 10.0}, options.least_pixels);
  map.read_number("position_floor", {0.0, 2.0}, options.position_floor);
  map.read_number("floor_sigma", {0.0, 0.1}, options.floor_sigma);
  map.read_number("obstacle_dark", {0.01, 0.95}, options.obstacle_dark);
  map.read_integer("obstacle_pixels", {2.0, 100.0}, options.obstacle_pixels);
  map.read_number("obstacle_width_deg", {1.0, 90.0}, options.obstacle_width_deg);
  map.read_number("foot_sigma_px", {0.01, 10.0}, options.foot_sigma_px);
  return options;
}

FloorScan::FloorScan(const omni::Camera& camera, int camera_index, const PolarMap& map, const Colours& colours,
                     const FloorOptions& options, double line_width, const std::vector<Sector>& sensors)
    : camera_index_(camera_index),
      height_(camera.position.z()),
      under_camera_(camera.position.head<2>()),
      options_(options),
      line_width_(line_width),
      feet_(kRays) {
  for (const ColourClass& colour : colours.classes) {
    if (colour.object != ObjectClass::field) continue;
    has_field_ = true;
    field_ = to_integers(colour);
  }
  const double highest = -height_ / std::hypot(height_, options.max_range);  // z of the ray to the farthest floor
  const auto on_floor = [&](int u, int v) { return map.contains(u, v) && map.ray[map.index(u, v)].z <= highest; };
  for (const Run& run : map.runs) {
    for (int u = run.begin; u < run.end; ++u) {
      if (!on_floor(u, run.row)) continue;
      if (runs_.empty() || runs_.back().row != run.row || runs_.back().end != u) runs_.push_back({run.row, u, u});
      runs_.back().end = u + 1;
      if (u % kSampleStep == 0 && run.row % kSampleStep == 0) samples_.push_back(pixel(u, run.row));
    }
  }
  lay_rays(camera, map, sensors);
  white_.reserve(static_cast<std::size_t>(map.width) * map.height / 2 + 1);
  candidates_.reserve(2 * map.scanned_pixels() / options.line_step);
}

// The pixels that a half plane of one azimuth meets, from below outward, up to the horizon.
void FloorScan::lay_rays(const omni::Camera& camera, const PolarMap& map, const std::vector<Sector>& sensors) {
  constexpr double kStep = radians(0.2);  // of the elevation: finer than a pixel
  const Eigen::Matrix3d camera_from_robot = camera.robot_from_camera().transpose();
  for (int i = 0; i < kRays; ++i) {
    const double azimuth = azimuth_of(i);
    ray_begin_.push_back(static_cast<int>(rays_.size()));
    for (const Sector& sector : sensors) {
      if (std::abs(turn(sector.azimuth, azimuth)) <= sector.half_width) feet_[i].unknown = true;
    }
    if (feet_[i].unknown) continue;
    for (double elevation = -0.5 * kPi; elevation <= 0.0; elevation += kStep) {
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                std::sin(elevation));
      const auto at = project(camera.model, camera_from_robot * ray);
      if (!at || at->x() < 0.0 || at->y() < 0.0) continue;
      const Pixel here = pixel(static_cast<int>(std::lround(at->x())), static_cast<int>(std::lround(at->y())));
      if (!map.contains(here.u, here.v)) continue;
      const bool same =
          static_cast<int>(rays_.size()) > ray_begin_.back() && rays_.back().u == here.u && rays_.back().v == here.v;
      if (!same) rays_.push_back(here);
    }
  }
  ray_begin_.push_back(static_cast<int>(rays_.size()));
}

double FloorScan::azimuth_of(int ray) {
  return -kPi + (ray + 0.5) * 2.0 * kPi / kRays;
}

Carpet FloorScan::sample_carpet(const ImageView& image) const {
  Carpet carpet;
  const int bytes = channels(image.format);
  const int red = image.format == PixelFormat::bgr8 ? 2 : 0;
  int r = 0;
  int g = 0;
  int b = 0;
  for (const Pixel& sample : samples_) {
    const std::uint8_t* at = image.row(sample.v) + sample.u * bytes;
    if (!belongs(field_, at[red], at[1], at[2 - red])) continue;
    r += at[red];
    g += at[1];
    b += at[2 - red];
    ++carpet.samples;
  }
  const float scale = 1.0F / static_cast<float>(std::max(carpet.samples, 1));
  carpet.r = scale * static_cast<float>(r);
  carpet.g = scale * static_cast<float>(g);
  carpet.b = scale * static_cast<float>(b);
  return carpet;
}

void FloorScan::scan(const ImageView& image, const PolarMap& map, std::vector<LinePoint>& lines,
                     std::vector<ObstacleSight>& obstacles) {
  if (!has_field_) return;
  const Carpet carpet = sample_carpet(image);
  if (carpet.samples < kLeastCarpet) return;
  if (line_width_ > 0.0) scan_lines(image, map, carpet, lines);
  find_feet(image, map, carpet);
  join_feet(obstacles);
}

}  // namespace movis::scan
