#include "movis/experiments/measurement.h"

#include "measurement_bench.h"
#include "measurement_rows.h"
#include "row_run.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

int draws_of(const MeasurementSettings& settings, Level level, Differences differences) {
  if (level == Level::images) return differences == Differences::all ? settings.image_draws : 0;
  return differences == Differences::all ? settings.bearing_draws : settings.alone_draws;
}

}  // namespace

std::vector<MeasurementBlock> blocks_of(const MeasurementSettings& settings) {
  std::vector<MeasurementBlock> blocks;
  std::int64_t row = 0;
  for (const Level level : kLevels) {
    for (const Differences differences : kDifferences) {
      const auto points = static_cast<std::int64_t>(lattice_of(settings, differences).points.size());
      const auto knowledges = static_cast<std::int64_t>(knowledges_of(differences).size());
      for (int draw = 0; draw < draws_of(settings, level, differences); ++draw) {
        for (const RigIndex rig : {kSingleRig, kVerticalRig, kShortVerticalRig, kMovisRig}) {
          const std::int64_t rows = points * knowledges * static_cast<std::int64_t>(systems_of(rig).size());
          blocks.push_back({level, differences, draw, rig, row, rows});
          row += rows;
        }
      }
    }
  }
  return blocks;
}

std::vector<MeasurementRow> run_measurement(const MeasurementSettings& settings, const ExperimentRun& run,
                                            const fs::path& folder) {
  const RowPlan plan(settings);
  const auto measure = [&](std::size_t block) {
    MeasurementBench bench(settings, run.seed, plan.blocks()[block]);
    std::vector<MeasurementRow> rows;
    for (int point = 0; point < static_cast<int>(bench.lattice().points.size()); ++point) bench.measure(point, rows);
    std::vector<std::string> lines;
    lines.reserve(rows.size());
    for (const MeasurementRow& row : rows) lines.push_back(line_of(row, settings, run.seed));
    return lines;
  };
  std::vector<MeasurementRow> rows;
  // What stands in the file is what is evaluated, resumed or not.
  for (const std::string& line : run_blocks(format_of(settings, plan), run, folder, measure)) {
    rows.push_back(row_of(line, plan));
  }
  return rows;
}

ReplayedRow replay_measurement(const MeasurementSettings& settings, std::int64_t row, const fs::path& folder) {
  const RowPlan plan(settings);
  const RowFormat format = format_of(settings, plan);
  const StoredRow stored = stored_row(format, row, folder);
  MeasurementBench bench(settings, stored.seed, *plan.block(row));
  std::vector<MeasurementRow> rows;
  bench.measure(plan.row(row)->point, rows);
  const MeasurementRow& again = rows.at(static_cast<std::size_t>(row - rows.front().row));
  return {format.header, stored.line, line_of(again, settings, stored.seed)};
}

}  // namespace movis::experiments
