#include "movis/experiments/experiment.h"

namespace movis::experiments {

const char* word(Knowledge knowledge) {
  constexpr std::array<const char*, kKnowledges.size()> kWords{"nominal", "corrected", "calibrated", "true"};
  return kWords.at(static_cast<std::size_t>(knowledge));
}

const char* rig_words(Knowledge knowledge) {
  constexpr std::array<const char*, kKnowledges.size()> kWords{"the nominal rig", "the nominal rig and its correction",
                                                               "the calibrated rig", "the true rig"};
  return kWords.at(static_cast<std::size_t>(knowledge));
}

}  // namespace movis::experiments
