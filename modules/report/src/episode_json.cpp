#include "episode_json.h"

#include <cmath>
#include <limits>
#include <set>
#include <string_view>

#include "json.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::report {
namespace {

// Digits after the point: a field is drawn with some millimetres to the pixel, an error is read in tenths of
// centimetres.
constexpr int kTimeDigits = 3;
constexpr int kPlaceDigits = 3;
constexpr int kHeadingDigits = 1;
constexpr int kErrorDigits = 4;
constexpr int kHeadingErrorDigits = 2;
constexpr int kVelocityDigits = 3;
constexpr int kTurnRateDigits = 1;  // degrees a second
constexpr int kWeightDigits = 3;
constexpr int kRateDigits = 4;
constexpr int kSignificantDigits = 4;  // of signals with a unit

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Json significant(double value) {
  if (!std::isfinite(value) || value == 0.0) return number(value, 0);
  return number(value, kSignificantDigits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

// Preconditions

void check_episode(const Episode& episode, const EpisodePage& page) {
  const auto fail = [&episode](const std::string& what) {
    throw Error("report: the episode of {} from seed {} {}", episode.contender, episode.seed, what);
  };
  const std::size_t signals = episode.signal_names.size();
  if (episode.signal_units.size() != signals) {
    fail(fmt::format("names {} signals, but {} units", signals, episode.signal_units.size()));
  }
  double last_s = -std::numeric_limits<double>::infinity();
  for (const EpisodeTick& tick : episode.ticks) {
    if (!(tick.time_s >= last_s)) fail(fmt::format("has a tick at {} s after one at {} s", tick.time_s, last_s));
    last_s = tick.time_s;
    if (!tick.signals.empty() && tick.signals.size() != signals) {
      fail(fmt::format("has {} signals at {} s, but names {}", tick.signals.size(), tick.time_s, signals));
    }
  }
  last_s = -std::numeric_limits<double>::infinity();
  for (const EpisodeView& view : episode.views) {
    if (!(view.time_s >= last_s)) fail(fmt::format("has a view at {} s after one at {} s", view.time_s, last_s));
    last_s = view.time_s;
    if (view.cameras.size() != page.camera_names.size()) {
      fail(fmt::format("has {} pictures at {} s, but the page names {} cameras", view.cameras.size(), view.time_s,
                       page.camera_names.size()));
    }
  }
}

void check(const EpisodePage& page) {
  std::set<std::pair<std::string, std::uint64_t>> shown;
  for (const Episode& episode : page.episodes) {
    check_episode(episode, page);
    if (!shown.insert({episode.contender, episode.seed}).second) {
      throw Error("report: there are two episodes of {} from seed {}; show one of them", episode.contender,
                  episode.seed);
    }
  }
}

// Ticks

template <typename Value>
Json column(const std::vector<EpisodeTick>& ticks, Value value) {
  Json json = Json::array();
  for (const EpisodeTick& tick : ticks) json.push_back(value(tick));
  return json;
}

// A column of one number of what was believed, null where it was not known.
template <typename Believed, typename Value>
Json believed_column(const std::vector<EpisodeTick>& ticks, std::optional<Believed> EpisodeTick::*believed, int digits,
                     Value value) {
  return column(ticks, [&](const EpisodeTick& tick) {
    return number((tick.*believed) ? value(tick, *(tick.*believed)) : kUnknown, digits);
  });
}

Json truth_json(const std::vector<EpisodeTick>& ticks) {
  using Tick = const EpisodeTick&;
  return {{"x", column(ticks, [](Tick tick) { return number(tick.true_pose.x, kPlaceDigits); })},
          {"y", column(ticks, [](Tick tick) { return number(tick.true_pose.y, kPlaceDigits); })},
          {"beta_deg",
           column(ticks, [](Tick tick) { return number(degrees(wrap_angle(tick.true_pose.beta)), kHeadingDigits); })},
          {"ball_x", column(ticks, [](Tick tick) { return number(tick.true_ball.x(), kPlaceDigits); })},
          {"ball_y", column(ticks, [](Tick tick) { return number(tick.true_ball.y(), kPlaceDigits); })}};
}

Json believed_json(const std::vector<EpisodeTick>& ticks) {
  using Tick = const EpisodeTick&;
  using Ball = const Eigen::Vector2d&;
  const auto of_pose = [&ticks](int digits, auto value) {
    return believed_column(ticks, &EpisodeTick::pose, digits, value);
  };
  const auto of_ball = [&ticks](int digits, auto value) {
    return believed_column(ticks, &EpisodeTick::ball, digits, value);
  };
  return {{"x", of_pose(kPlaceDigits, [](Tick, const Pose2& pose) { return pose.x; })},
          {"y", of_pose(kPlaceDigits, [](Tick, const Pose2& pose) { return pose.y; })},
          {"beta_deg", of_pose(kHeadingDigits, [](Tick, const Pose2& pose) { return degrees(wrap_angle(pose.beta)); })},
          {"ball_x", of_ball(kPlaceDigits, [](Tick, Ball ball) { return ball.x(); })},
          {"ball_y", of_ball(kPlaceDigits, [](Tick, Ball ball) { return ball.y(); })},
          {"pose_error_m", of_pose(kErrorDigits,
                                   [](Tick tick, const Pose2& pose) {
                                     return (pose.translation() - tick.true_pose.translation()).norm();
                                   })},
          {"beta_error_deg",
           of_pose(kHeadingErrorDigits,
                   [](Tick tick, const Pose2& pose) { return degrees(turn(tick.true_pose.beta, pose.beta)); })},
          {"ball_error_m",
           of_ball(kErrorDigits, [](Tick tick, Ball ball) { return (ball - tick.true_ball.head<2>()).norm(); })},
          {"measured_pose", column(ticks, [](Tick tick) { return tick.measured_pose ? 1 : 0; })},
          {"measured_ball", column(ticks, [](Tick tick) { return tick.measured_ball ? 1 : 0; })}};
}

Json command_json(const std::vector<EpisodeTick>& ticks) {
  using Tick = const EpisodeTick&;
  return {{"vx", column(ticks, [](Tick tick) { return number(tick.vx, kVelocityDigits); })},
          {"vy", column(ticks, [](Tick tick) { return number(tick.vy, kVelocityDigits); })},
          {"speed", column(ticks, [](Tick tick) { return number(std::hypot(tick.vx, tick.vy), kVelocityDigits); })},
          {"turn_rate_deg", column(ticks, [](Tick tick) { return number(degrees(tick.omega), kTurnRateDigits); })}};
}

Json signal_json(const Episode& episode, std::size_t index) {
  const std::string& unit = episode.signal_units[index];
  const auto value = [&](const EpisodeTick& tick) {
    const double signal = tick.signals.empty() ? kUnknown : tick.signals[index];
    return unit.empty() ? number(signal, kWeightDigits) : significant(signal);
  };
  return {{"name", episode.signal_names[index]}, {"unit", unit}, {"values", column(episode.ticks, value)}};
}

Json kicks_json(const std::vector<EpisodeTick>& ticks) {  // the indices of their ticks
  Json json = Json::array();
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (ticks[i].kick) json.push_back(i);
  }
  return json;
}

// Where the drive was not ok: its status from one tick to another, both among them.
Json troubles_json(const std::vector<EpisodeTick>& ticks) {
  Json json = Json::array();
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    if (ticks[i].status.empty() || ticks[i].status == "ok") continue;
    if (i > 0 && ticks[i].status == ticks[i - 1].status) {
      json.back()["to"] = i;
    } else {
      json.push_back({{"status", ticks[i].status}, {"from", i}, {"to", i}});
    }
  }
  return json;
}

// Episodes

Json view_json(const EpisodeView& view, const std::vector<std::string>& camera_names) {
  Json pictures = Json::array();
  for (std::size_t k = 0; k < view.cameras.size(); ++k) {
    pictures.push_back(picture_json(view.cameras[k], camera_names[k]));
  }
  return {{"time_s", number(view.time_s, kTimeDigits)}, {"pictures", std::move(pictures)}};
}

Json episode_json(const Episode& episode, const std::vector<std::string>& camera_names) {
  const auto& ticks = episode.ticks;
  Json json = {{"contender", episode.contender},
               {"seed", std::to_string(episode.seed)},  // it may have more digits than a number of JavaScript
               {"outcome", episode.outcome},
               {"duration_s", number(episode.duration_s, kTimeDigits)},
               {"kicks", episode.kicks},
               {"time_s", column(ticks, [](const EpisodeTick& tick) { return number(tick.time_s, kTimeDigits); })},
               {"truth", truth_json(ticks)},
               {"believed", believed_json(ticks)},
               {"command", command_json(ticks)},
               {"signals", Json::array()},
               {"kick_ticks", kicks_json(ticks)},
               {"troubles", troubles_json(ticks)},
               {"views", Json::array()}};
  for (std::size_t i = 0; i < episode.signal_names.size(); ++i) json["signals"].push_back(signal_json(episode, i));
  for (const EpisodeView& view : episode.views) json["views"].push_back(view_json(view, camera_names));
  return json;
}

Json summary_json(const ContenderSummary& summary) {
  const double rate = summary.episodes > 0 ? static_cast<double>(summary.goals) / summary.episodes : kUnknown;
  Json json = {{"contender", summary.contender},
               {"episodes", summary.episodes},
               {"goals", summary.goals},
               {"rate", number(rate, kRateDigits)},
               {"rate_low", number(summary.rate_low, kRateDigits)},
               {"rate_high", number(summary.rate_high, kRateDigits)},
               {"outcomes", Json::array()},
               {"median_time_s", number(summary.median_time_s, kTimeDigits)},
               {"pose_error_m", number(summary.pose_error_m, kErrorDigits)},
               {"ball_error_m", number(summary.ball_error_m, kErrorDigits)}};
  for (const auto& [word, count] : summary.outcomes) json["outcomes"].push_back({{"word", word}, {"count", count}});
  return json;
}

}  // namespace

void write_json(const EpisodePage& page, std::ostream& out) {
  check(page);
  Json json = {{"field", field_json(page.field)},
               {"robot_radius", number(page.robot_radius, kMetreDigits)},
               {"ball_radius", number(page.ball_radius, kMetreDigits)},
               {"obstacles", Json::array()},
               {"cameras", page.camera_names},
               {"summaries", Json::array()},
               {"episodes", Json::array()}};
  for (const EpisodeObstacle& obstacle : page.obstacles) {
    json["obstacles"].push_back(
        {{"position", vector(obstacle.position, kPlaceDigits)}, {"radius", number(obstacle.radius, kPlaceDigits)}});
  }
  for (const ContenderSummary& summary : page.summaries) json["summaries"].push_back(summary_json(summary));
  for (const Episode& episode : page.episodes) json["episodes"].push_back(episode_json(episode, page.camera_names));
  out << script_text(json);
}

}  // namespace movis::report
