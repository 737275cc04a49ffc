#include "movis/grab/views.h"

#include <opencv2/imgproc.hpp>

#include "movis/core/error.h"

namespace movis::grab {
namespace {

static_assert(sizeof(vpRGBa) == 4, "a vpImage<vpRGBa> is viewed as RGBA8");

// OpenCV's older Bayer names (BayerBG for RGGB) go by the second row and column; these name the top-left pixels.
int conversion_to_rgba(PixelFormat format) {
  switch (format) {
    case PixelFormat::bgr8:
      return cv::COLOR_BGR2RGBA;
    case PixelFormat::rgb8:
      return cv::COLOR_RGB2RGBA;
    case PixelFormat::mono8:
      return cv::COLOR_GRAY2RGBA;
    case PixelFormat::bayer_rggb8:
      return cv::COLOR_BayerRGGB2RGBA;
    case PixelFormat::bayer_bggr8:
      return cv::COLOR_BayerBGGR2RGBA;
    case PixelFormat::bayer_grbg8:
      return cv::COLOR_BayerGRBG2RGBA;
    case PixelFormat::bayer_gbrg8:
      return cv::COLOR_BayerGBRG2RGBA;
    case PixelFormat::rgba8:
      break;
  }
  throw Error("an image of format {} has no conversion to RGBA", name(format));
}

}  // namespace

ImageView view_of(const cv::Mat& image) {
  if (image.empty()) return {};
  if (image.type() == CV_8UC3) return view_of(image, PixelFormat::bgr8);
  if (image.type() == CV_8UC1) return view_of(image, PixelFormat::mono8);
  throw Error(
      "a matrix of type {} has no pixel format of its own: convert it to CV_8UC3 (BGR) or CV_8UC1 (grey), or name the "
      "format if its channels are RGBA",
      cv::typeToString(image.type()));
}

ImageView view_of(const cv::Mat& image, PixelFormat format) {
  if (image.empty()) return {};
  if (image.dims != 2 || image.type() != CV_8UC(channels(format))) {
    throw Error("a matrix of type {} cannot be viewed as {}, which has {} channels of 8 bits: convert it first",
                cv::typeToString(image.type()), name(format), channels(format));
  }
  return {image.data, image.cols, image.rows, static_cast<std::ptrdiff_t>(image.step[0]), format};
}

ImageView view_of(const vpImage<vpRGBa>& image) {
  if (image.getSize() == 0) return {};
  return {reinterpret_cast<const std::uint8_t*>(image.bitmap), static_cast<int>(image.getWidth()),
          static_cast<int>(image.getHeight()), std::ptrdiff_t{4} * image.getWidth(), PixelFormat::rgba8};
}

void copy(const ImageView& view, vpImage<vpRGBa>& image) {
  if (view.empty()) {
    image.resize(0, 0);
    return;
  }
  image.resize(static_cast<unsigned int>(view.height), static_cast<unsigned int>(view.width));
  const cv::Mat source(view.height, view.width, CV_8UC(channels(view.format)), const_cast<std::uint8_t*>(view.data),
                       static_cast<std::size_t>(view.stride));
  cv::Mat target(view.height, view.width, CV_8UC4, image.bitmap);
  if (view.format == PixelFormat::rgba8) {
    source.copyTo(target);
  } else {
    cv::cvtColor(source, target, conversion_to_rgba(view.format));
  }
}

bool acquire(ImageSource& source, FrameSet& set, std::vector<vpImage<vpRGBa>>& images) {
  if (!source.acquire(set)) return false;
  images.resize(set.frames.size());
  for (std::size_t k = 0; k < images.size(); ++k) copy(set.frames[k].view, images[k]);
  return true;
}

}  // namespace movis::grab
