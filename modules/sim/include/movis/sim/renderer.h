#pragma once

#include <cstdint>
#include <memory>

#include "movis/control/robot_model.h"
#include "movis/grab/image_source.h"
#include "movis/omni/rig.h"
#include "movis/sim/look.h"
#include "movis/sim/scene.h"

namespace movis::sim {

// Renders what the cameras of a rig see.
class Renderer {
 public:
  Renderer(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  // All cameras' images into the set, BGR, reusing its memory; index and time are the caller's. The same state and noise
  // seed give the same bytes, on any number of cores.
  void render(const State& state, std::uint64_t noise_seed, grab::FrameSet& images);

 private:
  struct Cameras;
  std::unique_ptr<Cameras> cameras_;
};

}  // namespace movis::sim
