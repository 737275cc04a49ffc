#include "ratio_table.h"

#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include <map>

namespace movis::bench {
namespace {

// The console's report, with the medians kept.
class MedianKeeper : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
      if (run.aggregate_name == "median") medians_us[run.run_name.function_name] = 1e6 * seconds(run);
    }
  }
  std::map<std::string, double> medians_us;

 private:
  static double seconds(const Run& run) {
    return run.GetAdjustedCPUTime() / benchmark::GetTimeUnitMultiplier(run.time_unit);
  }
};

}  // namespace

int run_and_compare(int argc, char** argv, const std::vector<Comparison>& comparisons) {
  std::vector<char*> arguments(argv, argv + argc);
  std::string repetitions = "--benchmark_repetitions=7";
  std::string interleaved = "--benchmark_enable_random_interleaving=true";
  std::string least_time = "--benchmark_min_time=0.1";
  std::string aggregates = "--benchmark_report_aggregates_only=true";
  for (std::string* argument : {&repetitions, &interleaved, &least_time, &aggregates}) {
    arguments.insert(arguments.begin() + 1, argument->data());  // what the user says comes later and wins
  }
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  MedianKeeper reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);

  fmt::print("\n{:<34}{:>12}   {:<34}{:>12}{:>9}\n", "ours", "median µs", "peer", "median µs", "ratio");
  for (const Comparison& comparison : comparisons) {
    const auto ours = reporter.medians_us.find(comparison.ours);
    const auto peer = reporter.medians_us.find(comparison.peer);
    if (ours == reporter.medians_us.end() || peer == reporter.medians_us.end()) continue;  // filtered out
    fmt::print("{:<34}{:>12.3f}   {:<34}{:>12.3f}{:>8.1f}×\n", comparison.ours, ours->second, comparison.peer,
               peer->second, peer->second / ours->second);
  }
  return 0;
}

}  // namespace movis::bench
