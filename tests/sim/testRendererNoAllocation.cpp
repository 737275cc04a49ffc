// On one thread, a picture after the first allocates nothing.
#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>

#include "render_scene.h"
#include "support/allocations.h"

namespace movis {
namespace {

TEST(RendererNoAllocation, AfterTheFirstPicture) {
#if defined(MOVIS_COUNTS_ALLOCATIONS)
  cv::setNumThreads(1);
  test::RenderScene scene;
  scene.look = sim::read_look(data_file("looks/hall.yaml"));  // with blur and noise
  scene.arena.field = read_field(data_file("fields/paper.yaml"));
  scene.arena.wall.emplace();
  scene.arena.obstacles = {{{0.6, 1.3}}, {{-0.9, -0.4}, 0.15, 0.5, sim::Obstacle::Band::cyan, 0.25, 0.35}};
  sim::Renderer renderer(scene.rig, scene.arena, scene.robot, scene.look);
  grab::FrameSet images;
  renderer.render(scene.state, 1, images);
  for (int i = 0; i < 20; ++i) {
    scene.state.world_from_robot = {0.1 * i - 1.0, 0.9 - 0.1 * i, 0.3 * i};
    scene.state.ball_in_field = {1.4 - 0.1 * i, 0.15 * i - 1.5, sim::kBallRadius + 0.01 * i};
    EXPECT_EQ(test::allocations_in([&] { renderer.render(scene.state, static_cast<std::uint64_t>(i), images); }), 0)
        << i;
  }
#else
  GTEST_SKIP() << "the sanitizer owns malloc; the release and dev presets run this test";
#endif
}

#if defined(MOVIS_COUNTS_ALLOCATIONS)
TEST(RendererNoAllocation, TheCounterCounts) {
  void* volatile memory = nullptr;  // volatile: or the compiler leaves the pair out
  EXPECT_EQ(test::allocations_in([&] { memory = std::malloc(1); }), 1);
  std::free(memory);
}
#endif

}  // namespace
}  // namespace movis
