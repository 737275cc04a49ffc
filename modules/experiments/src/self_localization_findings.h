#pragma once

#include <vector>

#include "movis/experiments/self_localization.h"

namespace movis::experiments {

// The paper's observations (§3.1, §3.2, §4.1) beside ours, with coloured goals. A verdict follows from a mean error as a
// multiple of another, by its bootstrap interval over at least kFewestDraws draws.
std::vector<Observation> observations_of(const SelfLocalizationSettings& settings,
                                         const std::vector<SelfLocalizationRow>& rows);

// What else the numbers say, in sentences.
std::vector<Finding> findings_of(const SelfLocalizationSummary& summary, const std::vector<SelfLocalizationRow>& rows);

}  // namespace movis::experiments
