#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "movis/grab/dataset.h"

namespace movis::grab {

// Reads the image of one cell, which must not be lost, as 8-bit BGR of the rig's size. The memory of `bytes` (the file)
// and `image` is reused. An Error names the cell and says whether the file is unreadable, cut off, no image, or of
// another size. Only of PNG and JPEG it is known where they must end, so only they are known to be complete.
void read_image(const Dataset& dataset, const DatasetFrame& frame, std::size_t camera, std::vector<std::uint8_t>& bytes,
                cv::Mat& image);

}  // namespace movis::grab
