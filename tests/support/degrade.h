#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "movis/core/random.h"

namespace movis::test {

struct Degradation {
  double blur_px = 0.6;       // one sigma of a Gaussian
  double noise_levels = 2.0;  // one sigma of white noise, grey levels
};

// What a real lens and sensor add to a ray-traced image.
inline void degrade(cv::Mat& bgr, const Degradation& degradation, RandomStream& random) {
  if (degradation.blur_px > 0.0) cv::GaussianBlur(bgr, bgr, cv::Size(), degradation.blur_px);
  std::normal_distribution<double> noise(0.0, degradation.noise_levels);
  for (int v = 0; v < bgr.rows; ++v) {
    auto* row = bgr.ptr<std::uint8_t>(v);
    for (int i = 0; i < bgr.cols * bgr.channels(); ++i)
      row[i] = cv::saturate_cast<std::uint8_t>(row[i] + noise(random));
  }
}

}  // namespace movis::test
