#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "movis/calibration/sightings.h"
#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/core/random.h"
#include "movis/omni/deviation.h"
#include "movis/scan/colours.h"
#include "movis/sim/renderer.h"
#include "movis/triangulation/joint.h"

// Rigs as they might be built, what they see on rendered images with sensor noise, and how well they measure.
namespace movis::test {

using Eigen::Vector2d;
using Eigen::Vector3d;

inline omni::Rig nominal_rig() {
  return omni::read_rig(data_file("rigs/movis.yaml"));
}

inline double uniform(RandomStream& random, double min, double max) {
  return std::uniform_real_distribution<double>(min, max)(random);
}

// A ball on a floor of 8 m × 8 m, not under the robot at its middle.
inline Vector3d draw_ball(RandomStream& random) {
  constexpr double kNearest = 0.45;
  for (;;) {
    const Vector3d ball(uniform(random, -4.0, 4.0), uniform(random, -4.0, 4.0), sim::kBallRadius);
    if (ball.head<2>().norm() > kNearest) return ball;
  }
}

inline std::vector<sim::State> balls_around(int count, RandomStream& random) {
  std::vector<sim::State> states;
  for (int i = 0; i < count; ++i) states.push_back({0.0, {}, draw_ball(random)});
  return states;
}

// Robot and ball anywhere on a field, clear of each other, of lines and goals.
inline std::vector<sim::State> states_on_field(const Field& field, int count, RandomStream& random) {
  constexpr double kMargin = 0.3;
  std::vector<sim::State> states;
  while (static_cast<int>(states.size()) < count) {
    const auto place = [&] {
      return Vector2d(uniform(random, kMargin - field.half_width, field.half_width - kMargin),
                      uniform(random, kMargin - field.half_length, field.half_length - kMargin));
    };
    const Vector2d robot = place();
    const Vector2d ball = place();
    const double beta = uniform(random, -kPi, kPi);
    if ((robot - ball).norm() < 0.5) continue;
    states.push_back({0.0, {robot.x(), robot.y(), beta}, {ball.x(), ball.y(), sim::kBallRadius}});
  }
  return states;
}

inline Vector3d ball_in_robot(const sim::State& state) {
  const Vector2d place = inverse(state.world_from_robot) * Vector2d(state.ball_in_field.head<2>());
  return {place.x(), place.y(), state.ball_in_field.z()};
}

// Images of all states through a rig, as a camera with the shipped look's noise takes them.
class RenderedSet {
 public:
  RenderedSet(const omni::Rig& true_rig, const std::optional<Field>& field, std::vector<sim::State> states,
              std::uint64_t seed)
      : states_(std::move(states)), images_(states_.size()) {
    sim::Arena arena;
    arena.field = field;
    sim::Renderer renderer(true_rig, arena, control::read_robot(data_file("robots/miniature.yaml")),
                           sim::read_look(data_file("looks/hall.yaml")));
    for (std::size_t i = 0; i < states_.size(); ++i) {
      renderer.render(states_[i], 1000 * seed + i, images_[i]);
      images_[i].index = static_cast<std::int64_t>(i);
    }
  }

  // What is seen where a rig is believed.
  calibration::Sightings sightings(const omni::Rig& believed, bool places_known) const {
    calibration::SightingScanner scanner(believed, scan::read_colours(data_file("colours/default.yaml")), {});
    calibration::Sightings sightings{believed, {}};
    for (std::size_t i = 0; i < images_.size(); ++i) {
      sightings.frames.push_back(scanner.scan(images_[i]));
      if (places_known) sightings.frames.back().ball_in_robot = ball_in_robot(states_[i]);
    }
    return sightings;
  }

  const std::vector<sim::State>& states() const { return states_; }
  const std::vector<grab::FrameSet>& images() const { return images_; }

 private:
  std::vector<sim::State> states_;
  std::vector<grab::FrameSet> images_;
};

struct Measured {
  std::vector<Vector2d> estimates, truths;  // of the balls that were measured, robot frame
  int missed = 0;
};

inline Measured measure(const omni::Rig& believed, const RenderedSet& set) {
  Measured result;
  const calibration::Sightings sightings = set.sightings(believed, true);
  for (const calibration::Sighting& sighting : sightings.frames) {
    const PointEstimate ball = triangulation::triangulate_joint(believed, sighting.bearings, ObjectClass::ball);
    if (ball.status != PointStatus::ok) {
      ++result.missed;
      continue;
    }
    result.estimates.emplace_back(ball.point.head<2>());
    result.truths.emplace_back(sighting.ball_in_robot->head<2>());
  }
  return result;
}

// Mean absolute error of the distance from the robot, metres.
inline double distance_error(const Measured& measured) {
  double sum = 0.0;
  for (std::size_t i = 0; i < measured.truths.size(); ++i) {
    sum += std::abs(measured.estimates[i].norm() - measured.truths[i].norm());
  }
  return sum / static_cast<double>(measured.truths.size());
}

// The same after the best turn and shift of all estimates together: a rig's planar gauge.
inline Measured without_gauge(Measured measured) {
  const auto count = static_cast<double>(measured.truths.size());
  Vector2d estimate_mean = Vector2d::Zero(), truth_mean = Vector2d::Zero();
  for (std::size_t i = 0; i < measured.truths.size(); ++i) {
    estimate_mean += measured.estimates[i] / count;
    truth_mean += measured.truths[i] / count;
  }
  double along = 0.0, across = 0.0;
  for (std::size_t i = 0; i < measured.truths.size(); ++i) {
    const Vector2d a = measured.estimates[i] - estimate_mean;
    const Vector2d b = measured.truths[i] - truth_mean;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Pose2 turned{0.0, 0.0, std::atan2(across, along)};
  for (Vector2d& estimate : measured.estimates) estimate = turned * Vector2d(estimate - estimate_mean) + truth_mean;
  return measured;
}

}  // namespace movis::test
