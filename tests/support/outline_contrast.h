#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "movis/core/angle.h"
#include "movis/omni/rig.h"

namespace movis::test {

// How a ball stands out in a picture: the root of the mean squared step of its grey levels along its outline, summed
// over the three channels, from some pixels within to as many outside. 0 where the picture shows none of the outline.
inline double outline_contrast(const cv::Mat& bgr, const omni::Camera& camera, const Eigen::Vector3d& ball_in_robot,
                               double ball_radius, double away_px) {
  constexpr int kPieces = 90;
  const Eigen::Vector3d offset = ball_in_robot - camera.position;
  const double radius = std::asin(ball_radius / offset.norm());
  const Eigen::Vector3d axis = offset.normalized();
  const Eigen::Vector3d left = Eigen::Vector3d(-axis.y(), axis.x(), 0.0).normalized();
  const Eigen::Vector3d up = axis.cross(left);
  const auto middle = omni::project(camera, ball_in_robot);
  double sum = 0.0;
  int pieces = 0;
  for (int i = 0; middle && i < kPieces; ++i) {
    const double psi = 2.0 * kPi * i / kPieces;
    const Eigen::Vector3d ray =
        std::cos(radius) * axis + std::sin(radius) * (std::cos(psi) * left + std::sin(psi) * up);
    const auto at = omni::project(camera, camera.position + ray);
    if (!at) continue;
    const Eigen::Vector2d outwards = (*at - *middle).normalized();
    const Eigen::Vector2i inside = (*at - away_px * outwards).array().round().matrix().cast<int>();
    const Eigen::Vector2i outside = (*at + away_px * outwards).array().round().matrix().cast<int>();
    if (outside.minCoeff() < 0 || outside.x() >= bgr.cols || outside.y() >= bgr.rows) continue;
    const auto in = bgr.at<cv::Vec3b>(inside.y(), inside.x());
    const auto out = bgr.at<cv::Vec3b>(outside.y(), outside.x());
    for (int c = 0; c < 3; ++c) sum += std::pow(static_cast<double>(in[c]) - out[c], 2);
    ++pieces;
  }
  return pieces > 0 ? std::sqrt(sum / pieces) : 0.0;
}

}  // namespace movis::test
