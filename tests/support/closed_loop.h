#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "movis/control/drive.h"
#include "movis/core/bearing.h"
#include "movis/sim/episode.h"
#include "movis/world/world.h"

namespace movis::test {

// Standard deviations of what stands in for the pipeline's measurements; coarser than the pipeline's.
struct MeasurementNoise {
  double position = 0.03;          // metres
  double heading = radians(0.5);   // of the robot
  double ball = 0.01;              // metres, times 1 + distance / 1 m
  double bearing = radians(0.05);  // of azimuths, elevations and edges
};

struct ClosedLoopTick {
  sim::State truth;  // at the time of the images
  world::World world;
  control::Command command;
  control::DriveStatus status;
};

struct ClosedLoopRun {
  sim::Outcome outcome;
  double time_s = 0.0;
  int kicks = 0;
  std::vector<ClosedLoopTick> trace;
};

// Draws measurements of a true state.
class MeasuredTruth {
 public:
  MeasuredTruth(const MeasurementNoise& sigma, RandomStream random) : sigma_(sigma), random_(random) {}

  Fix fix(const sim::State& truth) {
    const Pose2& pose = truth.world_from_robot;
    const double x = noisy(pose.x, sigma_.position);
    const double y = noisy(pose.y, sigma_.position);
    Fix fix;
    fix.status = FixStatus::ok;
    fix.world_from_robot = {x, y, wrap_angle(noisy(pose.beta, sigma_.heading))};
    fix.covariance.diagonal() << square(sigma_.position), square(sigma_.position), square(sigma_.heading);
    return fix;
  }

  PointEstimate ball_in_robot(const sim::State& truth) {
    const Eigen::Vector3d ball = to_robot(truth, truth.ball_in_field);
    const double sigma = sigma_.ball * (1.0 + ball.head<2>().norm());
    const double x = noisy(ball.x(), sigma);
    const double y = noisy(ball.y(), sigma);
    PointEstimate estimate;
    estimate.status = PointStatus::ok;
    estimate.point = {x, y, ball.z()};
    estimate.covariance.diagonal().setConstant(square(sigma));
    return estimate;
  }

  // From every camera: the ball, and the goals' outer edges on their lines. Nothing hides anything.
  std::vector<Bearing> bearings(const sim::Scenario& scenario, const sim::State& truth) {
    std::vector<Bearing> bearings;
    for (std::size_t i = 0; i < scenario.rig.cameras.size(); ++i) {
      const Eigen::Vector3d& eye = scenario.rig.cameras[i].position;
      const Eigen::Vector3d ball = to_robot(truth, truth.ball_in_field) - eye;
      const double half_extent = std::asin(std::min(1.0, sim::kBallRadius / ball.head<2>().norm()));
      bearings.push_back(bearing(static_cast<int>(i), ObjectClass::ball, truth.time_s, ball));
      set_edges(bearings.back(), azimuth(ball) + half_extent, azimuth(ball) - half_extent);
      if (!scenario.arena.field) continue;
      const Field& field = *scenario.arena.field;
      for (const double side : {1.0, -1.0}) {  // yellow, blue; seen from the field, the left edge is at −side
        const double outer = side * (field.Fw + field.goal_thickness);
        const auto seen = [&](double x) -> Eigen::Vector3d {
          return to_robot(truth, {x, side * field.Fd, field.goal_height / 2.0}) - eye;
        };
        const ObjectClass goal = side > 0.0 ? ObjectClass::yellow_goal : ObjectClass::blue_goal;
        bearings.push_back(bearing(static_cast<int>(i), goal, truth.time_s, seen(0.0)));
        set_edges(bearings.back(), azimuth(seen(-outer)), azimuth(seen(outer)));
      }
    }
    return bearings;
  }

 private:
  static double square(double value) { return value * value; }
  static double azimuth(const Eigen::Vector3d& ray) { return std::atan2(ray.y(), ray.x()); }
  static Eigen::Vector3d to_robot(const sim::State& truth, const Eigen::Vector3d& in_field) {
    const Eigen::Vector2d floor = inverse(truth.world_from_robot) * Eigen::Vector2d(in_field.head<2>());
    return {floor.x(), floor.y(), in_field.z()};
  }

  double noisy(double value, double sigma) { return value + sigma * normal_(random_); }

  Bearing bearing(int camera, ObjectClass object, double time_s, const Eigen::Vector3d& ray) {
    Bearing bearing;
    bearing.camera = camera;
    bearing.object = object;
    bearing.azimuth = wrap_angle(noisy(azimuth(ray), sigma_.bearing));
    bearing.elevation = noisy(std::atan2(ray.z(), ray.head<2>().norm()), sigma_.bearing);
    bearing.covariance.diagonal().setConstant(square(sigma_.bearing));
    bearing.weight = 100.0;
    bearing.time_s = time_s;
    return bearing;
  }

  void set_edges(Bearing& bearing, double left, double right) {
    bearing.left = wrap_angle(noisy(left, sigma_.bearing));
    bearing.right = wrap_angle(noisy(right, sigma_.bearing));
    bearing.left_variance = bearing.right_variance = square(sigma_.bearing);
  }

  MeasurementNoise sigma_;
  RandomStream random_;
  std::normal_distribution<double> normal_;
};

// Plays an episode with a controller in closed loop, much faster than with images: what the pipeline would measure is
// the truth with noise. Only tests may use the truth that way, to tell a controller's faults from those of the images;
// results are made with images.
inline ClosedLoopRun run_without_images(const sim::Scenario& scenario, control::Controller& controller,
                                        std::uint64_t seed, const MeasurementNoise& sigma = {}) {
  constexpr std::uint64_t kMeasurementStream = 100;
  MeasuredTruth measured(sigma, make_stream(seed, kMeasurementStream));
  sim::Episode episode(scenario, seed);
  control::Drive drive(scenario.robot, {});
  drive.start(0.0);
  controller.start();
  world::World world;
  ClosedLoopRun run{};
  do {
    const sim::State truth = episode.truth();
    const Fix fix = measured.fix(truth);
    const PointEstimate ball = measured.ball_in_robot(truth);
    world = world::updated(world, truth.time_s, drive.motion(world.time_s, truth.time_s), fix, ball);
    const control::Command command = drive.step(controller, measured.bearings(scenario, truth), world);
    episode.send(command);
    run.trace.push_back({truth, world, command, drive.status()});
  } while (episode.advance());
  run.outcome = *episode.outcome();
  run.time_s = episode.truth().time_s;
  run.kicks = episode.kicks();
  return run;
}

}  // namespace movis::test
