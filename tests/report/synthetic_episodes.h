#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "movis/core/random.h"
#include "movis/report/episode_page.h"

// Episodes that look like real ones, for the page's test.
namespace movis::test {

inline constexpr double kTick_s = 1.0 / 30.0;
inline const Eigen::Vector2d kGoal(0.0, 2.0);

inline Field paper_field() {
  return {1.75, 2.0, 0.5, 0.05, 2.0, 0.5, 0.5, 0.25, 0.01, Field::Goals::coloured, {}, {}, 0.0};
}

// Robot and ball; not physics, but like it.
struct SyntheticWorld {
  Pose2 robot;
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();
  Eigen::Vector2d ball_velocity = Eigen::Vector2d::Zero();
};

// Goes behind the ball while it turns to the goal, then straight on, and kicks.
inline report::EpisodeTick command(const SyntheticWorld& world, double speed) {
  const Eigen::Vector2d shot = (kGoal - world.ball).normalized();
  const Eigen::Vector2d behind = world.ball - 0.6 * shot - world.robot.translation();
  const Eigen::Vector2d ahead(-std::sin(world.robot.beta), std::cos(world.robot.beta));
  const Eigen::Vector2d to_ball = world.ball - world.robot.translation();
  const double misalignment = std::acos(std::clamp(shot.dot(to_ball.normalized()), -1.0, 1.0));
  const Eigen::Vector2d wanted = misalignment < 0.12 ? Eigen::Vector2d(2.0 * to_ball) : Eigen::Vector2d(2.5 * behind);
  const Eigen::Vector2d velocity = wanted * std::min(1.0, speed / wanted.norm());
  report::EpisodeTick tick;
  tick.vx = velocity.dot(Eigen::Vector2d(ahead.y(), -ahead.x()));
  tick.vy = velocity.dot(ahead);
  tick.omega = std::clamp(3.0 * turn(world.robot.beta, std::atan2(-shot.x(), shot.y())), -3.0, 3.0);
  tick.kick = to_ball.norm() < 0.41 && std::acos(std::min(1.0, shot.dot(ahead))) < 0.08;
  return tick;
}

inline void move(SyntheticWorld& world, const report::EpisodeTick& tick, double kick_direction) {
  const Eigen::Vector2d step =
      Pose2{0.0, 0.0, world.robot.beta} * Eigen::Vector2d(tick.vx * kTick_s, tick.vy * kTick_s);
  world.robot = {world.robot.x + step.x(), world.robot.y + step.y(), world.robot.beta + tick.omega * kTick_s};
  if (tick.kick) {
    const double beta = world.robot.beta + kick_direction;
    world.ball_velocity = 2.2 * Eigen::Vector2d(-std::sin(beta), std::cos(beta));
  }
  world.ball += world.ball_velocity * kTick_s;
  world.ball_velocity *= 0.985;
}

// The pose is measured nine times out of ten and unknown for half a second from 1.5 s on; the ball is carried along for
// a second from 3 s on.
inline void believe(report::EpisodeTick& tick, const SyntheticWorld& world, RandomStream& random) {
  std::normal_distribution<double> noise;
  tick.true_pose = world.robot;
  tick.true_ball = {world.ball.x(), world.ball.y(), 0.11};
  const bool stale = tick.time_s >= 1.5 && tick.time_s < 2.0;
  tick.status = stale ? "stale_pose" : "ok";
  tick.measured_pose = noise(random) < 1.3;
  tick.measured_ball = tick.time_s < 3.0 || tick.time_s > 4.0;
  if (!stale) {
    tick.pose = Pose2{world.robot.x + 0.025 * noise(random), world.robot.y + 0.03 * noise(random),
                      world.robot.beta + 0.02 * noise(random)};
  }
  const double sigma = tick.measured_ball ? 0.012 : 0.03 + 0.1 * (tick.time_s - 3.0);
  tick.ball = Eigen::Vector2d(world.ball.x() + sigma * noise(random), world.ball.y() + sigma * noise(random));
}

inline std::vector<double> signals(const std::string& contender, const SyntheticWorld& world) {
  const Eigen::Vector2d to_ball = world.ball - world.robot.translation();
  const Eigen::Vector2d shot = kGoal - world.ball;
  const double misalignment = turn(std::atan2(shot.y(), shot.x()), std::atan2(to_ball.y(), to_ball.x()));
  if (contender == "fuzzy") {
    const double shoot = std::exp(-std::pow(misalignment / 0.3, 2));
    const double near = 1.0 / (1.0 + std::exp(8.0 * (to_ball.norm() - 0.8)));
    return {1.0 - near, near * (1.0 - shoot), shoot * near};
  }
  return {to_ball.x(), to_ball.y() - 0.4, degrees(misalignment)};
}

// 200 ticks, with a view at every 20th.
inline report::Episode synthetic_episode(const std::string& contender, std::uint64_t seed,
                                         const report::EncodedImage& picture) {
  RandomStream start = make_stream(seed, 0);
  RandomStream random = make_stream(seed, contender.size());
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  SyntheticWorld world;
  world.robot = {place(start), place(start) - 0.3, 2.6 * place(start)};
  world.ball = {place(start), place(start)};
  const bool fuzzy = contender == "fuzzy";
  report::Episode episode;
  episode.contender = contender;
  episode.seed = seed;
  episode.outcome = "timeout";
  episode.duration_s = 200 * kTick_s;
  episode.signal_names = fuzzy ? std::vector<std::string>{"approach", "go behind", "shoot"}
                               : std::vector<std::string>{"e_x", "e_y", "e_direction"};
  episode.signal_units = fuzzy ? std::vector<std::string>(3, "") : std::vector<std::string>{"m", "m", "°"};
  for (int i = 0; i < 200 && episode.outcome == "timeout"; ++i) {
    report::EpisodeTick tick = command(world, fuzzy ? 1.2 : 0.9);
    tick.time_s = i * kTick_s;
    believe(tick, world, random);
    if (tick.pose) {
      tick.signals = signals(contender, world);
    } else {
      tick.vx = tick.vy = tick.omega = 0.0;
    }
    tick.kick = tick.kick && tick.pose && world.ball_velocity.norm() < 0.1;
    if (tick.kick) ++episode.kicks;
    move(world, tick, 0.03 * place(random));
    if (i % 20 == 0) episode.views.push_back({tick.time_s, {picture, picture, picture}});
    if (world.ball.y() > kGoal.y()) {
      episode.outcome = std::abs(world.ball.x()) < 0.5 ? "goal" : "ball_out";
      episode.duration_s = tick.time_s;
    }
    episode.ticks.push_back(std::move(tick));
  }
  return episode;
}

// Episodes of every contender from the seeds 1…starts, and what summaries would say of 24.
inline report::EpisodePage synthetic_page(const std::vector<std::string>& contenders, int starts,
                                          const report::EncodedImage& picture) {
  report::EpisodePage page;
  page.title = "Approach and shoot";
  page.version = "1.2.3";
  page.command = "movis experiment approach-and-shoot";
  page.field = paper_field();
  page.robot_radius = 0.25;
  page.ball_radius = 0.11;
  page.obstacles = {{{-1.0, 1.2}, 0.2}};
  page.camera_names = {"M1", "M2", "M3"};
  for (const std::string& contender : contenders) {
    // 18 of 24 with the Wilson interval 0.5510…0.8800
    page.summaries.push_back(
        {contender, 24, 18, 0.551, 0.88, {{"goal", 18}, {"ball_out", 4}, {"timeout", 2}}, 4.25, 0.0312, 0.0205});
  }
  for (int seed = 1; seed <= starts; ++seed) {
    for (const std::string& contender : contenders) {
      page.episodes.push_back(synthetic_episode(contender, static_cast<std::uint64_t>(seed), picture));
    }
  }
  return page;
}

}  // namespace movis::test
