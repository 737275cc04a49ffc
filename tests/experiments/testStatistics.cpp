#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "movis/core/random.h"
#include "movis/experiments/statistics.h"

namespace movis::experiments {
namespace {

// By hand for 8 of 10 and z = 1.96: p = 0.8, z² = 3.8415, z²/2n = 0.19207, 1 + z²/n = 1.38415,
// √(0.8·0.2/10 + 3.8415/400) = √(0.016 + 0.0096036) = 0.160011, times z 0.313616:
// (0.8 + 0.19207 ∓ 0.313616)/1.38415 = 0.49016 and 0.94332.
TEST(WilsonInterval, EightOfTen) {
  const Interval interval = wilson_interval(8, 10);
  EXPECT_NEAR(interval.low, 0.49016, 1e-4);
  EXPECT_NEAR(interval.high, 0.94332, 1e-4);
}

// For none of n the formula reduces to [0, z²/(n + z²)]; n = 10: 3.8415/13.8415 = 0.27753.
TEST(WilsonInterval, NoneAndAll) {
  EXPECT_DOUBLE_EQ(wilson_interval(0, 10).low, 0.0);
  EXPECT_NEAR(wilson_interval(0, 10).high, 0.27753, 1e-4);
  EXPECT_NEAR(wilson_interval(10, 10).low, 1.0 - 0.27753, 1e-4);
  EXPECT_DOUBLE_EQ(wilson_interval(10, 10).high, 1.0);
}

TEST(WilsonInterval, NoTrial) {
  EXPECT_DOUBLE_EQ(wilson_interval(0, 0).low, 0.0);
  EXPECT_DOUBLE_EQ(wilson_interval(0, 0).high, 1.0);
}

report::Episode episode(const std::string& contender, const std::string& outcome, double duration_s,
                        std::uint64_t seed = 0) {
  report::Episode episode;
  episode.seed = seed;
  episode.contender = contender;
  episode.outcome = outcome;
  episode.duration_s = duration_s;
  return episode;
}

TEST(Summarize, CountsOneContendersEpisodes) {
  const std::vector<report::Episode> episodes = {episode("a", "goal", 3.0), episode("b", "goal", 1.0),
                                                 episode("a", "ball_out", 2.0), episode("a", "goal", 5.0)};
  const report::ContenderSummary summary = summarize("a", episodes);
  EXPECT_EQ(summary.episodes, 3);
  EXPECT_EQ(summary.goals, 2);
  EXPECT_DOUBLE_EQ(summary.median_time_s, 4.0);  // of the goals alone
  ASSERT_EQ(summary.outcomes.size(), 2U);
  EXPECT_EQ(summary.outcomes[0], (std::pair<std::string, int>{"ball_out", 1}));
  EXPECT_TRUE(std::isnan(summary.pose_error_m));  // there were no ticks
}

// Poses 3 and 5 cm off, and one unknown: 4 cm. The ball once, 2 cm off.
TEST(Summarize, MeanErrorsOverKnownTicks) {
  report::Episode played = episode("a", "goal", 1.0);
  played.ticks.resize(3);
  played.ticks[0].true_pose = {1.0, 2.0, 0.3};
  played.ticks[0].pose = Pose2{1.03, 2.0, 0.0};
  played.ticks[1].pose = Pose2{0.03, 0.04, 0.0};
  played.ticks[1].true_ball = {0.5, 0.5, 0.11};
  played.ticks[1].ball = Eigen::Vector2d(0.5, 0.52);
  const report::ContenderSummary summary = summarize("a", {played});
  EXPECT_NEAR(summary.pose_error_m, 0.04, 1e-12);
  EXPECT_NEAR(summary.ball_error_m, 0.02, 1e-12);
}

// Differences of 1, 2 and 3 s; the fourth start has no pair, as one of them missed.
TEST(PairedTimes, OverTheStartsFromWhichBothScored) {
  std::vector<report::Episode> episodes;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    episodes.push_back(episode("a", "goal", 10.0 * static_cast<double>(seed) + static_cast<double>(seed), seed));
    episodes.push_back(episode("b", "goal", 10.0 * static_cast<double>(seed), seed));
  }
  episodes.push_back(episode("a", "goal", 100.0, 4));
  episodes.push_back(episode("b", "ball_out", 1.0, 4));
  const PairedDifference difference = paired_times("a", "b", episodes);
  EXPECT_EQ(difference.pairs, 3);
  EXPECT_NEAR(difference.mean_s, 2.0, 1e-12);
  EXPECT_GE(difference.interval_s.low, 1.0);
  EXPECT_LE(difference.interval_s.high, 3.0);
  EXPECT_LT(difference.interval_s.low, difference.interval_s.high);
  EXPECT_EQ(paired_times("a", "c", episodes).pairs, 0);
}

// For many differences of variance 1 the interval is that of the normal distribution: ±1.96/√n.
TEST(PairedTimes, IntervalOfManyIsTheNormalOne) {
  RandomStream random = make_stream(3, 0);
  std::normal_distribution<double> normal(0.5, 1.0);
  std::vector<report::Episode> episodes;
  constexpr int kPairs = 2500;
  for (std::uint64_t seed = 0; seed < kPairs; ++seed) {
    episodes.push_back(episode("a", "goal", 10.0 + normal(random), seed));
    episodes.push_back(episode("b", "goal", 10.0, seed));
  }
  const PairedDifference difference = paired_times("a", "b", episodes);
  EXPECT_NEAR(difference.interval_s.high - difference.mean_s, 1.96 / 50.0, 0.004);
  EXPECT_NEAR(difference.mean_s - difference.interval_s.low, 1.96 / 50.0, 0.004);
}

TEST(Summarize, NoGoal) {
  const report::ContenderSummary summary = summarize("a", {episode("a", "out_of_time", 20.0)});
  EXPECT_EQ(summary.goals, 0);
  EXPECT_TRUE(std::isnan(summary.median_time_s));
  EXPECT_NE(table_of({summary}).find("out_of_time 1"), std::string::npos);
}

}  // namespace
}  // namespace movis::experiments
