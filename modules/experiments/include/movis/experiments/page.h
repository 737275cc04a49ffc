#pragma once

#include <vector>

#include "movis/report/episode_page.h"
#include "movis/sim/scenario.h"

namespace movis::experiments {

// The page about episodes of a scenario: its field and bodies, the summaries, and the episodes to show. Title and
// command are the caller's.
report::EpisodePage page_of(const sim::Scenario& scenario, std::vector<report::ContenderSummary> summaries,
                            std::vector<report::Episode> shown);

}  // namespace movis::experiments
