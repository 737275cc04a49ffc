#include "track_frames.h"

#include <utility>

#include "evaluation.h"

namespace movis::app {
namespace {

constexpr std::size_t kMostFrames = 32;  // on one page
constexpr ObjectClass kShown[] = {ObjectClass::ball, ObjectClass::yellow_goal, ObjectClass::blue_goal};

report::CameraPicture camera_picture(const pipeline::Pipeline& pipeline, std::size_t index, const PictureMaker& maker,
                                     const grab::FrameSet& images) {
  const omni::Camera& camera = pipeline.rig.cameras[index];
  report::CameraPicture picture;
  picture.name = camera.name;
  picture.position = camera.position.head<2>();
  picture.lost = images.frames[index].lost();
  if (picture.lost) return picture;
  picture.image = maker.picture(images.memory[index]);
  picture.panorama = maker.panorama(images.memory[index]);
  for (const Bearing& bearing : pipeline.estimate.bearings) {
    if (bearing.camera == static_cast<int>(index)) picture.marks.push_back(mark(camera, bearing));
  }
  for (const ObjectClass object : kShown) {
    const scan::Histogram& histogram = pipeline.scanners[index].histogram(object);
    picture.histograms.push_back({object, histogram.counts, histogram.threshold});
  }
  return picture;
}

}  // namespace

TrackFrames::TrackFrames(std::string set, const omni::Rig& rig, std::size_t frames_in_all)
    : set_(std::move(set)), stride_((frames_in_all + kMostFrames - 1) / kMostFrames) {
  for (const omni::Camera& camera : rig.cameras) makers_.emplace_back(camera);
}

void TrackFrames::add(const pipeline::Pipeline& pipeline, const grab::FrameSet& images, const grab::Truth* truth) {
  if (seen_++ % stride_ != 0) return;
  report::TrackFrame frame;
  frame.set = set_;
  frame.frame = static_cast<int>(images.index);
  for (std::size_t i = 0; i < makers_.size(); ++i) {
    frame.cameras.push_back(camera_picture(pipeline, i, makers_[i], images));
  }
  frame.ball_in_robot = pipeline.estimate.ball_in_robot;
  frame.fix = truth != nullptr ? nearer_half(pipeline.estimate.fix, truth->world_from_robot) : pipeline.estimate.fix;
  frame.tick_us = pipeline.estimate.tick_us;
  if (pipeline.map) frame.field = pipeline.map->field;
  if (truth != nullptr) {
    frame.label = truth->label;
    frame.true_pose = truth->world_from_robot;
    frame.true_ball_in_robot = true_ball_in_robot(*truth);
    frame.true_ball_in_field = truth->ball_in_field.head<2>();
  }
  frames_.push_back(std::move(frame));
}

}  // namespace movis::app
