#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// What the experiments share: rows that can be resumed and replayed, knowledge of a rig, findings.
namespace movis::experiments {

// What is known of the rig.
//   nominal     its drawing
//   corrected   its drawing, and the paper's error correction fitted to balls at known places
//   calibrated  a rig fitted to the same balls
//   true_rig    the rig itself: what no calibration can better
enum class Knowledge { nominal, corrected, calibrated, true_rig };

inline constexpr std::array kKnowledges{Knowledge::nominal, Knowledge::corrected, Knowledge::calibrated,
                                        Knowledge::true_rig};

const char* word(Knowledge knowledge);       // in files
const char* rig_words(Knowledge knowledge);  // for people

inline constexpr const char* kNotCalibrated = "not_calibrated";  // the status where nothing could be fitted

struct ExperimentRun {
  std::uint64_t seed = 1;
  int jobs = 1;                                                     // threads; results do not depend on their number
  bool resume = false;                                              // goes on with the blocks that rows.csv holds
  std::function<void(std::size_t done, std::size_t all)> progress;  // after every block, if given; may throw to stop
};

// A row of a folder's rows.csv as it stands there, and recomputed.
struct ReplayedRow {
  std::string header, stored, recomputed;  // lines of CSV
};

// Sentences that follow from the numbers.
struct Finding {
  std::string topic;
  std::vector<std::string> sentences;
};

}  // namespace movis::experiments
