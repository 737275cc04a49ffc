#pragma once

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "movis/core/random.h"

namespace movis::test {

struct Degradation {
  double blur_px = 0.6;                        // one sigma of a Gaussian
  double noise_levels = 2.0;                   // one sigma of white noise, grey levels
  std::array<double, 3> gains{1.0, 1.0, 1.0};  // of the bytes of red, green, blue: another light
};

// What other light, a real lens and a sensor make of a ray-traced image.
inline void degrade(cv::Mat& bgr, const Degradation& degradation, RandomStream& random) {
  if (degradation.gains != std::array<double, 3>{1.0, 1.0, 1.0}) {
    cv::multiply(bgr, cv::Scalar(degradation.gains[2], degradation.gains[1], degradation.gains[0]), bgr);
  }
  if (degradation.blur_px > 0.0) cv::GaussianBlur(bgr, bgr, cv::Size(), degradation.blur_px);
  if (!(degradation.noise_levels > 0.0)) return;
  std::normal_distribution<double> noise(0.0, degradation.noise_levels);
  for (int v = 0; v < bgr.rows; ++v) {
    auto* row = bgr.ptr<std::uint8_t>(v);
    for (int i = 0; i < bgr.cols * bgr.channels(); ++i)
      row[i] = cv::saturate_cast<std::uint8_t>(row[i] + noise(random));
  }
}

}  // namespace movis::test
