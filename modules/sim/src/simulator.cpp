#include "movis/sim/simulator.h"

namespace movis::sim {

Simulator::Simulator(const Scenario& scenario, std::uint64_t seed)
    : seed_(seed), episode_(scenario, seed), renderer_(scenario.rig, scenario.arena, scenario.robot, scenario.look) {}

void Simulator::restart(std::uint64_t seed) {
  seed_ = seed;
  episode_.restart(seed);
  frame_ = 0;
}

void Simulator::open() {
  episode_.restart();
  frame_ = 0;
}

bool Simulator::acquire(grab::FrameSet& set) {
  if (frame_ > 0 && !episode_.advance()) return false;
  const auto frame = static_cast<std::uint64_t>(frame_);
  RandomStream noise = make_stream(seed_, kImageStream + frame);
  renderer_.render(truth(), noise(), set);
  set.index = frame_++;
  set.time_s = truth().time_s;
  for (grab::Frame& image : set.frames) image.time_s = set.time_s;
  return true;
}

}  // namespace movis::sim
