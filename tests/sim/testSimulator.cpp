#include <cstdint>
#include <limits>
#include <vector>

#include "movis/core/paths.h"
#include "movis/sim/simulator.h"
#include "physics_scene.h"
#include "support/temporary_folder.h"

namespace movis::sim {
namespace {

// The ball before the kicker, and the goal ahead; seen by one camera.
Scenario penalty() {
  Scenario scenario = read_scenario(data_file("scenarios/resting-ball.yaml"));
  scenario.rig.cameras.resize(1);
  scenario.robot_start = Pose2{};
  scenario.ball_start = Eigen::Vector2d(0.0, 0.39);
  return scenario;
}

std::vector<std::uint8_t> bytes(const grab::FrameSet& set) {
  const ImageView& view = set.frames.front().view;
  std::vector<std::uint8_t> copy;
  for (int row = 0; row < view.height; ++row) {
    const std::uint8_t* start = view.data + row * view.stride;
    copy.insert(copy.end(), start, start + 3 * view.width);
  }
  return copy;
}

TEST(Simulator, FirstImageIsTheBeginning) {
  Simulator simulator(penalty(), 1);
  simulator.open();
  grab::FrameSet set;
  ASSERT_TRUE(simulator.acquire(set));
  EXPECT_EQ(set.index, 0);
  EXPECT_EQ(set.time_s, 0.0);
  ASSERT_EQ(set.frames.size(), 1U);
  EXPECT_EQ(set.frames.front().view.width, 640);
  ASSERT_TRUE(simulator.acquire(set));
  EXPECT_EQ(set.index, 1);
  EXPECT_NEAR(set.time_s, 1.0 / 30.0, 1e-12);
  EXPECT_EQ(set.frames.front().time_s, set.time_s);
  EXPECT_EQ(simulator.truth().time_s, set.time_s);
}

TEST(Simulator, EndsWithTheOutcome) {
  Simulator simulator(penalty(), 1);
  simulator.open();
  grab::FrameSet set;
  int frames = 0;
  while (simulator.acquire(set)) {
    ++frames;
    EXPECT_EQ(simulator.outcome(), std::nullopt);
    simulator.send({{}, true});
  }
  EXPECT_EQ(simulator.outcome(), Outcome::goal);
  EXPECT_EQ(simulator.kicks(), 1);
  EXPECT_EQ(set.index, frames - 1);
  EXPECT_FALSE(simulator.acquire(set));
}

// The noise of the images differs from image to image and from seed to seed, not from run to run.
TEST(Simulator, SameSeedSameImages) {
  const Scenario scenario = penalty();
  Simulator simulator(scenario, 1);
  Simulator other(scenario, 2);
  grab::FrameSet set;
  std::vector<std::vector<std::uint8_t>> images[2];
  for (auto& run : images) {
    simulator.open();
    for (int i = 0; i < 3; ++i) {
      ASSERT_TRUE(simulator.acquire(set));
      run.push_back(bytes(set));
      simulator.send(drive_at(0.3, 0.0, 1.0));
    }
  }
  EXPECT_EQ(images[0], images[1]);
  EXPECT_NE(images[0][0], images[0][1]);  // nothing has moved yet
  ASSERT_TRUE(other.acquire(set));
  EXPECT_NE(images[0][0], bytes(set));
}

TEST(Simulator, NonFiniteCommand) {
  Simulator simulator(penalty(), 1);
  test::expect_error([&] { simulator.send(drive_at(std::numeric_limits<double>::quiet_NaN(), 0.0)); }, {"not finite"});
}

}  // namespace
}  // namespace movis::sim
