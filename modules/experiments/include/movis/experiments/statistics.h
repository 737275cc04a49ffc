#pragma once

#include <string>
#include <vector>

#include "movis/report/episode_page.h"

namespace movis::experiments {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// The 95 % interval of a rate by Wilson's score (E. B. Wilson, J. Am. Stat. Assoc. 22, 1927):
//   (p + z²/2n ± z √(p(1−p)/n + z²/4n²)) / (1 + z²/n),  p = successes/trials, z = 1.96
// Without a trial nothing is known: [0, 1].
Interval wilson_interval(int successes, int trials);

// What came of one contender's episodes.
report::ContenderSummary summarize(const std::string& contender, const std::vector<report::Episode>& episodes);

// The summaries as a table for standard output.
std::string table_of(const std::vector<report::ContenderSummary>& summaries);

}  // namespace movis::experiments
