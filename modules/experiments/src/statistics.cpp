#include "movis/experiments/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>

#include "movis/core/random.h"

namespace movis::experiments {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double median(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

struct Mean {
  double sum = 0.0;
  int count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  double value() const { return count > 0 ? sum / count : kUnknown; }
};

}  // namespace

Interval wilson_interval(int successes, int trials) {
  if (trials <= 0) return {0.0, 1.0};
  constexpr double kZ = 1.959963984540054;
  const double n = trials;
  const double p = successes / n;
  const double middle = p + kZ * kZ / (2.0 * n);
  const double half = kZ * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  const double scale = 1.0 / (1.0 + kZ * kZ / n);
  return {std::max(0.0, scale * (middle - half)), std::min(1.0, scale * (middle + half))};
}

PairedDifference paired_times(const std::string& one, const std::string& other,
                              const std::vector<report::Episode>& episodes) {
  std::map<std::uint64_t, double> times;
  for (const report::Episode& e : episodes) {
    if (e.contender == one && e.outcome == "goal") times[e.seed] = e.duration_s;
  }
  std::vector<double> differences;
  for (const report::Episode& e : episodes) {
    const auto found = times.find(e.seed);
    if (e.contender == other && e.outcome == "goal" && found != times.end()) {
      differences.push_back(found->second - e.duration_s);
    }
  }
  PairedDifference result;
  result.pairs = static_cast<int>(differences.size());
  if (differences.empty()) return result;

  constexpr int kResamples = 4000;
  RandomStream random = make_stream(1, 0);  // the same interval for the same episodes
  std::uniform_int_distribution<std::size_t> draw(0, differences.size() - 1);
  std::vector<double> means;
  means.reserve(kResamples);
  for (int i = 0; i < kResamples; ++i) {
    Mean mean;
    for (std::size_t k = 0; k < differences.size(); ++k) mean.add(differences[draw(random)]);
    means.push_back(mean.value());
  }
  std::sort(means.begin(), means.end());
  Mean mean;
  for (const double difference : differences) mean.add(difference);
  result.mean_s = mean.value();
  result.interval_s = {means[kResamples / 40], means[kResamples - 1 - kResamples / 40]};
  return result;
}

report::ContenderSummary summarize(const std::string& contender, const std::vector<report::Episode>& episodes) {
  report::ContenderSummary summary;
  summary.contender = contender;
  std::map<std::string, int> outcomes;
  std::vector<double> goal_times;
  Mean pose_error, ball_error;
  for (const report::Episode& episode : episodes) {
    if (episode.contender != contender) continue;
    ++summary.episodes;
    ++outcomes[episode.outcome];
    if (episode.outcome == "goal") goal_times.push_back(episode.duration_s);
    for (const report::EpisodeTick& tick : episode.ticks) {
      if (tick.pose) pose_error.add((tick.pose->translation() - tick.true_pose.translation()).norm());
      if (tick.ball) ball_error.add((*tick.ball - tick.true_ball.head<2>()).norm());
    }
  }
  summary.goals = static_cast<int>(goal_times.size());
  const Interval rate = wilson_interval(summary.goals, summary.episodes);
  summary.rate_low = rate.low;
  summary.rate_high = rate.high;
  summary.outcomes.assign(outcomes.begin(), outcomes.end());
  summary.median_time_s = median(goal_times);
  summary.pose_error_m = pose_error.value();
  summary.ball_error_m = ball_error.value();
  return summary;
}

std::string table_of(const std::vector<report::ContenderSummary>& summaries) {
  std::size_t width = 9;
  for (const report::ContenderSummary& s : summaries) width = std::max(width, s.contender.size());
  const auto number = [](double value, int digits) {
    return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("–");
  };
  std::string table = fmt::format("  {:<{}}{:>9}{:>9}{:>16}{:>10}{:>10}{:>10}  other outcomes\n", "contender", width,
                                  "goals", "rate", "95 % interval", "median s", "pose cm", "ball cm");
  for (const report::ContenderSummary& s : summaries) {
    const std::string goals = fmt::format("{}/{}", s.goals, s.episodes);
    const std::string rate = s.episodes > 0 ? fmt::format("{:.1f} %", 100.0 * s.goals / s.episodes) : "–";
    const std::string interval = fmt::format("{:.1f}–{:.1f} %", 100.0 * s.rate_low, 100.0 * s.rate_high);
    std::string others;
    for (const auto& [outcome, count] : s.outcomes) {
      if (outcome != "goal") others += fmt::format("{}{} {}", others.empty() ? "" : ", ", outcome, count);
    }
    fmt::format_to(std::back_inserter(table), "  {:<{}}{:>9}{:>9}{:>16}{:>10}{:>10}{:>10}  {}\n", s.contender, width,
                   goals, rate, interval, number(s.median_time_s, 2), number(100.0 * s.pose_error_m, 1),
                   number(100.0 * s.ball_error_m, 1), others.empty() ? "none" : others);
  }
  return table;
}

}  // namespace movis::experiments
