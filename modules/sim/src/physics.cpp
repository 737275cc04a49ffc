#include "movis/sim/physics.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "contact_plane.h"
#include "movis/control/limits.h"
#include "movis/core/error.h"

namespace movis::sim {
namespace {

constexpr double kGravity = 9.81;      // m/s²
constexpr double kLeastRebound = 0.1;  // m/s; a ball that leaves the floor more slowly rises less than 1 mm: it stays
constexpr double kSpinTime = 0.2;  // s, in which the floor takes away all but 1/e of a ball's spin about the vertical

Eigen::Vector2d rotated(const Eigen::Vector2d& vector, double angle) {
  return Pose2{0.0, 0.0, angle} * vector;
}

Twist2 mean(const Twist2& a, const Twist2& b) {
  return {0.5 * (a.vx + b.vx), 0.5 * (a.vy + b.vy), 0.5 * (a.omega + b.omega)};
}

Eigen::Vector2d slowed(const Eigen::Vector2d& velocity, double by) {
  const double speed = velocity.norm();
  return speed > by ? Eigen::Vector2d(velocity * (1.0 - by / speed)) : Eigen::Vector2d::Zero();
}

// Even deceleration over a substep in which the ball may come to rest.
struct Roll {
  Eigen::Vector2d mean;  // velocity; exact for the distance
  double last_loss;      // of speed, from that mean to the end
};

Roll roll(const Eigen::Vector2d& velocity, double deceleration, double seconds) {
  const double speed = velocity.norm();
  const double loss = deceleration * seconds;
  if (speed > loss) return {slowed(velocity, 0.5 * loss), 0.5 * loss};
  if (speed <= 0.0) return {Eigen::Vector2d::Zero(), 0.0};
  const double mean_speed = 0.5 * speed * speed / loss;  // it rolls speed² / (2·deceleration), then rests
  return {velocity * (mean_speed / speed), mean_speed};
}

}  // namespace

PhysicsOptions read_physics_options(const YamlMap& map) {
  map.allow({"substep_s", "ball_mass", "rolling_deceleration", "ball_restitution", "contact_friction"});
  PhysicsOptions options;
  map.read_number("substep_s", {1e-4, 1.0 / 480.0}, options.substep_s);  // longer ones let a fast ball sink into hulls
  map.read_number("ball_mass", {0.01, 10.0}, options.ball_mass);
  map.read_number("rolling_deceleration", {0.0, 10.0}, options.rolling_deceleration);
  map.read_number("ball_restitution", {0.0, 1.0}, options.ball_restitution);
  map.read_number("contact_friction", {0.0, 2.0}, options.contact_friction);
  return options;
}

struct Physics::Box {
  Arena arena;
  control::RobotModel robot;
  PhysicsOptions options;
  RandomStream actuator_random;
  RandomStream kick_random;  // of its own, so that the n-th kicks of two players scatter alike
  std::normal_distribution<double> actuator_noise, kick_noise;

  std::unique_ptr<ContactPlane> contacts;
  State state;
  Twist2 twist;                                             // of the robot, robot frame
  Eigen::Vector3d ball_velocity = Eigen::Vector3d::Zero();  // field frame
  double ball_spin = 0.0;                                   // about the vertical, rad/s
  double charged_s = 0.0;                                   // when the kicker is ready again
  int kicks = 0;

  double ball_bottom() const { return state.ball_in_field.z() - kBallRadius; }
  bool flying() const { return ball_bottom() > 0.0 || ball_velocity.z() > 0.0; }

  Twist2 with_noise(const Twist2& velocity) {
    const auto factor = [&] { return 1.0 + robot.actuator_sigma * actuator_noise(actuator_random); };
    const double x = factor(), y = factor(), turn = factor();
    return {velocity.vx * x, velocity.vy * y, velocity.omega * turn};
  }

  bool within_reach() const;
  void kick();
  void fly(double seconds);
  void substep(const Twist2& wanted, double seconds);
};

bool Physics::Box::within_reach() const {
  if (flying()) return false;
  const Eigen::Vector2d ball = state.ball_in_field.head<2>();
  return control::kicker_reaches(robot, inverse(state.world_from_robot) * ball, kBallRadius);
}

void Physics::Box::kick() {
  const control::Kicker& kicker = robot.kicker;
  const double speed = std::max(0.0, kicker.speed * (1.0 + kicker.speed_sigma * kick_noise(kick_random)));
  const double scatter = kicker.direction_sigma * kick_noise(kick_random);
  const Eigen::Vector2d direction_in_robot(-std::sin(scatter), std::cos(scatter));
  const double along = speed * std::cos(kicker.lift) + twist.translation().dot(direction_in_robot);
  ball_velocity.head<2>() = along * rotated(direction_in_robot, state.world_from_robot.beta);
  ball_velocity.z() = speed * std::sin(kicker.lift);
  ball_spin = 0.0;
  charged_s = state.time_s + kKickerRecharge;
  ++kicks;
}

// Ballistic, exact over every bounce.
void Physics::Box::fly(double seconds) {
  double height = ball_bottom();
  double& rising = ball_velocity.z();
  while (seconds > 0.0 && flying()) {
    const double landing = (rising + std::sqrt(rising * rising + 2.0 * kGravity * height)) / kGravity;
    if (landing > seconds) {
      height += (rising - 0.5 * kGravity * seconds) * seconds;
      rising -= kGravity * seconds;
      break;
    }
    seconds -= landing;
    height = 0.0;
    rising = options.ball_restitution * (kGravity * landing - rising);
    if (rising < kLeastRebound) rising = 0.0;
    state.ball_in_field.z() = kBallRadius;
  }
  state.ball_in_field.z() = kBallRadius + height;
}

// Velocities that change evenly are replaced by their mean over the substep, for which Box2D's step is exact; contacts
// then add their change.
void Physics::Box::substep(const Twist2& wanted, double seconds) {
  const Pose2& pose = state.world_from_robot;
  const Twist2 next = control::limited(wanted, twist, robot, seconds);
  const Pose2 free_pose = pose * start_from_end(mean(twist, next), seconds);
  const Disc robot_disc{pose.translation(), pose.beta, (free_pose.translation() - pose.translation()) / seconds,
                        turn(pose.beta, free_pose.beta) / seconds};
  const Eigen::Vector2d ball_position = state.ball_in_field.head<2>();
  const Roll rolling = roll(ball_velocity.head<2>(), flying() ? 0.0 : options.rolling_deceleration, seconds);
  const Disc ball_disc{ball_position, 0.0, rolling.mean, ball_spin};

  const ContactPlane::Touched touched = contacts->step(robot_disc, ball_disc, ball_bottom(), seconds);

  twist = next;
  state.world_from_robot = free_pose;
  if (touched.robot) {
    state.world_from_robot = {touched.robot->position.x(), touched.robot->position.y(),
                              wrap_angle(touched.robot->angle)};
    const Eigen::Vector2d push = rotated(touched.robot->velocity - robot_disc.velocity, -state.world_from_robot.beta);
    twist = {next.vx + push.x(), next.vy + push.y(), next.omega + touched.robot->rate - robot_disc.rate};
  }
  const Disc ball = touched.ball.value_or(Disc{ball_position + rolling.mean * seconds, 0.0, rolling.mean, ball_spin});
  state.ball_in_field.head<2>() = ball.position;
  ball_velocity.head<2>() = slowed(ball.velocity, rolling.last_loss);
  ball_spin = ball.rate * std::exp(-seconds / kSpinTime);
  fly(seconds);
}

Physics::Physics(const Arena& arena, const control::RobotModel& robot, const PhysicsOptions& options,
                 RandomStream random)
    : box_(std::make_unique<Box>()) {
  box_->arena = arena;
  box_->robot = robot;
  box_->options = options;
  box_->kick_random = RandomStream(random());
  box_->actuator_random = random;
  State state;
  state.ball_in_field = {0.0, robot.radius + 1.0, kBallRadius};
  place(state);
}

Physics::~Physics() = default;
Physics::Physics(Physics&&) noexcept = default;
Physics& Physics::operator=(Physics&&) noexcept = default;

void Physics::place(const State& state) {
  box_->contacts = std::make_unique<ContactPlane>(box_->arena, box_->robot, box_->options);  // with no past
  box_->state = state;
  box_->state.ball_in_field.z() = std::max(state.ball_in_field.z(), kBallRadius);
  box_->twist = {};
  box_->ball_velocity.setZero();
  box_->ball_spin = 0.0;
  box_->charged_s = state.time_s;
  box_->kicks = 0;
}

void Physics::set_ball_velocity(const Eigen::Vector3d& in_field) {
  box_->ball_velocity = in_field;
}

void Physics::step(const control::Command& command, double seconds, const std::function<bool(const State&)>& over) {
  const Twist2& velocity = command.velocity;
  if (!std::isfinite(velocity.vx) || !std::isfinite(velocity.vy) || !std::isfinite(velocity.omega)) {
    throw Error("the simulated robot is given a velocity that is not finite; mend the controller that computed it");
  }
  const Twist2 wanted = box_->with_noise(velocity);
  const int substeps = std::max(1, static_cast<int>(std::ceil(seconds / box_->options.substep_s - 1e-6)));
  const double start_s = box_->state.time_s;
  bool armed = command.kick;
  for (int i = 1; i <= substeps; ++i) {
    if (armed && box_->state.time_s >= box_->charged_s && box_->within_reach()) {
      box_->kick();
      armed = false;
    }
    box_->substep(wanted, seconds / substeps);
    box_->state.time_s = start_s + seconds * i / substeps;
    if (over && over(box_->state)) return;
  }
}

const State& Physics::state() const {
  return box_->state;
}

Twist2 Physics::robot_velocity() const {
  return box_->twist;
}

Eigen::Vector3d Physics::ball_velocity() const {
  return box_->ball_velocity;
}

int Physics::kicks() const {
  return box_->kicks;
}

}  // namespace movis::sim
