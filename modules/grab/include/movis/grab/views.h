#pragma once

#include <visp3/core/vpImage.h>
#include <visp3/core/vpRGBa.h>

#include <opencv2/core/mat.hpp>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/grab/image_source.h"

// Between OpenCV's, ViSP's and our own images.
namespace movis::grab {

// Looks at the matrix without a copy, as OpenCV itself reads one: CV_8UC3 is BGR8, CV_8UC1 is Mono8, an empty matrix an
// empty view. Any other type is an Error: OpenCV's four channels are BGRA, which no view describes.
ImageView view_of(const cv::Mat& image);

// The same where the layout is not the one that OpenCV assumes: RGB8, RGBA8 or a Bayer mosaic. An Error where the
// matrix has not the format's number of 8-bit channels.
ImageView view_of(const cv::Mat& image, PixelFormat format);

// Looks at the image without a copy, as RGBA8. An image without pixels gives an empty view.
ImageView view_of(const vpImage<vpRGBa>& image);

// Copies any format into an image of ViSP, reusing its memory where the size stays the same. Mono8 becomes grey, a
// Bayer mosaic is interpolated bilinearly, alpha is 255 except where RGBA8 brings its own. An empty view makes an image
// of size 0 x 0.
void copy(const ImageView& view, vpImage<vpRGBa>& image);

// ImageSource::acquire() for those who work with ViSP's images: one image for each camera, in the rig's order. A lost
// image has the size 0 x 0. At the end of the source (false) the images stay as they are. Size `images` before
// opening windows on them: growing the vector moves them.
bool acquire(ImageSource& source, FrameSet& set, std::vector<vpImage<vpRGBa>>& images);

}  // namespace movis::grab
