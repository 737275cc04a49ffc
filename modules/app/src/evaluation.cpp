#include "evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "movis/core/angle.h"

namespace movis::app {
namespace {

// Mean and largest magnitude of one quantity over many errors.
struct Magnitude {
  double mean = 0.0;
  double max = 0.0;
};

template <typename Errors, typename Quantity>
Magnitude magnitude(const Errors& errors, Quantity quantity) {
  Magnitude result;
  for (const auto& error : errors) {
    const double value = std::abs(quantity(error));
    result.mean += value / static_cast<double>(errors.size());
    result.max = std::max(result.max, value);
  }
  return result;
}

std::string pose_line(const std::string& label, const std::vector<PoseError>& errors) {
  const Magnitude position = magnitude(errors, [](const PoseError& e) { return std::hypot(e.x, e.y); });
  const Magnitude x = magnitude(errors, [](const PoseError& e) { return e.x; });
  const Magnitude y = magnitude(errors, [](const PoseError& e) { return e.y; });
  const Magnitude beta = magnitude(errors, [](const PoseError& e) { return e.beta; });
  return fmt::format("  {:<8}{:>5}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>11.3f}\n", label, errors.size(),
                     100.0 * position.mean, 100.0 * position.max, 100.0 * x.mean, 100.0 * y.mean, degrees(beta.mean));
}

}  // namespace

Eigen::Vector2d true_ball_in_robot(const grab::Truth& truth) {
  return inverse(truth.world_from_robot) * Eigen::Vector2d(truth.ball_in_field.head<2>());
}

BallError ball_error(const Eigen::Vector2d& ball_in_robot, const grab::Truth& truth) {
  const Eigen::Vector2d expected = true_ball_in_robot(truth);
  return {ball_in_robot.norm() - expected.norm(),
          turn(std::atan2(expected.y(), expected.x()), std::atan2(ball_in_robot.y(), ball_in_robot.x())),
          (ball_in_robot - expected).norm()};
}

PoseError pose_error(const Pose2& world_from_robot, const grab::Truth& truth) {
  return {world_from_robot.x - truth.world_from_robot.x, world_from_robot.y - truth.world_from_robot.y,
          turn(truth.world_from_robot.beta, world_from_robot.beta)};
}

void Evaluation::add(const pipeline::Estimate& estimate, const grab::Truth& truth) {
  ++frames_;
  if (estimate.ball_in_robot.status == PointStatus::ok) {
    balls_.push_back(ball_error(estimate.ball_in_robot.point.head<2>(), truth));
  }
  if (estimate.fix.status != FixStatus::no_field) ++poses_sought_;
  if (estimate.fix.status == FixStatus::ok) {
    poses_.push_back({truth.label, pose_error(estimate.fix.world_from_robot, truth)});
  }
}

std::string Evaluation::table() const {
  std::string text;
  auto out = std::back_inserter(text);
  fmt::format_to(out, "against truth.csv\n  ball: {} of {} found", balls_.size(), frames_);
  if (!balls_.empty()) {
    const Magnitude distance = magnitude(balls_, [](const BallError& e) { return e.distance; });
    const Magnitude direction = magnitude(balls_, [](const BallError& e) { return e.direction; });
    const Magnitude position = magnitude(balls_, [](const BallError& e) { return e.position; });
    fmt::format_to(
        out,
        "\n            mean |error|   largest\n"
        "  distance  {:>9.3f} cm{:>9.3f} cm\n  direction {:>9.4f}° {:>9.4f}°\n  position  {:>9.3f} cm{:>9.3f} cm",
        100.0 * distance.mean, 100.0 * distance.max, degrees(direction.mean), degrees(direction.max),
        100.0 * position.mean, 100.0 * position.max);
  }
  fmt::format_to(out, "\n");
  if (poses_sought_ == 0) return text;
  fmt::format_to(out, "  pose: {} of {} found\n", poses_.size(), frames_);
  if (poses_.empty()) return text;
  fmt::format_to(out, "  spot        n   mean cm    max cm  |X| mean  |Y| mean  |β| mean°\n");
  std::map<std::string, std::vector<PoseError>> by_label;
  std::vector<PoseError> all;
  for (const LabelledPose& pose : poses_) {
    by_label[pose.label].push_back(pose.error);
    all.push_back(pose.error);
  }
  if (by_label.size() > 1 || by_label.count("") == 0) {
    for (const auto& [label, errors] : by_label) text += pose_line(label.empty() ? "-" : label, errors);
  }
  return text + pose_line("all", all);
}

}  // namespace movis::app
