#include "track_command.h"

#include <fmt/format.h>

#include <map>
#include <vector>

#include "estimates_file.h"
#include "evaluation.h"
#include "interrupt.h"
#include "movis/core/error.h"
#include "movis/core/median.h"
#include "movis/core/paths.h"
#include "movis/core/version.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "obstacles_file.h"
#include "outputs.h"
#include "progress.h"
#include "track_frames.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

pipeline::Pipeline make_pipeline(const TrackArguments& arguments, const grab::Dataset& dataset) {
  std::optional<Field> field;
  if (arguments.field) {
    field = read_field(*arguments.field);
  } else if (dataset.field_file) {
    field = read_field(*dataset.field_file);
  }
  const scan::Colours colours =
      scan::read_colours(arguments.colours ? *arguments.colours : data_file("colours/default.yaml"));
  const pipeline::Options options =
      arguments.options ? pipeline::read_options(*arguments.options) : pipeline::Options{};
  pipeline::Pipeline pipeline(dataset.rig, field, colours, options, localization::find_localizer(arguments.localizer),
                              triangulation::find_triangulator(arguments.triangulation));
  if (arguments.correction) pipeline.correction = triangulation::read_correction(*arguments.correction, dataset.rig);
  return pipeline;
}

// The command that makes the page again.
std::string command_of(const TrackArguments& arguments) {
  std::string command = fmt::format("movis track --data {} --triangulation {} --localizer {}", arguments.data.string(),
                                    arguments.triangulation, arguments.localizer);
  const auto add = [&](const char* option, const std::optional<fs::path>& file) {
    if (file) command += fmt::format(" {} {}", option, file->string());
  };
  add("--rig", arguments.rig);
  add("--field", arguments.field);
  add("--colours", arguments.colours);
  add("--correction", arguments.correction);
  add("--options", arguments.options);
  return command;
}

// How often each status came, most frequent words first to read: "ok 26, one_goal 1".
std::string count_statuses(const std::map<std::string, int>& counts) {
  std::string text;
  for (const auto& [status, count] : counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", status, count);
  return text;
}

// Images, by what was recognized of their light.
using LightCounts = std::map<std::string, int>;

const char* word(scan::LightStatus status) {
  switch (status) {
    case scan::LightStatus::reference:
      return "reference";
    case scan::LightStatus::by_carpet:
      return "by_carpet";
    case scan::LightStatus::by_lines:
      return "by_lines";
    default:
      return "unknown";
  }
}

void add_lights(const pipeline::Pipeline& pipeline, const grab::FrameSet& images, LightCounts& counts) {
  for (std::size_t camera = 0; camera < images.frames.size(); ++camera) {
    if (!images.frames[camera].lost()) ++counts[word(pipeline.scanners[camera].light().status)];
  }
}

// Nothing where all images are in the light that the classes are made for.
std::string light_lines(const LightCounts& counts) {
  const auto of = [&](scan::LightStatus status) {
    const auto found = counts.find(word(status));
    return found != counts.end() ? found->second : 0;
  };
  int images = 0;
  for (const auto& [status, count] : counts) images += count;
  if (of(scan::LightStatus::reference) == images) return {};
  std::string text = fmt::format("  light {}\n", count_statuses(counts));
  if (2 * of(scan::LightStatus::unknown) > images) {
    text +=
        "  unknown light: these images were taken as they are; too little in them is the typical carpet, in any light "
        "that is\n  believed. Give colour classes for them, with the carpet as field and typical, by --colours\n";
  }
  return text;
}

}  // namespace

void track(const TrackArguments& arguments) {
  grab::DatasetSource source(grab::read_dataset(arguments.data, arguments.rig));
  const std::size_t sets = source.dataset().frames.size();
  pipeline::Pipeline pipeline = make_pipeline(arguments, source.dataset());
  std::map<std::int64_t, grab::Truth> truth;
  if (const fs::path file = arguments.data / "truth.csv"; fs::exists(file)) {
    truth = grab::read_truth(file);
    const auto& frames = source.dataset().frames;
    const bool fits =
        std::any_of(frames.begin(), frames.end(), [&](const auto& f) { return truth.count(f.index) > 0; });
    if (!fits) throw Error("{}: has none of the frames of frames.csv; is it of another recording?", file.string());
  }

  refuse_to_overwrite({{"--out", arguments.out}, {"--page", arguments.page}, {"--obstacles", arguments.obstacles}},
                      files_of(source.dataset()),
                      {arguments.field, arguments.colours, arguments.correction, arguments.options});
  EstimatesFile estimates(arguments.out);
  std::optional<ObstaclesFile> obstacles;
  if (arguments.obstacles) obstacles.emplace(*arguments.obstacles);
  Evaluation evaluation;
  std::map<std::string, int> ball_statuses, pose_statuses;
  LightCounts lights;
  std::vector<double> ticks_us;
  std::optional<TrackFrames> frames;
  if (arguments.page) frames.emplace(arguments.data.filename().string(), pipeline.rig, sets);
  Progress progress("track", sets);
  source.open();
  for (grab::FrameSet images; source.acquire(images); progress.advance()) {
    check_interrupts();
    const pipeline::Estimate& estimate = step(pipeline, images);
    estimates.add(estimate);
    if (obstacles) obstacles->add(estimate);
    ++ball_statuses[word(estimate.ball_in_robot.status)];
    ++pose_statuses[word(estimate.fix.status)];
    add_lights(pipeline, images, lights);
    ticks_us.push_back(estimate.tick_us);
    const auto found = truth.find(estimate.index);
    const grab::Truth* true_state = found != truth.end() ? &found->second : nullptr;
    if (true_state != nullptr) evaluation.add(estimate, *true_state);
    if (frames) frames->add(pipeline, images, true_state);
  }
  estimates.flush();
  if (obstacles) obstacles->flush();
  if (frames) {
    const std::string command = command_of(arguments);
    report::write_track_page({"MOVIS: what the cameras saw and what was measured", frames->take(),
                              std::string("movis ") + version(), command},
                             *arguments.page);
  }
  estimates.commit();
  if (obstacles) obstacles->commit();
  progress.finish();

  fmt::print("{} sets of {} images: median tick {:.0f} µs\n  ball  {}\n  pose  {}\n", sets, pipeline.rig.cameras.size(),
             median(ticks_us), count_statuses(ball_statuses), count_statuses(pose_statuses));
  fmt::print("{}", light_lines(lights));
  if (!truth.empty()) fmt::print("{}", evaluation.table());
  fmt::print("estimates: {}\n", arguments.out.string());
  if (arguments.obstacles) fmt::print("obstacles: {}\n", arguments.obstacles->string());
  if (arguments.page) fmt::print("open in a browser: {}\n", fs::absolute(*arguments.page).string());
}

}  // namespace movis::app
