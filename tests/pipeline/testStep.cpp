#include <gtest/gtest.h>

#include "movis/core/error.h"
#include "pipeline/tracked.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

using pipeline::Estimate;

// The first set of the shipped field images, and a pipeline for it.
class Step : public testing::Test {
 protected:
  void SetUp() override {
    grab::DatasetSource source(grab::read_dataset(data_file("images/field")));
    pipeline_ = std::make_unique<pipeline::Pipeline>(test::make_pipeline(source.dataset()));
    source.open();
    ASSERT_TRUE(source.acquire(images_));
  }

  void lose(int camera) { images_.frames[camera].view = {}; }

  std::unique_ptr<pipeline::Pipeline> pipeline_;
  grab::FrameSet images_;
};

TEST_F(Step, SeesMeasuresAndLocalizes) {
  const Estimate& estimate = step(*pipeline_, images_);
  EXPECT_EQ(estimate.ball_in_robot.status, PointStatus::ok);
  EXPECT_EQ(estimate.fix.status, FixStatus::ok);
  EXPECT_EQ(estimate.bearings.size(), 9U);  // three cameras see the ball and both goals
  EXPECT_GT(estimate.tick_us, 0.0);
  EXPECT_EQ(estimate.index, images_.index);
}

TEST_F(Step, SameImagesSameEstimate) {
  const Estimate first = step(*pipeline_, images_);
  const Estimate second = step(*pipeline_, images_);
  EXPECT_EQ(first.ball_in_robot.point, second.ball_in_robot.point);
  EXPECT_EQ(first.ball_in_robot.covariance, second.ball_in_robot.covariance);
  EXPECT_EQ(first.fix.world_from_robot.x, second.fix.world_from_robot.x);
  EXPECT_EQ(first.fix.covariance, second.fix.covariance);
}

TEST_F(Step, OneCameraLost) {
  const Eigen::Vector3d with_all = step(*pipeline_, images_).ball_in_robot.point;
  for (int camera = 0; camera < 3; ++camera) {
    SetUp();
    lose(camera);
    const Estimate& estimate = step(*pipeline_, images_);
    EXPECT_EQ(estimate.bearings.size(), 6U) << camera;
    EXPECT_EQ(estimate.ball_in_robot.status, PointStatus::ok) << camera;
    EXPECT_LT((estimate.ball_in_robot.point - with_all).norm(), 0.1) << camera;
  }
}

TEST_F(Step, OneCameraLeft) {
  lose(0);
  lose(2);
  const Estimate& estimate = step(*pipeline_, images_);
  EXPECT_EQ(estimate.ball_in_robot.status, PointStatus::one_camera);
  EXPECT_EQ(estimate.fix.status, FixStatus::no_distance);
}

TEST_F(Step, NoCameraLeft) {
  for (int camera = 0; camera < 3; ++camera) lose(camera);
  const Estimate& estimate = step(*pipeline_, images_);
  EXPECT_TRUE(estimate.bearings.empty());
  EXPECT_EQ(estimate.ball_in_robot.status, PointStatus::not_seen);
  EXPECT_EQ(estimate.fix.status, FixStatus::no_goal);
}

TEST_F(Step, WithoutFieldNoPoseIsSought) {
  pipeline_->map.reset();
  EXPECT_EQ(step(*pipeline_, images_).fix.status, FixStatus::no_field);
}

TEST_F(Step, SetOfAnotherRig) {
  images_.frames.pop_back();
  test::expect_error([&] { step(*pipeline_, images_); }, {"2 images", "3 cameras"});
}

TEST_F(Step, ImageOfAnotherSize) {
  images_.frames[1].view.height -= 1;
  test::expect_error([&] { step(*pipeline_, images_); }, {"M2", "640", "479", "480"});
}

TEST(Pipeline, RigOfOneCamera) {
  grab::Dataset dataset = grab::read_dataset(data_file("images/open"));
  dataset.rig.cameras.resize(1);
  test::expect_error([&] { test::make_pipeline(dataset); }, {"two or more cameras", "1"});
}

TEST(Options, ReadStrictly) {
  const test::TemporaryFolder folder;
  const auto read = [&](const char* text) { return pipeline::read_options(folder.write("options.yaml", text)); };
  const pipeline::Options options =
      read("scan: {bins: 360, threshold: {minimum: 3}}\ntriangulation: {pairs: {min_parallax_deg: 1}}\n");
  EXPECT_EQ(options.scan.bins, 360);
  EXPECT_DOUBLE_EQ(options.scan.threshold.minimum, 3.0);
  EXPECT_DOUBLE_EQ(options.triangulation.pairs.min_parallax_deg, 1.0);
  EXPECT_DOUBLE_EQ(options.scan.ball_gap_deg, scan::ScanOptions{}.ball_gap_deg);
  test::expect_error([&] { read("scan: {bin: 360}\n"); }, {"options.yaml:1", "'bin'", "did you mean 'bins'"});
  test::expect_error([&] { read("scan: {bins: 36}\n"); }, {"scan.bins", "out of range"});
  test::expect_error([&] { read("scanner: {}\n"); }, {"'scanner'", "Known here: scan, triangulation"});
}

}  // namespace
}  // namespace movis
