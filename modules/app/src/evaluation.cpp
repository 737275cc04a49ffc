#include "evaluation.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
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

// A table of more labels would be none to read.
constexpr std::size_t kMostLabels = 20;

constexpr const char* kPoseHeader =
    "  spot     ok  of   mean cm    max cm  |X| mean  |Y| mean  |β| mean°  |β| max°    NEES/3\n";

std::string pose_line(const std::string& label, int frames, const std::vector<PoseError>& errors) {
  const std::string head = fmt::format("  {:<6}{:>5}{:>4}", label, errors.size(), frames);
  if (errors.empty()) return head + "\n";
  const Magnitude position = magnitude(errors, [](const PoseError& e) { return std::hypot(e.x, e.y); });
  const Magnitude x = magnitude(errors, [](const PoseError& e) { return e.x; });
  const Magnitude y = magnitude(errors, [](const PoseError& e) { return e.y; });
  const Magnitude beta = magnitude(errors, [](const PoseError& e) { return e.beta; });
  const Magnitude nees = magnitude(errors, [](const PoseError& e) { return e.nees; });
  return fmt::format("{}{:>10.2f}{:>10.2f}{:>10.2f}{:>10.2f}{:>11.3f}{:>10.3f}{:>10.2f}\n", head, 100.0 * position.mean,
                     100.0 * position.max, 100.0 * x.mean, 100.0 * y.mean, degrees(beta.mean), degrees(beta.max),
                     nees.mean);
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

PoseError pose_error(const Fix& measured, const grab::Truth& truth) {
  const Fix fix = nearer_half(measured, truth.world_from_robot);
  const Eigen::Vector3d error(fix.world_from_robot.x - truth.world_from_robot.x,
                              fix.world_from_robot.y - truth.world_from_robot.y,
                              turn(truth.world_from_robot.beta, fix.world_from_robot.beta));
  return {error.x(), error.y(), error.z(), error.dot(fix.covariance.ldlt().solve(error)) / 3.0};
}

void Evaluation::add(const pipeline::Estimate& estimate, const grab::Truth& truth) {
  ++frames_;
  if (estimate.ball_in_robot.status == PointStatus::ok) {
    balls_.push_back(ball_error(estimate.ball_in_robot.point.head<2>(), truth));
  }
  if (estimate.fix.status != FixStatus::no_field) ++poses_sought_;
  Poses& poses = poses_[truth.label];
  ++poses.frames;
  symmetric_ = symmetric_ || estimate.fix.symmetric;
  if (estimate.fix.status == FixStatus::ok) poses.errors.push_back(pose_error(estimate.fix, truth));
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
  std::vector<PoseError> all;
  for (const auto& [label, poses] : poses_) all.insert(all.end(), poses.errors.begin(), poses.errors.end());
  fmt::format_to(out, "  pose: {} of {} found{}\n", all.size(), frames_,
                 symmetric_ ? "; of two that are half a turn apart, the nearer one" : "");
  if (all.empty()) return text;
  text += kPoseHeader;
  if (poses_.size() > 1 && poses_.size() <= kMostLabels) {
    for (const auto& [label, poses] : poses_)
      text += pose_line(label.empty() ? "-" : label, poses.frames, poses.errors);
  }
  return text + pose_line("all", frames_, all);
}

}  // namespace movis::app
