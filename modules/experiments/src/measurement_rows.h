#pragma once

#include <map>
#include <string>
#include <vector>

#include "movis/experiments/measurement.h"

namespace movis::experiments {

// The columns of rows.csv, and a row as a line of it, without its end.
std::string rows_header();
std::string line_of(const MeasurementRow& row, const MeasurementSettings& settings, std::uint64_t seed);

// The rows of a file as they stand, with what they say of their origin.
struct StoredRows {
  std::map<std::int64_t, std::string> lines;  // by number
  std::string version, digest;                // of the first row; empty: there is none
  std::uint64_t seed = 0;
};

// Cuts off a last line that was not written to its end. Throws an Error where the file is not one of ours, or where its
// rows differ in what they come from.
StoredRows read_rows(const std::filesystem::path& file);

// Back from a line of the file, whose place it is for messages.
MeasurementRow parse_row(const std::string& line, const std::filesystem::path& file);

}  // namespace movis::experiments
