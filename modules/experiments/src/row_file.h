#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "movis/core/error.h"

// rows.csv, which every experiment writes: one line a row, numbered from 0. A row's number tells every cell but those of
// the answer, so that whatever else stands in a file is no row of the experiment.
namespace movis::experiments {

using Cells = std::vector<std::string>;

// Rows that are made at once.
struct RowBlock {
  std::int64_t first_row = 0;
  std::int64_t rows = 0;
};

// Which rows an experiment has and how they read.
struct RowFormat {
  std::string header;            // of the columns; the first ones are row,version,settings,seed
  std::string digest;            // of the settings
  std::vector<RowBlock> blocks;  // one after the other from row 0
  // The line of a row of this experiment with the answer that stands in these cells; an Error that begins with `where`
  // where a cell of the answer cannot be read.
  std::function<std::string(std::int64_t row, const Cells& cells, std::uint64_t seed, const std::string& where)> line;
};

// The rows of a file as they stand.
struct StoredRows {
  std::map<std::int64_t, std::string> lines;  // by number
  std::uint64_t seed = 0;                     // means nothing where there are no lines
};

Cells cells_of(const std::string& line);

// The file whose row cannot be read was changed by somebody.
inline constexpr const char* kMend = "the file was changed: remove it and run again";

template <typename Number>
Number number_of(const std::string& cell, const std::string& where) {
  Number value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(static_cast<double>(value))) {
    throw Error("{}: '{}' stands where a number should; {}", where, cell, kMend);
  }
  return value;
}

// The number of a line, which is one of these rows'.
std::int64_t row_number(const std::string& line);

// In which block a row is; the number of blocks where the experiment has no such row.
std::size_t block_of(const std::vector<RowBlock>& blocks, std::int64_t row);

// Only reads; a last line that was not written to its end counts as not there. Throws an Error with file and line where
// the file is not one of ours, its rows are of another version or of other settings, or a row is not one of this
// experiment.
StoredRows read_rows(const std::filesystem::path& file, const RowFormat& format);

}  // namespace movis::experiments
