#pragma once

#include <string>
#include <vector>

#include "movis/grab/truth.h"
#include "movis/pipeline/pipeline.h"
#include "movis/report/track_page.h"
#include "pictures.h"

namespace movis::app {

// Frames for a page about a tracked data set: every frame of a short one, evenly chosen ones of a long one.
class TrackFrames {
 public:
  TrackFrames(std::string set, const omni::Rig& rig, std::size_t frames_in_all);

  // To be called after every step of the pipeline. `truth` may be null.
  void add(const pipeline::Pipeline& pipeline, const grab::FrameSet& images, const grab::Truth* truth);

  std::vector<report::TrackFrame> take() { return std::move(frames_); }

 private:
  std::string set_;
  std::vector<PictureMaker> makers_;  // one a camera
  std::size_t stride_;
  std::size_t seen_ = 0;
  std::vector<report::TrackFrame> frames_;
};

}  // namespace movis::app
