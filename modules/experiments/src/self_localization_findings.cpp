#include "self_localization_findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>

#include "movis/core/angle.h"
#include "resampling.h"

namespace movis::experiments {
namespace {

using Rows = std::vector<SelfLocalizationRow>;

// Rows that are compared: of one field and one knowledge of the rig.
struct Group {
  const Rows& rows;
  Field::Goals goals;
  Knowledge knowledge;

  template <typename Action>
  void each(std::string_view localizer, Action action) const {
    for (const SelfLocalizationRow& row : rows) {
      if (row.goals == goals && row.knowledge == knowledge && row.localizer == localizer) action(row);
    }
  }
};

using SumPairs = std::map<int, std::pair<Sum, Sum>>;  // by draw

Ratio ratio_of(const SumPairs& draws) {
  std::vector<std::pair<Sum, Sum>> pairs;
  for (const auto& [draw, pair] : draws) {
    if (pair.first.count > 0 && pair.second.count > 0) pairs.push_back(pair);
  }
  Ratio result = experiments::ratio_of(pairs);
  if (pairs.size() < kFewestDraws) result.interval = {kUnknown, kUnknown};
  return result;
}

std::string text_of(const Ratio& r) {
  if (!std::isfinite(r.ratio)) return "no ratio";
  if (!std::isfinite(r.interval.low)) return fmt::format("{:.2f}", r.ratio);
  return fmt::format("{:.2f} ({:.2f}–{:.2f})", r.ratio, r.interval.low, r.interval.high);
}

constexpr const char* kAgrees = "agrees";
constexpr const char* kDiffers = "does not agree";
constexpr const char* kUndecided = "not decided";
constexpr const char* kUntested = "not tested: no goal was lost anywhere";

// The paper says that all of these are below 1.
const char* below_one(const std::vector<Ratio>& ratios) {
  const auto interval = [](auto test) { return [test](const Ratio& r) { return test(r.interval); }; };
  if (std::all_of(ratios.begin(), ratios.end(), interval([](const Interval& i) { return i.high < 1.0; }))) {
    return kAgrees;
  }
  if (std::any_of(ratios.begin(), ratios.end(), interval([](const Interval& i) { return i.low > 1.0; }))) {
    return kDiffers;
  }
  return kUndecided;
}

std::string cm(double metres) {
  return fmt::format("{:.1f}", 100.0 * metres);
}

// Over both of two coordinates of the same fixes.
Observation::Ours better_axis(const Group& group, const char* localizer, int better, int worse) {
  SumPairs draws;
  group.each(localizer, [&](const SelfLocalizationRow& row) {
    if (!row.ok()) return;
    draws[row.draw].first.add(std::abs(row.error[better]));
    draws[row.draw].second.add(std::abs(row.error[worse]));
  });
  Sum first, second;
  for (const auto& [draw, pair] : draws) {
    first.add(pair.first);
    second.add(pair.second);
  }
  const Ratio r = ratio_of(draws);
  const char* names[] = {"X", "Y"};
  return {group.knowledge,
          fmt::format("{} {} cm, {} {} cm: {} times", names[better], cm(first.mean()), names[worse], cm(second.mean()),
                      text_of(r)),
          below_one({r})};
}

Observation::Ours composed_best(const Group& group) {
  const LocalizerRatio one = localizer_ratio(group.rows, group.goals, group.knowledge, "composed", "method1");
  const LocalizerRatio two = localizer_ratio(group.rows, group.goals, group.knowledge, "composed", "method2");
  return {group.knowledge, fmt::format("{} times method 1, {} times method 2", text_of(one.ratio), text_of(two.ratio)),
          below_one({one.ratio, two.ratio})};
}

using Chosen = std::function<bool(int spot)>;

// The composed method's position error on some spots as a multiple of that on others.
Ratio of_spots(const Group& group, const Chosen& above, const Chosen& below) {
  SumPairs draws;
  group.each("composed", [&](const SelfLocalizationRow& row) {
    if (!row.ok()) return;
    if (above(row.spot)) draws[row.draw].first.add(row.distance());
    if (below(row.spot)) draws[row.draw].second.add(row.distance());
  });
  return ratio_of(draws);
}

// Mean position error of the composed method by spot, the best first.
std::string order_of_spots(const Group& group, const SelfLocalizationSettings& settings) {
  std::vector<Sum> sums(settings.spots.size());
  group.each("composed", [&](const SelfLocalizationRow& row) {
    if (row.ok()) sums[static_cast<std::size_t>(row.spot)].add(row.distance());
  });
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count > 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return sums[a].mean() < sums[b].mean(); });
  std::string text;
  for (const std::size_t i : order) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", settings.spots[i].name, cm(sums[i].mean()));
  }
  return text;
}

bool is_a_or_c(const SelfLocalizationSettings& settings, int spot) {
  const std::string& name = settings.spots[static_cast<std::size_t>(spot)].name;
  return name == "A" || name == "C";
}

Observation::Ours axis_best(const Group& group, const SelfLocalizationSettings& settings) {
  const auto on_axis = [&](int spot) { return settings.spots[static_cast<std::size_t>(spot)].place.x() == 0.0; };
  const Ratio r = of_spots(group, on_axis, [&](int spot) { return !on_axis(spot); });
  return {group.knowledge, fmt::format("{} times the others", text_of(r)), below_one({r})};
}

// The worst are worse than every other spot, not only than their mean.
Observation::Ours a_and_c_worst(const Group& group, const SelfLocalizationSettings& settings) {
  const auto worst = [&](int spot) { return is_a_or_c(settings, spot); };
  std::vector<Ratio> others;
  for (int other = 0; other < static_cast<int>(settings.spots.size()); ++other) {
    const auto is_other = [other](int spot) { return spot == other; };
    if (!worst(other)) others.push_back(of_spots(group, is_other, worst));
  }
  const Ratio mean = of_spots(group, worst, [&](int spot) { return !worst(spot); });
  return {group.knowledge,
          fmt::format("{} times the mean of the others; in cm {}", text_of(mean), order_of_spots(group, settings)),
          below_one(others)};
}

// Why A and C were the paper's worst: is a goal without its bearing more frequent there?
Observation::Ours goal_lost(const Group& group, const SelfLocalizationSettings& settings) {
  int lost = 0, asked = 0, lost_elsewhere = 0, asked_elsewhere = 0;
  group.each("composed", [&](const SelfLocalizationRow& row) {
    const bool here = is_a_or_c(settings, row.spot);
    const bool one = row.status == movis::word(FixStatus::one_goal) || row.status == movis::word(FixStatus::no_goal);
    (here ? asked : asked_elsewhere) += 1;
    (here ? lost : lost_elsewhere) += one ? 1 : 0;
  });
  const Interval here = wilson_interval(lost, asked), elsewhere = wilson_interval(lost_elsewhere, asked_elsewhere);
  const char* verdict = lost + lost_elsewhere == 0  ? kUntested
                        : here.low > elsewhere.high ? kAgrees
                        : lost == 0                 ? kDiffers
                                                    : kUndecided;
  return {group.knowledge,
          fmt::format("a goal was not seen in {} of {} on A and C, {} of {} elsewhere", lost, asked, lost_elsewhere,
                      asked_elsewhere),
          verdict};
}

int draws_of(const Group& group) {
  std::set<int> draws;
  for (const SelfLocalizationRow& row : group.rows) {
    if (row.goals == group.goals && row.knowledge == group.knowledge) draws.insert(row.draw);
  }
  return static_cast<int>(draws.size());
}

}  // namespace

LocalizerRatio localizer_ratio(const std::vector<SelfLocalizationRow>& rows, Field::Goals goals, Knowledge knowledge,
                               std::string_view one, std::string_view other) {
  const Group group{rows, goals, knowledge};
  std::map<std::tuple<int, int, int>, double> answers;  // draw, spot, heading
  group.each(one, [&](const SelfLocalizationRow& row) {
    if (row.ok()) answers[{row.draw, row.spot, row.heading}] = row.distance();
  });
  SumPairs draws;
  LocalizerRatio result;
  group.each(other, [&](const SelfLocalizationRow& row) {
    const auto found = answers.find({row.draw, row.spot, row.heading});
    if (!row.ok() || found == answers.end()) return;
    draws[row.draw].first.add(found->second);
    draws[row.draw].second.add(row.distance());
    ++result.cases;
  });
  result.ratio = ratio_of(draws);
  return result;
}

std::vector<Observation> observations_of(const SelfLocalizationSettings& settings, const Rows& rows) {
  std::vector<Observation> observations{{"Method 1 is better in X than in Y", {}},
                                        {"Method 2 is better in Y than in X", {}},
                                        {"The composed method is the best of the three", {}},
                                        {"The spots on the Y axis (B, E, H) are better than the others", {}},
                                        {"A and C are the worst spots", {}},
                                        {"because the blue goal was lost there", {}}};
  for (const Knowledge knowledge : kLocalizationKnowledges) {
    const Group group{rows, Field::Goals::coloured, knowledge};
    const int draws = draws_of(group);
    if (draws == 0) continue;
    const auto add = [&](std::size_t observation, Observation::Ours ours) {
      if (draws < kFewestDraws && ours.verdict != kUntested) {
        ours.verdict = fmt::format("{}: fewer than {} draws", kUndecided, kFewestDraws);
      }
      observations[observation].ours.push_back(std::move(ours));
    };
    add(0, better_axis(group, "method1", 0, 1));
    add(1, better_axis(group, "method2", 1, 0));
    add(2, composed_best(group));
    add(3, axis_best(group, settings));
    add(4, a_and_c_worst(group, settings));
    add(5, goal_lost(group, settings));
  }
  observations.erase(
      std::remove_if(observations.begin(), observations.end(), [](const Observation& o) { return o.ours.empty(); }),
      observations.end());
  return observations;
}

namespace {

// Our localizers beside the paper's best.
Finding against_composed(const SelfLocalizationSummary& summary, const Rows& rows) {
  Finding finding{"Beside the composed method", {}};
  for (const std::string_view localizer : localizers_for(summary.settings, Field::Goals::coloured)) {
    if (localizer == "composed" || localizer == "method1" || localizer == "method2") continue;
    for (const Knowledge knowledge : kLocalizationKnowledges) {
      const LocalizerRatio r = localizer_ratio(rows, Field::Goals::coloured, knowledge, localizer, "composed");
      if (r.cases == 0) continue;
      finding.sentences.push_back(fmt::format(
          "With {}, {}'s mean position error is {} times that of composed, over the {} fixes that both have.",
          rig_words(knowledge), localizer, text_of(r.ratio), r.cases));
    }
  }
  return finding;
}

// The same draws and noise with goals of either colour.
Finding of_white_goals(const SelfLocalizationSummary& summary) {
  Finding finding{"With white goals", {}};
  for (const std::string_view localizer : localizers_for(summary.settings, Field::Goals::white)) {
    for (const Knowledge knowledge : kLocalizationKnowledges) {
      const auto* white = summary.find(Field::Goals::white, knowledge, localizer, kAllSpots);
      const auto* coloured = summary.find(Field::Goals::coloured, knowledge, localizer, kAllSpots);
      if (white == nullptr || coloured == nullptr) continue;
      const auto text = [](const SelfLocalizationCell& cell) {
        const double share = 100.0 * cell.ok / cell.asked;
        if (cell.ok == 0) return fmt::format("{:.1f} % of the cases", share);
        return fmt::format("{:.1f} % of the cases and errs by {} cm on average", share, cm(cell.position.mean));
      };
      finding.sentences.push_back(fmt::format("With {}, {} has a pose in {}; with coloured goals in {}.",
                                              rig_words(knowledge), localizer, text(*white), text(*coloured)));
    }
  }
  return finding;
}

// A pose that is said to be ok and is not.
Finding of_wrong_fixes(const SelfLocalizationSummary& summary) {
  Finding finding{fmt::format("Fixes that are ok, yet off by more than {:.0f} cm", 100.0 * kFarOff), {}};
  for (const SelfLocalizationCell& cell : summary.cells) {
    if (cell.spot != kAllSpots || cell.far_off == 0) continue;
    const Interval rate = wilson_interval(cell.far_off, cell.ok);
    finding.sentences.push_back(fmt::format("{}, {} goals, with {}: {} of {}, {:.2f} % ({:.2f}–{:.2f} %), up to {} cm.",
                                            cell.localizer, word(cell.goals), rig_words(cell.knowledge), cell.far_off,
                                            cell.ok, 100.0 * cell.far_off / cell.ok, 100.0 * rate.low,
                                            100.0 * rate.high, cm(cell.position.largest)));
  }
  if (finding.sentences.empty() && !summary.cells.empty()) finding.sentences.emplace_back("There are none.");
  return finding;
}

}  // namespace

std::vector<Finding> findings_of(const SelfLocalizationSummary& summary, const Rows& rows) {
  std::vector<Finding> findings{against_composed(summary, rows), of_white_goals(summary), of_wrong_fixes(summary)};
  findings.erase(std::remove_if(findings.begin(), findings.end(), [](const Finding& f) { return f.sentences.empty(); }),
                 findings.end());
  return findings;
}

}  // namespace movis::experiments
