// The same state and seed give the same bytes, whatever memory and however many threads.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "render_scene.h"

namespace movis {
namespace {

class RendererRepeats : public ::testing::Test {
 protected:
  RendererRepeats() {
    scene_.arena.field = read_field(data_file("fields/paper.yaml"));
    scene_.look = sim::read_look(data_file("looks/hall.yaml"));  // with blur and noise
  }
  ~RendererRepeats() override { cv::setNumThreads(threads_); }

  static bool same(const grab::FrameSet& a, const grab::FrameSet& b) {
    for (std::size_t i = 0; i < a.memory.size(); ++i) {
      if (cv::norm(a.memory[i], b.memory[i], cv::NORM_INF) != 0.0) return false;
    }
    return a.memory.size() == 3 && b.memory.size() == 3;
  }

  test::RenderScene scene_;
  int threads_ = cv::getNumThreads();
};

TEST_F(RendererRepeats, SameSeedSameBytes) {
  EXPECT_TRUE(same(scene_.images(7), scene_.images(7)));
}

TEST_F(RendererRepeats, AnotherSeedAnotherNoise) {
  EXPECT_FALSE(same(scene_.images(7), scene_.images(8)));
  scene_.look.sensor.full_well = scene_.look.sensor.read_noise = 0.0;
  EXPECT_TRUE(same(scene_.images(7), scene_.images(8)));
}

TEST_F(RendererRepeats, OnAnyNumberOfThreads) {
  cv::setNumThreads(2);
  const grab::FrameSet by_two = scene_.images(7);
  cv::setNumThreads(1);
  EXPECT_TRUE(same(by_two, scene_.images(7)));
}

TEST_F(RendererRepeats, ThreadsMayChangeBetweenFrames) {
  sim::Renderer renderer(scene_.rig, scene_.arena, scene_.robot, scene_.look);
  grab::FrameSet images;
  for (const int threads : {2, 1}) {
    cv::setNumThreads(threads);
    renderer.render(scene_.state, 7, images);
    EXPECT_TRUE(same(images, scene_.images(7))) << threads;
  }
}

TEST_F(RendererRepeats, MemoryIsReused) {
  sim::Renderer renderer(scene_.rig, scene_.arena, scene_.robot, scene_.look);
  grab::FrameSet images;
  renderer.render(scene_.state, 7, images);
  std::vector<const std::uint8_t*> memory;
  for (const cv::Mat& image : images.memory) memory.push_back(image.data);

  sim::State later = scene_.state;
  later.time_s = 2.5;
  later.world_from_robot = {0.4, -0.3, 1.0};
  later.ball_in_field.x() = -1.0;
  renderer.render(later, 8, images);
  renderer.render(scene_.state, 7, images);
  EXPECT_TRUE(same(images, scene_.images(7)));
  for (std::size_t i = 0; i < memory.size(); ++i) {
    EXPECT_EQ(images.memory[i].data, memory[i]);
    EXPECT_EQ(images.frames[i].view.data, memory[i]);
    EXPECT_EQ(images.frames[i].time_s, scene_.state.time_s);
  }
}

TEST_F(RendererRepeats, AMovedRendererGoesOn) {
  sim::Renderer first(scene_.rig, scene_.arena, scene_.robot, scene_.look);
  sim::Renderer second = std::move(first);
  grab::FrameSet images;
  second.render(scene_.state, 7, images);
  EXPECT_TRUE(same(images, scene_.images(7)));
}

}  // namespace
}  // namespace movis
