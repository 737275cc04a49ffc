#include "movis/experiments/match.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/localization/localizer.h"

namespace movis::experiments {
namespace {

pipeline::Player make_player(const sim::Scenario& scenario, const MatchOptions& options) {
  pipeline::Pipeline vision(scenario.rig, scenario.arena.field, scan::read_colours(data_file("colours/default.yaml")),
                            options.pipeline, localization::find_localizer(options.localizer),
                            triangulation::find_triangulator(options.triangulation));
  return {std::move(vision), scenario.robot};
}

report::EncodedImage small_picture(const cv::Mat& bgr) {
  constexpr int kQuality = 80;
  report::EncodedImage image;
  cv::Mat half;
  cv::resize(bgr, half, {}, 0.5, 0.5, cv::INTER_AREA);
  image.width = half.cols;
  image.height = half.rows;
  if (!cv::imencode(".jpg", half, image.bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality})) {
    throw Error("OpenCV cannot write JPEG images");
  }
  return image;
}

report::EpisodeView view_of(const grab::FrameSet& images) {
  report::EpisodeView view{images.time_s, {}};
  for (const cv::Mat& image : images.memory) view.cameras.push_back(small_picture(image));
  return view;
}

}  // namespace

control::Task task_of(const sim::Scenario& scenario) {
  if (!scenario.arena.field) {
    throw Error("scenario '{}' has no field: there is no goal to shoot at; name a `field` in it", scenario.name);
  }
  const Field& field = *scenario.arena.field;
  constexpr double kBall = 2.0 * sim::kBallRadius;
  if (2.0 * field.Fw <= kBall || field.goal_height <= kBall || field.goal_depth <= kBall + 0.5 * sim::kBackPanel) {
    throw Error(
        "scenario '{}': no ball can enter the goals of its field: a ball is {} m thick, a goal {} m wide inside, {} m "
        "high and {} m deep; check Fw, goal_height and goal_depth",
        scenario.name, kBall, 2.0 * field.Fw, field.goal_height, field.goal_depth);
  }
  return {field, scenario.robot, sim::kBallRadius};
}

Match::Match(const sim::Scenario& scenario, const MatchOptions& options)
    : options_(options), task_(task_of(scenario)), player_(make_player(scenario, options)),
      simulator_(scenario, 0) {}

report::Episode Match::play(const std::string& contender, control::Controller& controller, std::uint64_t seed,
                            double view_interval_s) {
  report::Episode episode;
  episode.contender = contender;
  episode.seed = seed;
  simulator_.restart(seed);
  player_.start(0.0);
  controller.start();
  double next_view_s = 0.0;
  while (simulator_.acquire(images_)) {
    if (options_.every_tick) options_.every_tick();
    const control::Command command = pipeline::play(player_, controller, images_);
    simulator_.send(command);
    episode.ticks.push_back(recorded(command, controller));
    if (view_interval_s > 0.0 && images_.time_s >= next_view_s) {
      episode.views.push_back(view_of(images_));
      next_view_s += view_interval_s;
    }
  }
  for (const control::Signal& signal : controller.signals()) {
    episode.signal_names.push_back(signal.name);
    episode.signal_units.push_back(signal.unit);
  }
  episode.outcome = sim::word(*simulator_.outcome());
  episode.duration_s = simulator_.truth().time_s;
  episode.kicks = simulator_.kicks();
  return episode;
}

report::EpisodeTick Match::recorded(const control::Command& command, const control::Controller& controller) const {
  const world::World& world = player_.world;
  const world::WorldOptions& limits = options_.pipeline.world;
  report::EpisodeTick tick;
  tick.time_s = world.time_s;
  tick.true_pose = simulator_.truth().world_from_robot;
  tick.true_ball = simulator_.truth().ball_in_field;
  tick.measured_pose = player_.vision.estimate.fix.status == FixStatus::ok;
  tick.measured_ball = player_.vision.estimate.ball_in_robot.status == PointStatus::ok;
  if (has_pose(world, limits)) {
    tick.pose = world.world_from_robot;
    if (has_ball(world, limits)) tick.ball = world.world_from_robot * world.ball_in_robot;
  }
  tick.vx = command.velocity.vx;
  tick.vy = command.velocity.vy;
  tick.omega = command.velocity.omega;
  tick.kick = command.kick;
  tick.status = word(player_.drive.status());
  if (player_.drive.status() == control::DriveStatus::ok) {
    for (const control::Signal& signal : controller.signals()) tick.signals.push_back(signal.value);
  }
  return tick;
}

}  // namespace movis::experiments
