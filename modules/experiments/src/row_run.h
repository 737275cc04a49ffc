#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "movis/experiments/experiment.h"
#include "row_file.h"

// How the blocks of any experiment are made, kept and made again.
namespace movis::experiments {

// The lines of a block, from the seed alone. Called from several threads at once.
using MakeBlock = std::function<std::vector<std::string>(std::size_t block)>;

// Makes what `folder`/rows.csv does not hold yet; the lines of every finished block stand there at once, and in the end
// all of them are there in order, and are returned. Throws an Error, before anything is made and with rows.csv as it
// was, where the folder or one of rows.csv, summary.json and index.html in it cannot be written; where rows.csv exists
// and is not to be resumed, or is to be resumed and does not exist, is of other settings, another seed or another
// version, or holds a row that is not one of this experiment.
std::vector<std::string> run_blocks(const RowFormat& format, const ExperimentRun& run,
                                    const std::filesystem::path& folder, const MakeBlock& make);

// A row of `folder`/rows.csv with the file's seed; the rest as of read_rows. An Error where it is not there.
struct StoredRow {
  std::string line;
  std::uint64_t seed = 0;
};
StoredRow stored_row(const RowFormat& format, std::int64_t row, const std::filesystem::path& folder);

}  // namespace movis::experiments
