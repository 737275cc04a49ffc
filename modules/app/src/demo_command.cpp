#include "demo_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <vector>

#include "evaluation.h"
#include "interrupt.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "pictures.h"
#include "progress.h"

namespace movis::app {
namespace {

constexpr const char* kSets[] = {"field", "field-obstacles", "open", "near"};
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

report::TrackFrame track_frame(const std::string& set, const pipeline::Pipeline& pipeline,
                               const std::vector<PictureMaker>& makers, const grab::FrameSet& images,
                               const grab::Truth* truth) {
  report::TrackFrame frame;
  frame.set = set;
  frame.frame = static_cast<int>(images.index);
  for (std::size_t i = 0; i < makers.size(); ++i) {
    frame.cameras.push_back(camera_picture(pipeline, i, makers[i], images));
  }
  frame.ball_in_robot = pipeline.estimate.ball_in_robot;
  frame.fix = pipeline.estimate.fix;
  frame.tick_us = pipeline.estimate.tick_us;
  frame.field = pipeline.field;
  if (truth != nullptr) {
    frame.label = truth->label;
    frame.true_pose = truth->world_from_robot;
    frame.true_ball_in_robot = true_ball_in_robot(*truth);
    frame.true_ball_in_field = truth->ball_in_field.head<2>();
  }
  return frame;
}

void track_set(const std::string& set, report::TrackPage& page, Evaluation& evaluation) {
  const std::filesystem::path folder = data_file("images/" + set);
  grab::DatasetSource source(grab::read_dataset(folder));
  const std::map<std::int64_t, grab::Truth> truth = grab::read_truth(folder / "truth.csv");
  const grab::Dataset& dataset = source.dataset();
  std::optional<Field> field;
  if (dataset.field_file) field = read_field(*dataset.field_file);
  pipeline::Pipeline pipeline(dataset.rig, field, scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer("composed"));
  std::vector<PictureMaker> makers;
  for (const omni::Camera& camera : dataset.rig.cameras) makers.emplace_back(camera);
  source.open();
  for (grab::FrameSet images; source.acquire(images);) {
    check_interrupts();
    step(pipeline, images);
    const auto found = truth.find(images.index);
    const grab::Truth* true_state = found != truth.end() ? &found->second : nullptr;
    if (true_state != nullptr) evaluation.add(pipeline.estimate, *true_state);
    page.frames.push_back(track_frame(set, pipeline, makers, images, true_state));
  }
}

}  // namespace

void demo(const DemoArguments& arguments) {
  report::TrackPage page;
  page.title = "MOVIS: three omnidirectional cameras see, measure and localize";
  page.version = "movis " MOVIS_VERSION;
  page.command = fmt::format("movis demo --out {}", arguments.out.string());
  Progress progress("demo", std::size(kSets));
  for (const char* set : kSets) {
    Evaluation evaluation;
    track_set(set, page, evaluation);
    progress.advance();
    fmt::print("{}: {}", set, evaluation.table());
  }
  report::write_track_page(page, arguments.out);
  progress.finish();
  fmt::print("{} frames, open in a browser: {}\n", page.frames.size(),
             std::filesystem::absolute(arguments.out).string());
}

}  // namespace movis::app
