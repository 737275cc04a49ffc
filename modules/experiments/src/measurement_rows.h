#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "movis/experiments/measurement.h"
#include "row_file.h"

namespace movis::experiments {

// Which row has which number.
class RowPlan {
 public:
  explicit RowPlan(const MeasurementSettings& settings);

  const std::vector<MeasurementBlock>& blocks() const { return blocks_; }
  const MeasurementBlock* block(std::int64_t number) const;      // null: the experiment has no such row
  std::optional<MeasurementRow> row(std::int64_t number) const;  // with neither status nor errors

 private:
  std::vector<MeasurementBlock> blocks_;
  std::array<Lattice, kDifferences.size()> lattices_;
};

// rows.csv of this experiment. The plan must outlive the format.
RowFormat format_of(const MeasurementSettings& settings, const RowPlan& plan);

// A row as a line, without its end, and back.
std::string line_of(const MeasurementRow& row, const MeasurementSettings& settings, std::uint64_t seed);
MeasurementRow row_of(const std::string& line, const RowPlan& plan);

}  // namespace movis::experiments
