#include "movis/scan/polar_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::scan {
namespace {

cv::Mat read_mask(const omni::Camera& camera) {
  if (camera.mask.empty()) return {};
  cv::Mat mask = cv::imread(camera.mask.string(), cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  if (mask.empty())
    throw Error("{}: the mask of camera '{}' cannot be read as an image", camera.mask.string(), camera.name);
  if (mask.cols != camera.width || mask.rows != camera.height) {
    throw Error("{}: the mask of camera '{}' is {}×{}, its images are {}×{}", camera.mask.string(), camera.name,
                mask.cols, mask.rows, camera.width, camera.height);
  }
  return mask;
}

// The solid angle of a pixel from the rays half a pixel to its sides; 0 at the border of the domain.
double solid_angle(const omni::Camera& camera, int u, int v) {
  const auto left = unproject(camera.model, {u - 0.5, v});
  const auto right = unproject(camera.model, {u + 0.5, v});
  const auto top = unproject(camera.model, {u, v - 0.5});
  const auto bottom = unproject(camera.model, {u, v + 0.5});
  if (!left || !right || !top || !bottom) return 0.0;
  return (*right - *left).cross(*bottom - *top).norm();
}

}  // namespace

std::size_t PolarMap::scanned_pixels() const {
  std::size_t pixels = 0;
  for (const Run& run : runs) pixels += static_cast<std::size_t>(run.end - run.begin);
  return pixels;
}

PolarMap make_polar_map(const omni::Camera& camera, int bins, double min_elevation, double max_elevation) {
  const cv::Mat mask = read_mask(camera);
  constexpr std::uint8_t kOpen = 128;  // grey levels of a mask: a JPEG's black is not quite black
  const Eigen::Matrix3d robot_from_camera = camera.robot_from_camera();
  const double min_z = std::sin(min_elevation);
  const double max_z = std::sin(max_elevation);
  PolarMap map;
  map.width = camera.width;
  map.height = camera.height;
  map.bins = bins;
  const auto pixels = static_cast<std::size_t>(camera.width) * camera.height;
  map.bin.resize(pixels);
  map.ray.resize(pixels);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (!mask.empty() && mask.at<std::uint8_t>(v, u) < kOpen) continue;
      const auto ray_in_camera = unproject(camera.model, Eigen::Vector2d(u, v));
      if (!ray_in_camera) continue;
      const Eigen::Vector3d ray = robot_from_camera * *ray_in_camera;
      const double covered = solid_angle(camera, u, v);
      if (!(covered > 0.0) || ray.z() < min_z || ray.z() > max_z) continue;
      const double turns = (std::atan2(ray.y(), ray.x()) + kPi) / (2.0 * kPi);
      map.bin[map.index(u, v)] = static_cast<std::uint16_t>(std::min(static_cast<int>(turns * bins), bins - 1));
      map.ray[map.index(u, v)] = {static_cast<float>(ray.x()), static_cast<float>(ray.y()), static_cast<float>(ray.z()),
                                  static_cast<float>(covered)};
      if (map.runs.empty() || map.runs.back().row != v || map.runs.back().end != u) map.runs.push_back({v, u, u});
      map.runs.back().end = u + 1;
    }
  }
  if (map.runs.empty()) {
    throw Error(
        "camera '{}' sees nothing: its model and mask leave no pixel of the picture with a ray between elevations "
        "{:.1f}° and {:.1f}°; check the rig file and the scan options",
        camera.name, degrees(min_elevation), degrees(max_elevation));
  }
  return map;
}

}  // namespace movis::scan
