#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "movis/core/image_view.h"

namespace movis::grab {

// One camera's part of a set. A lost image has an empty view; the other cameras go on.
struct Frame {
  ImageView view;
  double time_s = 0.0;

  bool lost() const { return view.empty(); }
};

// The images of one instant, one frame for each camera of the rig and in the rig's order. The set owns the memory
// that the views look at; it is reused from one acquire() to the next. Moving a set keeps its views valid. There is
// no copying: a copy would share the memory and be overwritten with it. To keep a set, move it away.
struct FrameSet {
  FrameSet() = default;
  FrameSet(FrameSet&&) = default;
  FrameSet& operator=(FrameSet&&) = default;

  std::int64_t index = 0;  // the source's own number of this set
  double time_s = 0.0;
  std::vector<Frame> frames;
  std::vector<cv::Mat> memory;
};

// A source of synchronized sets of n images, in the shape of ViSP's frame grabbers.
class ImageSource {
 public:
  virtual ~ImageSource() = default;

  virtual void open() = 0;  // throws an Error where the source cannot deliver
  // The next set; false at the end of the source. Throws an Error where an image that should be there is not.
  virtual bool acquire(FrameSet& set) = 0;
  virtual void close() = 0;
};

}  // namespace movis::grab
