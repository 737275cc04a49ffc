#pragma once

#include <string>
#include <vector>

#include "movis/report/episode_page.h"

namespace movis::experiments {

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

// Of magnitudes of errors; NaN where there are none.
struct ErrorStatistics {
  double mean = 0.0;
  Interval mean_interval;  // 95 %, bootstrap over draws: points of one draw share its cameras
  double median = 0.0;
  double rms = 0.0;
  double percentile95 = 0.0;
  double largest = 0.0;
};

// A mean as a multiple of another; NaN where there are none.
struct Ratio {
  double ratio = 0.0;
  Interval interval;  // 95 %, bootstrap over draws, paired
};

// The 95 % interval of a rate by Wilson's score (E. B. Wilson, J. Am. Stat. Assoc. 22, 1927):
//   (p + z²/2n ± z √(p(1−p)/n + z²/4n²)) / (1 + z²/n),  p = successes/trials, z = 1.96
// Without a trial nothing is known: [0, 1].
Interval wilson_interval(int successes, int trials);

// The mean difference of the times to the goal, `one` less `other`, over the starts from which both scored, with its 95
// % bootstrap interval (B. Efron, R. Tibshirani, An introduction to the bootstrap, 1993, chapter 13: percentiles of
// resampled starts). Both played the same starts, so what a start costs everyone cancels.
struct PairedDifference {
  int pairs = 0;  // 0: nothing else means anything
  double mean_s = 0.0;
  Interval interval_s;
};

PairedDifference paired_times(const std::string& one, const std::string& other,
                              const std::vector<report::Episode>& episodes);

// What came of one contender's episodes.
report::ContenderSummary summarize(const std::string& contender, const std::vector<report::Episode>& episodes);

// The summaries as a table for standard output.
std::string table_of(const std::vector<report::ContenderSummary>& summaries);

}  // namespace movis::experiments
