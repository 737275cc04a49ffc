#include "findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "movis/core/angle.h"

namespace movis::experiments {
namespace {

using Cells = std::vector<const MeasurementCell*>;

std::string length(double metres) {
  const double centimetres = 100.0 * metres;
  return fmt::format("{:.{}f} cm", centimetres, centimetres < 1.0 ? 2 : centimetres < 20.0 ? 1 : 0);
}

const char* title(const MeasurementCell& cell) {
  return kSystems.at(static_cast<std::size_t>(cell.system)).title;
}

std::string on(Level level) {
  return level == Level::bearings ? "On bearings" : "On images";
}

// By mean distance error over the cases that all answered, the best first.
Cells in_order(const MeasurementSummary& summary, Level level, Knowledge knowledge) {
  Cells cells;
  for (const MeasurementCell& cell : summary.cells) {
    if (cell.level == level && cell.differences == Differences::all && cell.knowledge == knowledge && cell.common > 0) {
      cells.push_back(&cell);
    }
  }
  std::sort(cells.begin(), cells.end(),
            [](const auto* a, const auto* b) { return a->common_distance < b->common_distance; });
  return cells;
}

Finding orders(const MeasurementSummary& summary) {
  Finding finding{"The order, by the mean distance error", {}};
  for (const Level level : {Level::images, Level::bearings}) {
    for (const Knowledge knowledge : kKnowledges) {
      const Cells cells = in_order(summary, level, knowledge);
      if (cells.size() < 2) continue;
      std::string order;
      for (const MeasurementCell* cell : cells) {
        order += fmt::format("{}{} {}", order.empty() ? "" : ", ", title(*cell), length(cell->common_distance));
      }
      const int asked = cells.front()->asked;
      const int common = cells.front()->common;
      const std::string cases =
          common < asked ? fmt::format(", over the {} of {} cases that all answered", common, asked) : "";
      finding.sentences.push_back(fmt::format("{}, with {}{}: {}.", on(level), rig_words(knowledge), cases, order));
    }
  }
  return finding;
}

std::string text_of(const Ratio& r) {
  if (!std::isfinite(r.interval.low)) return fmt::format("{:.2f} times", r.ratio);
  return fmt::format("{:.2f} times ({:.2f} to {:.2f})", r.ratio, r.interval.low, r.interval.high);
}

// One way to compare vertical stereo with MOVIS by pairs.
struct Comparison {
  const char* words;
  const char* vertical;
  Knowledge of_vertical;
  Knowledge of_movis;
};
constexpr std::array<Comparison, 6> kComparisons{{
    {"with nominal rigs", "vertical", Knowledge::nominal, Knowledge::nominal},
    {"with both corrected", "vertical", Knowledge::corrected, Knowledge::corrected},
    {"with both exactly known", "vertical", Knowledge::true_rig, Knowledge::true_rig},
    {"with both corrected, vertical stereo short", "vertical-short", Knowledge::corrected, Knowledge::corrected},
    {"with MOVIS corrected and vertical stereo not", "vertical", Knowledge::nominal, Knowledge::corrected},
    {"with MOVIS corrected and vertical stereo short and not", "vertical-short", Knowledge::nominal,
     Knowledge::corrected},
}};

// The paper found MOVIS's distance error remarkably smaller: where does that come out?
Finding against_vertical(const std::vector<MeasurementRow>& rows) {
  constexpr double kRemarkable = 1.5;
  Finding finding{"Vertical stereo and MOVIS by pairs", {}};
  for (const Level level : {Level::images, Level::bearings}) {
    std::string ratios, remarkable, others;
    for (const Comparison& c : kComparisons) {
      const Ratio r = ratio_of(rows, level, c.vertical, c.of_vertical, "movis-pairs", c.of_movis);
      if (!std::isfinite(r.ratio)) continue;
      ratios += fmt::format("{}{} {}", ratios.empty() ? "" : "; ", c.words, text_of(r));
      if (!std::isfinite(r.interval.low)) continue;  // one draw does not tell what is chance
      std::string& where = r.interval.low > kRemarkable ? remarkable : others;
      where += (where.empty() ? "" : "; ") + std::string(c.words);
    }
    if (ratios.empty()) continue;
    finding.sentences.push_back(fmt::format(
        "{}, vertical stereo's mean distance error, where both answered, is this much of that of MOVIS by pairs: {}.",
        on(level), ratios));
    if (remarkable.empty() && others.empty()) continue;
    finding.sentences.push_back(
        fmt::format("{}, MOVIS is remarkably better, in that vertical stereo errs half as much again or more and "
                    "beyond chance: {}. It is not: {}.",
                    on(level), remarkable.empty() ? "nowhere" : remarkable, others.empty() ? "nowhere" : others));
  }
  return finding;
}

Finding against_paper(const MeasurementSummary& summary) {
  Finding finding{"The paper's single camera: 92.63 cm, 0.61°", {}};
  for (const Level level : {Level::images, Level::bearings}) {
    for (const char* system : {"single-elevation", "single-contact"}) {
      const MeasurementCell* cell = summary.find(level, Differences::all, system, Knowledge::nominal);
      if (cell == nullptr || cell->measured == 0) continue;
      finding.sentences.push_back(fmt::format("{}, with the nominal rig, {}: {} and {:.2f}°.", on(level), title(*cell),
                                              length(cell->distance.mean), degrees(cell->direction.mean)));
    }
  }
  return finding;
}

Finding against_bounds(const MeasurementSummary& summary) {
  Finding finding{"Against the Cramér–Rao bound, on bearings with the true rig", {}};
  for (const MeasurementSystem& system : kSystems) {
    const MeasurementCell* cell = summary.find(Level::bearings, Differences::all, system.name, Knowledge::true_rig);
    if (cell == nullptr || cell->measured == 0) continue;
    const double mean = cell->distance.mean;
    std::string sentence = fmt::format("{}: {}", system.title, length(mean));
    if (std::isfinite(cell->free_bound.distance)) {
      sentence +=
          fmt::format(", {:.2f} times the bound of azimuths and elevations alone", mean / cell->free_bound.distance);
    }
    finding.sentences.push_back(
        fmt::format("{}, {:.2f} times the bound of all that its cameras tell.", sentence, mean / cell->bound.distance));
  }
  return finding;
}

// Which kind of difference, alone, costs a system most.
Finding costs(const MeasurementSummary& summary) {
  Finding finding{"Which difference costs most, with the nominal rig on bearings", {}};
  for (const MeasurementSystem& system : kSystems) {
    Cells alone;
    for (const Differences differences : kDifferences) {
      if (differences == Differences::all || differences == Differences::none) continue;
      const MeasurementCell* cell = summary.find(Level::bearings, differences, system.name, Knowledge::nominal);
      if (cell != nullptr && cell->measured > 0) alone.push_back(cell);
    }
    if (alone.size() < 2) continue;
    std::sort(alone.begin(), alone.end(),
              [](const auto* a, const auto* b) { return a->distance.mean > b->distance.mean; });
    const auto part = [](const MeasurementCell& cell) {
      std::string what = word(cell.differences);
      std::replace(what.begin(), what.end(), '_', ' ');
      const std::string missing =
          cell.measured < cell.asked ? fmt::format(", over {} of {} cases", cell.measured, cell.asked) : "";
      return fmt::format("{} ({} alone{})", what, length(cell.distance.mean), missing);
    };
    finding.sentences.push_back(
        fmt::format("{}: {}, then {}; least {}.", system.title, part(*alone[0]), part(*alone[1]), part(*alone.back())));
  }
  return finding;
}

// Where a mean says less than it seems to, by level and system over all knowledges.
Finding cautions(const MeasurementSummary& summary) {
  constexpr double kRuledByFew = 2.0;
  Finding finding{"Read with care", {}};
  std::map<std::pair<Level, int>, std::pair<std::string, std::string>> missing_and_ruled;
  for (const MeasurementCell& cell : summary.cells) {
    if (cell.differences != Differences::all) continue;
    auto& [missing, ruled] = missing_and_ruled[{cell.level, cell.system}];
    if (cell.measured < cell.asked) {
      missing += fmt::format("{}{} {} of {}", missing.empty() ? "" : ", ", word(cell.knowledge),
                             cell.asked - cell.measured, cell.asked);
    }
    if (cell.measured > 0 && cell.distance.rms > kRuledByFew * cell.distance.mean) {
      ruled += fmt::format("{}{} up to {:.1f} m, median {}", ruled.empty() ? "" : ", ", word(cell.knowledge),
                           cell.distance.largest, length(cell.distance.median));
    }
  }
  for (const auto& [key, texts] : missing_and_ruled) {
    const char* system = kSystems.at(static_cast<std::size_t>(key.second)).title;
    if (!texts.first.empty()) {
      finding.sentences.push_back(
          fmt::format("{}, {} has no distance in some cases, and its means are of the others: {}.", on(key.first),
                      system, texts.first));
    }
    if (!texts.second.empty()) {
      finding.sentences.push_back(
          fmt::format("{}, few large errors rule the mean of {}: {}. How large they get depends on the angle below "
                      "which rays count as parallel.",
                      on(key.first), system, texts.second));
    }
  }
  return finding;
}

}  // namespace

std::vector<Finding> findings_of(const MeasurementSummary& summary, const std::vector<MeasurementRow>& rows) {
  std::vector<Finding> findings{orders(summary),         against_vertical(rows), costs(summary),
                                against_bounds(summary), against_paper(summary), cautions(summary)};
  findings.erase(std::remove_if(findings.begin(), findings.end(), [](const Finding& f) { return f.sentences.empty(); }),
                 findings.end());
  return findings;
}

}  // namespace movis::experiments
