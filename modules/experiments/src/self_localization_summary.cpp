#include <cmath>
#include <map>
#include <tuple>

#include "movis/core/chi2.h"
#include "movis/experiments/self_localization.h"
#include "resampling.h"
#include "self_localization_findings.h"

namespace movis::experiments {
namespace {

using Rows = std::vector<const SelfLocalizationRow*>;
using Key = std::tuple<Field::Goals, Knowledge, std::string_view, int>;

// Of the ok rows' magnitudes.
template <typename Magnitude>
ErrorStatistics statistics_over(const Rows& rows, Magnitude magnitude) {
  std::vector<double> magnitudes;
  std::map<int, Sum> by_draw;
  for (const SelfLocalizationRow* row : rows) {
    Sum& sum = by_draw[row->draw];
    if (!row->ok()) continue;
    magnitudes.push_back(magnitude(*row));
    sum.add(magnitudes.back());
  }
  std::vector<Sum> sums;
  for (const auto& [draw, sum] : by_draw) sums.push_back(sum);
  ErrorStatistics result = statistics_of(std::move(magnitudes), sums);
  if (sums.size() < kFewestDraws) result.mean_interval = {kUnknown, kUnknown};
  return result;
}

void add_statistics(const Rows& rows, SelfLocalizationCell& cell) {
  const double limit = chi2_limit(3, 1.645);  // one-sided: exceeded by 5 %
  Sum nees, within;
  for (const SelfLocalizationRow* row : rows) {
    ++cell.asked;
    if (!row->ok()) continue;
    ++cell.ok;
    if (row->distance() > kFarOff) ++cell.far_off;
    if (std::isfinite(row->nees)) nees.add(row->nees);
    within.add(row->nees <= limit ? 1.0 : 0.0);
  }
  cell.nees = nees.mean();
  cell.within = within.mean();
  cell.position = statistics_over(rows, [](const auto& row) { return row.distance(); });
  cell.x = statistics_over(rows, [](const auto& row) { return std::abs(row.error.x()); });
  cell.y = statistics_over(rows, [](const auto& row) { return std::abs(row.error.y()); });
  cell.beta = statistics_over(rows, [](const auto& row) { return std::abs(row.error.z()); });
}

void add_headings(const Rows& rows, int headings, SelfLocalizationCell& cell) {
  std::vector<Sum> sums(static_cast<std::size_t>(headings));
  for (const SelfLocalizationRow* row : rows) {
    if (row->draw == 0) cell.first.push_back(*row);
    if (row->ok()) sums.at(static_cast<std::size_t>(row->heading)).add(row->distance());
  }
  for (const Sum& sum : sums) cell.position_by_heading.push_back(sum.mean());
}

}  // namespace

const SelfLocalizationCell* SelfLocalizationSummary::find(Field::Goals goals, Knowledge knowledge,
                                                          std::string_view localizer, int spot) const {
  for (const SelfLocalizationCell& cell : cells) {
    if (cell.goals == goals && cell.knowledge == knowledge && cell.localizer == localizer && cell.spot == spot) {
      return &cell;
    }
  }
  return nullptr;
}

SelfLocalizationSummary summarize_self_localization(const SelfLocalizationSettings& settings, std::uint64_t seed,
                                                    const std::vector<SelfLocalizationRow>& rows) {
  SelfLocalizationSummary summary;
  summary.settings = settings;
  summary.seed = seed;
  std::map<Key, Rows> cells;
  for (const SelfLocalizationRow& row : rows) {
    for (const int spot : {kAllSpots, row.spot}) cells[{row.goals, row.knowledge, row.localizer, spot}].push_back(&row);
  }
  for (const Field::Goals goals : {Field::Goals::coloured, Field::Goals::white}) {
    for (const Knowledge knowledge : kLocalizationKnowledges) {
      for (const std::string_view localizer : localizers_for(settings, goals)) {
        for (int spot = kAllSpots; spot < static_cast<int>(settings.spots.size()); ++spot) {
          const auto found = cells.find({goals, knowledge, localizer, spot});
          if (found == cells.end()) continue;
          SelfLocalizationCell cell;
          cell.goals = goals;
          cell.knowledge = knowledge;
          cell.localizer = localizer;
          cell.spot = spot;
          add_statistics(found->second, cell);
          if (spot != kAllSpots) add_headings(found->second, settings.headings(), cell);
          summary.cells.push_back(std::move(cell));
        }
      }
    }
  }
  summary.observations = observations_of(settings, rows);
  summary.findings = findings_of(summary, rows);
  return summary;
}

}  // namespace movis::experiments
