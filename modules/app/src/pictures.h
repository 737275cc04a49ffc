#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/omni/rig.h"
#include "movis/report/track_page.h"

namespace movis::app {

// One camera's picture for a page: as it is, and unrolled.
class PictureMaker {
 public:
  explicit PictureMaker(const omni::Camera& camera);

  report::EncodedImage picture(const cv::Mat& bgr) const;
  report::Panorama panorama(const cv::Mat& bgr) const;

 private:
  cv::Mat columns_, rows_;  // of the picture, for every pixel of the panorama
};

// Where a bearing and its edges lie in the camera's picture.
report::BearingMark mark(const omni::Camera& camera, const Bearing& bearing);

}  // namespace movis::app
