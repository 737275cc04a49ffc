#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "movis/experiments/measurement.h"

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

// The columns of rows.csv, and a row as a line of it, without its end.
std::string rows_header();
std::string line_of(const MeasurementRow& row, const MeasurementSettings& settings, std::uint64_t seed);

// The rows of a file as they stand.
struct StoredRows {
  std::map<std::int64_t, std::string> lines;  // by number
  std::uint64_t seed = 0;                     // means nothing where there are no lines
};

// Only reads; a last line that was not written to its end counts as not there. Throws an Error with file and line where
// the file is not one of ours, its rows are of another version or of other settings, or a row is not one of this
// experiment.
StoredRows read_rows(const std::filesystem::path& file, const MeasurementSettings& settings, const RowPlan& plan);

// Back from a line. Everything but status and errors follows from the row's number: an Error, which begins with
// `where`, unless each cell is what line_of writes.
MeasurementRow parse_row(const std::string& line, const MeasurementSettings& settings, std::uint64_t seed,
                         const RowPlan& plan, const std::string& where);

}  // namespace movis::experiments
