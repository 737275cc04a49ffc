#include "movis/experiments/self_localization.h"

#include "row_run.h"
#include "self_localization_bench.h"
#include "self_localization_rows.h"

namespace movis::experiments {

namespace fs = std::filesystem;

std::vector<SelfLocalizationBlock> blocks_of(const SelfLocalizationSettings& settings) {
  std::vector<SelfLocalizationBlock> blocks;
  std::int64_t row = 0;
  for (const Field::Goals goals : {Field::Goals::coloured, Field::Goals::white}) {
    const std::int64_t rows = static_cast<std::int64_t>(settings.spots.size()) * settings.headings() *
                              SelfLocalizationBench::rows_a_pose(settings, goals);
    const int draws = goals == Field::Goals::coloured ? settings.coloured_draws : settings.white_draws;
    for (int draw = 0; draw < draws && rows > 0; ++draw) {
      blocks.push_back({goals, draw, row, rows});
      row += rows;
    }
  }
  return blocks;
}

std::vector<SelfLocalizationRow> run_self_localization(const SelfLocalizationSettings& settings,
                                                       const ExperimentRun& run, const fs::path& folder) {
  const SelfLocalizationPlan plan(settings);
  const auto measure = [&](std::size_t block) {
    SelfLocalizationBench bench(settings, run.seed, plan.blocks()[block]);
    std::vector<SelfLocalizationRow> rows;
    for (int spot = 0; spot < static_cast<int>(settings.spots.size()); ++spot) {
      for (int heading = 0; heading < settings.headings(); ++heading) bench.measure(spot, heading, rows);
    }
    std::vector<std::string> lines;
    lines.reserve(rows.size());
    for (const SelfLocalizationRow& row : rows) lines.push_back(line_of(row, settings, run.seed));
    return lines;
  };
  std::vector<SelfLocalizationRow> rows;
  // What stands in the file is what is evaluated, resumed or not.
  for (const std::string& line : run_blocks(format_of(plan), run, folder, measure)) rows.push_back(row_of(line, plan));
  return rows;
}

ReplayedRow replay_self_localization(const SelfLocalizationSettings& settings, std::int64_t row,
                                     const fs::path& folder) {
  const SelfLocalizationPlan plan(settings);
  const RowFormat format = format_of(plan);
  const StoredRow stored = stored_row(format, row, folder);
  SelfLocalizationBench bench(settings, stored.seed, plan.blocks().at(block_of(format.blocks, row)));
  const SelfLocalizationRow planned = plan.row(row);
  std::vector<SelfLocalizationRow> rows;
  bench.measure(planned.spot, planned.heading, rows);
  const SelfLocalizationRow& again = rows.at(static_cast<std::size_t>(row - rows.front().row));
  return {format.header, stored.line, line_of(again, settings, stored.seed)};
}

}  // namespace movis::experiments
