#pragma once

#include <string>
#include <vector>

namespace movis::bench {

// A benchmark and the peer that it is compared with, by the names they were registered under.
struct Comparison {
  std::string ours;
  std::string peer;
};

// Runs the registered benchmarks with several repetitions and prints, after Google Benchmark's own report, the ratio
// of the medians of every comparison. To be returned from main.
int run_and_compare(int argc, char** argv, const std::vector<Comparison>& comparisons);

}  // namespace movis::bench
