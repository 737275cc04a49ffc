#include "movis/servo/position_based.h"

#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>

#include <cmath>
#include <limits>
#include <utility>

#include "movis/core/error.h"
#include "movis/servo/planar_task.h"
#include "movis/servo/way_round.h"
#include "visp_frames.h"

namespace movis::servo {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr double kRoom = 0.02;  // metres between the hull and a goal's walls

// How far the detour may grow beyond half a turn before the other way round is taken: noise alone must not send the
// robot to and fro on the far side of the ball.
constexpr double kChangeOfMind = radians(30.0);

bool finite(const world::World& world) {
  const Pose2& pose = world.world_from_robot;
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.beta) && world.ball_in_robot.allFinite();
}

// From a ball on the goal's centre no direction leads to it: the shot then goes straight up the field.
Pose2 robot_from_shot(const world::World& world, const control::Percepts& percepts) {
  const Eigen::Vector2d& ball = percepts.ball_in_robot;
  const Eigen::Vector2d shot = percepts.target_in_robot - ball;
  const double heading = shot.isZero(1e-9) ? -world.world_from_robot.beta : std::atan2(-shot.x(), shot.y());
  return {ball.x(), ball.y(), heading};
}

// The detour on the side on which the robot already goes round.
double same_side(double detour, double last) {
  const double unwrapped = last + turn(last, detour);
  return std::abs(unwrapped) > kPi + kChangeOfMind ? detour : unwrapped;
}

WayRound way_round(const control::Task& task, const PbvsOptions& options) {
  const double contact = task.robot.radius + task.ball_radius;
  return {contact + options.gap, contact + options.clearance, options.lead};
}

}  // namespace

struct PositionBased::Servo {
  explicit Servo(const PbvsOptions& options)
      : task(vpServo::CURRENT, vpAdaptiveGain(options.gain_at_zero, options.gain_at_infinity, options.gain_slope)) {
    task.add(position, position_desired, vpFeatureTranslation::selectTx() | vpFeatureTranslation::selectTy());
    task.add(heading, heading_desired, vpFeatureThetaU::selectTUz());
  }

  Twist2 velocity(const Pose2& desired_from_robot) {
    const vpHomogeneousMatrix cdMc = visp_from(desired_from_robot);
    position.buildFrom(cdMc);
    heading.buildFrom(cdMc);
    return task.velocity();
  }

  vpFeatureTranslation position{vpFeatureTranslation::cdMc}, position_desired{vpFeatureTranslation::cdMc};
  vpFeatureThetaU heading{vpFeatureThetaU::cdRc}, heading_desired{vpFeatureThetaU::cdRc};
  PlanarTask task;  // last: it refers to the features
};

PositionBased::PositionBased(control::Task task, const PbvsOptions& options)
    : task_(std::move(task)),
      options_(options),
      servo_(std::make_unique<Servo>(options)),
      signals_{{"e_x", "m", 0.0}, {"e_y", "m", 0.0}, {"e_theta", "°", 0.0}, {"detour", "°", 0.0}} {
  const double standoff = task_.robot.radius + task_.ball_radius + options_.gap;
  if (standoff <= 0.0) {
    throw Error("pbvs: a gap of {} m puts a robot of radius {} m beyond the ball's centre; make gap larger",
                options_.gap, task_.robot.radius);
  }
}

PositionBased::~PositionBased() = default;

void PositionBased::start() {
  detour_ = 0.0;
  for (control::Signal& signal : signals_) signal.value = 0.0;
}

control::Command PositionBased::step(const control::Observation& observation) {
  if (!finite(observation.world)) return {{kNaN, kNaN, kNaN}, false};
  const Pose2& field_from_robot = observation.world.world_from_robot;
  const Pose2 field_from_shot =
      field_from_robot * robot_from_shot(observation.world, control::perceive(observation, task_));
  const Eigen::Vector2d robot_in_shot = inverse(field_from_shot) * field_from_robot.translation();
  detour_ = same_side(detour_of(robot_in_shot), detour_);

  const Eigen::Vector2d waypoint = waypoint_in_shot(way_round(task_, options_), robot_in_shot.norm(), detour_);
  const Eigen::Vector2d place = clear_of_goals(field_from_shot * waypoint, task_.field, task_.robot.radius + kRoom);
  const Pose2 field_from_desired{place.x(), place.y(), field_from_shot.beta};
  const Twist2 velocity = servo_->velocity(inverse(field_from_desired) * field_from_robot);

  signals_[0].value = servo_->task.error(0);
  signals_[1].value = servo_->task.error(1);
  signals_[2].value = degrees(servo_->task.error(2));
  signals_[3].value = degrees(detour_);
  return {velocity, control::should_kick(observation, task_)};
}

}  // namespace movis::servo
