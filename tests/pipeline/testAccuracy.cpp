// How well the whole data path measures on images that an independent ray tracer made, against their truth. The bounds
// are what the project promises, not what it reaches; docs/accuracy.md has the figures.
#include <gtest/gtest.h>

#include <cmath>

#include "movis/core/angle.h"
#include "pipeline/tracked.h"
#include "support/degrade.h"
#include "support/shared_data.h"

namespace movis {
namespace {

using test::Tracked;

struct BallSummary {
  std::size_t found = 0;
  double mean_distance = 0.0, mean_direction = 0.0;  // magnitudes, metres and radians
  double largest_position = 0.0;
};

BallSummary summarize_balls(const std::vector<Tracked>& tracked) {
  BallSummary summary;
  for (const Tracked& t : tracked) {
    if (t.estimate.ball_in_robot.status != PointStatus::ok) continue;
    const Eigen::Vector2d measured = t.estimate.ball_in_robot.point.head<2>();
    const Eigen::Vector2d expected =
        inverse(t.truth.world_from_robot) * Eigen::Vector2d(t.truth.ball_in_field.head<2>());
    ++summary.found;
    summary.mean_distance += std::abs(measured.norm() - expected.norm());
    summary.mean_direction +=
        std::abs(turn(std::atan2(expected.y(), expected.x()), std::atan2(measured.y(), measured.x())));
    summary.largest_position = std::max(summary.largest_position, (measured - expected).norm());
  }
  summary.mean_distance /= static_cast<double>(summary.found);
  summary.mean_direction /= static_cast<double>(summary.found);
  return summary;
}

struct PoseSummary {
  std::size_t found = 0;
  double mean_position = 0.0, largest_position = 0.0;
};

PoseSummary summarize_poses(const std::vector<Tracked>& tracked) {
  PoseSummary summary;
  for (const Tracked& t : tracked) {
    if (t.estimate.fix.status != FixStatus::ok) continue;
    const double error =
        (t.estimate.fix.world_from_robot.translation() - t.truth.world_from_robot.translation()).norm();
    ++summary.found;
    summary.mean_position += error;
    summary.largest_position = std::max(summary.largest_position, error);
  }
  summary.mean_position /= static_cast<double>(summary.found);
  return summary;
}

std::function<void(cv::Mat&)> with_blur_and_noise(RandomStream& random) {
  return [&random](cv::Mat& image) { test::degrade(image, {}, random); };
}

void expect_open_accuracy(const std::vector<Tracked>& tracked) {
  const BallSummary balls = summarize_balls(tracked);
  EXPECT_EQ(balls.found, tracked.size());
  EXPECT_LE(balls.mean_distance, 0.012);
  EXPECT_LE(balls.mean_direction, radians(0.010));
}

TEST(Accuracy, ShippedImages) {
  for (const char* set : {"open", "near", "field"}) {
    const auto tracked = test::track(data_file(std::string("images/") + set));
    const BallSummary balls = summarize_balls(tracked);
    EXPECT_EQ(balls.found, tracked.size()) << set;
    EXPECT_LE(balls.largest_position, 0.03) << set;
  }
}

TEST(Accuracy, OpenFloor) {
  const auto folder = test::shared_data() / "pov/open";
  MOVIS_NEEDS_SHARED_DATA(folder);
  expect_open_accuracy(test::track(folder));
}

TEST(Accuracy, OpenFloorWithBlurAndNoise) {
  const auto folder = test::shared_data() / "pov/open";
  MOVIS_NEEDS_SHARED_DATA(folder);
  RandomStream random = make_stream(1, 0);
  expect_open_accuracy(test::track(folder, with_blur_and_noise(random)));
}

TEST(Accuracy, NearBall) {
  const auto folder = test::shared_data() / "pov/near";
  MOVIS_NEEDS_SHARED_DATA(folder);
  RandomStream random = make_stream(1, 1);
  for (const auto& tracked : {test::track(folder), test::track(folder, with_blur_and_noise(random))}) {
    const BallSummary balls = summarize_balls(tracked);
    EXPECT_EQ(balls.found, tracked.size());
    EXPECT_LE(balls.largest_position, 0.010);
  }
}

TEST(Accuracy, PoseOnTheField) {
  const auto folder = test::shared_data() / "pov/field";
  MOVIS_NEEDS_SHARED_DATA(folder);
  RandomStream random = make_stream(1, 2);
  for (const auto& tracked : {test::track(folder), test::track(folder, with_blur_and_noise(random))}) {
    const PoseSummary poses = summarize_poses(tracked);
    EXPECT_EQ(poses.found, tracked.size());
    EXPECT_LE(poses.mean_position, 0.07);
  }
}

}  // namespace
}  // namespace movis
