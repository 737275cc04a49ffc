#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "movis/core/field.h"
#include "movis/core/pose.h"
#include "movis/report/picture.h"

// A page that shows closed-loop episodes: who won, where robot and ball went, what the cameras saw, how good the
// estimates were, and what went on inside the controllers. Everything here is plain data for a screen, with the same
// conventions as track_page.h.
namespace movis::report {

// What happened in one tick. Values that were not known then are left out.
struct EpisodeTick {
  double time_s = 0.0;
  Pose2 true_pose;                                      // world_from_robot
  Eigen::Vector3d true_ball = Eigen::Vector3d::Zero();  // field frame
  std::optional<Pose2> pose;                            // as believed at this time; nothing: stale
  std::optional<Eigen::Vector2d> ball;                  // field frame, as believed
  bool measured_pose = false;                           // of this very instant, not carried along
  bool measured_ball = false;
  double vx = 0.0, vy = 0.0, omega = 0.0;  // the command, robot frame
  bool kick = false;
  std::string status;           // of the drive, "ok" mostly
  std::vector<double> signals;  // the controller's, in the order of signal_names; empty: it was not asked
};

// What the cameras saw at one tick.
struct EpisodeView {
  double time_s = 0.0;
  std::vector<EncodedImage> cameras;  // in the order of camera_names
};

struct EpisodeObstacle {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double radius = 0.0;
};

// One contender in one start.
struct Episode {
  std::string contender;  // e.g. "fuzzy"
  std::uint64_t seed = 0;
  std::string outcome;  // e.g. "goal"
  double duration_s = 0.0;
  int kicks = 0;
  std::vector<std::string> signal_names;  // weights first
  std::vector<std::string> signal_units;  // "" for a weight of 0…1
  std::vector<EpisodeTick> ticks;         // in the order of time; may be empty
  std::vector<EpisodeView> views;         // in the order of time; may be empty
};

// A rate with its 95 % Wilson interval, and times to the goal.
struct ContenderSummary {
  std::string contender;
  int episodes = 0;
  int goals = 0;
  double rate_low = 0.0, rate_high = 0.0;
  std::vector<std::pair<std::string, int>> outcomes;  // word, count; "goal" is shown as the rate
  double median_time_s = 0.0;                         // to the goal; NaN: there was none
  double pose_error_m = 0.0;                          // mean over ticks of these episodes, position; NaN: unknown
  double ball_error_m = 0.0;
};

struct EpisodePage {
  std::string title;
  std::string version;
  std::string command;
  Field field;
  double robot_radius = 0.0;
  double ball_radius = 0.0;
  std::vector<EpisodeObstacle> obstacles;
  std::vector<std::string> camera_names;
  std::vector<ContenderSummary> summaries;
  std::vector<Episode> episodes;  // those to show; episodes of one seed are shown beside each other
};

// Writes one HTML file that needs nothing beside it and no network. An Error where the file cannot be written, where a
// picture is neither PNG nor JPEG or has no size, and where the parts of an episode do not fit together: ticks or views
// out of order, signals without names, pictures of other cameras, a contender twice from one seed. Then no file is left
// behind.
void write_episode_page(const EpisodePage& page, const std::filesystem::path& file);

}  // namespace movis::report
