#pragma once

#include <vector>

#include "drawn_rig.h"
#include "movis/experiments/self_localization.h"
#include "movis/pipeline/pipeline.h"
#include "movis/sim/renderer.h"

namespace movis::experiments {

// One draw of the rig on the field, and what is known of it.
class SelfLocalizationBench {
 public:
  SelfLocalizationBench(const SelfLocalizationSettings& settings, std::uint64_t seed,
                        const SelfLocalizationBlock& block);

  // The rows of one pose, appended: rendered once, scanned once for each belief, then one fix by each localizer.
  void measure(int spot, int heading, std::vector<SelfLocalizationRow>& rows);

  // Of a pose.
  static std::int64_t rows_a_pose(const SelfLocalizationSettings& settings, Field::Goals goals);

 private:
  struct Belief {
    Knowledge knowledge;
    pipeline::Pipeline pipeline;
    bool known = true;  // else no correction could be fitted
  };
  struct Contender {
    std::string_view name;
    localization::Localizer localizer;
  };
  pipeline::Pipeline make_pipeline(const omni::Rig& rig) const;
  void believe(const omni::Rig& truth);

  const SelfLocalizationSettings& settings_;
  RigDraw draw_;
  SelfLocalizationBlock block_;
  Field field_;
  std::vector<Contender> contenders_;
  sim::Renderer renderer_;
  grab::FrameSet images_;
  std::vector<Belief> beliefs_;
};

}  // namespace movis::experiments
