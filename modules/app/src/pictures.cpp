#include "pictures.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::app {
namespace {

constexpr int kPanoramaWidth = 1080;
constexpr int kMinElevationDeg = -45;
constexpr int kMaxElevationDeg = 20;
constexpr int kPanoramaHeight =
    kPanoramaWidth * (kMaxElevationDeg - kMinElevationDeg) / 360;  // degrees as high as wide

std::optional<Eigen::Vector2d> pixel_of(const omni::Camera& camera, double azimuth, double elevation) {
  const double horizontal = std::cos(elevation);
  const Eigen::Vector3d ray(horizontal * std::cos(azimuth), horizontal * std::sin(azimuth), std::sin(elevation));
  return project(camera, camera.position + ray);
}

report::EncodedImage encode(const cv::Mat& bgr) {
  constexpr int kQuality = 88;
  report::EncodedImage image;
  image.width = bgr.cols;
  image.height = bgr.rows;
  if (!cv::imencode(".jpg", bgr, image.bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality})) {
    throw Error("a picture of {}×{} could not be encoded as JPEG", bgr.cols, bgr.rows);
  }
  return image;
}

// The line of one azimuth in the picture, from below the horizon to above it.
std::vector<Eigen::Vector2d> line_of(const omni::Camera& camera, double azimuth) {
  std::vector<Eigen::Vector2d> line;
  for (int elevation_deg = kMinElevationDeg; elevation_deg <= kMaxElevationDeg; ++elevation_deg) {
    if (const auto pixel = pixel_of(camera, azimuth, radians(elevation_deg))) line.push_back(*pixel);
  }
  return line;
}

}  // namespace

PictureMaker::PictureMaker(const omni::Camera& camera)
    : columns_(kPanoramaHeight, kPanoramaWidth, CV_32FC1), rows_(kPanoramaHeight, kPanoramaWidth, CV_32FC1) {
  for (int v = 0; v < kPanoramaHeight; ++v) {
    const double share = (v + 0.5) / kPanoramaHeight;
    const double elevation = radians(kMaxElevationDeg + share * (kMinElevationDeg - kMaxElevationDeg));
    for (int u = 0; u < kPanoramaWidth; ++u) {
      const double azimuth = kPi - (u + 0.5) / kPanoramaWidth * 2.0 * kPi;
      const auto pixel = pixel_of(camera, azimuth, elevation);
      columns_.at<float>(v, u) = pixel ? static_cast<float>(pixel->x()) : -1.0F;
      rows_.at<float>(v, u) = pixel ? static_cast<float>(pixel->y()) : -1.0F;
    }
  }
}

report::EncodedImage PictureMaker::picture(const cv::Mat& bgr) const {
  return encode(bgr);
}

report::Panorama PictureMaker::panorama(const cv::Mat& bgr) const {
  cv::Mat unrolled;
  cv::remap(bgr, unrolled, columns_, rows_, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return {encode(unrolled), kMinElevationDeg, kMaxElevationDeg};
}

report::BearingMark mark(const omni::Camera& camera, const Bearing& bearing) {
  report::BearingMark mark;
  mark.object = bearing.object;
  mark.azimuth_deg = degrees(bearing.azimuth);
  mark.elevation_deg = degrees(bearing.elevation);
  mark.left_deg = degrees(bearing.left);
  mark.right_deg = degrees(bearing.right);
  mark.flags = bearing.flags;
  mark.centre_px = pixel_of(camera, bearing.azimuth, bearing.elevation);
  mark.centre_line = line_of(camera, bearing.azimuth);
  mark.left_line = line_of(camera, bearing.left);
  mark.right_line = line_of(camera, bearing.right);
  return mark;
}

}  // namespace movis::app
