// The tick allocates nothing after its first run.
#include <gtest/gtest.h>

#include "movis/fuzzy/hierarchy.h"
#include "movis/pipeline/player.h"
#include "movis/sim/simulator.h"
#include "pipeline/tracked.h"
#include "support/allocations.h"

namespace movis {
namespace {

#if defined(MOVIS_COUNTS_ALLOCATIONS)

TEST(NoAllocation, TheCounterCounts) {
  void* volatile memory = nullptr;  // volatile: or the compiler leaves the pair out
  EXPECT_EQ(test::allocations_in([&] { memory = std::malloc(1); }), 1);
  std::free(memory);
  EXPECT_EQ(test::allocations_in([&] { memory = operator new(1); }), 1);
  operator delete(memory);
}

TEST(NoAllocation, InTheTickAfterTheFirst) {
  for (const char* set : {"field", "near", "open", "field-obstacles"}) {
    grab::DatasetSource source(grab::read_dataset(data_file(std::string("images/") + set)));
    std::vector<grab::FrameSet> sets;
    source.open();
    for (grab::FrameSet images; source.acquire(images);) sets.push_back(std::move(images));
    source.close();
    for (const auto name : localization::localizer_names()) {
      pipeline::Pipeline pipeline = test::make_pipeline(source.dataset(), std::string(name).c_str());
      step(pipeline, sets.front());
      for (const grab::FrameSet& images : sets) {
        EXPECT_EQ(test::allocations_in([&] { step(pipeline, images); }), 0)
            << set << " " << images.index << " " << name;
      }
    }
  }
}

// From images to a command. A task of ViSP would allocate some 150 times.
TEST(NoAllocation, InTheTickOfAPlayer) {
  const sim::Scenario scenario = sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
  const control::Task task{*scenario.arena.field, scenario.robot, sim::kBallRadius};
  pipeline::Player player(
      pipeline::Pipeline(scenario.rig, scenario.arena.field, scan::read_colours(data_file("colours/default.yaml")), {},
                         localization::find_localizer("composed")),
      scenario.robot);
  fuzzy::Hierarchy controller(data_file("fuzzy/approach-and-shoot/controller.yaml"), task);
  sim::Simulator simulator(scenario, 1);
  grab::FrameSet images;
  player.start(0.0);
  for (int tick = 0; tick < 40; ++tick) {
    ASSERT_TRUE(simulator.acquire(images));
    control::Command command;
    const int allocations = test::allocations_in([&] { command = play(player, controller, images); });
    EXPECT_TRUE(tick == 0 || allocations == 0) << tick << ": " << allocations;
    simulator.send(command);
  }
}

#else

TEST(NoAllocation, InTheTickAfterTheFirst) {
  GTEST_SKIP() << "the sanitizer owns malloc; the release and dev presets run this test";
}

#endif

}  // namespace
}  // namespace movis
