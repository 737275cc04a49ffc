#include "row_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "movis/core/version.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

enum Column { kRow, kVersion, kDigest, kSeed };  // that rows of all experiments begin with

Cells row_cells(const std::string& line, const RowFormat& format, const std::string& where) {
  const std::size_t columns = cells_of(format.header).size();
  Cells cells = cells_of(line);
  if (cells.size() == columns) return cells;
  throw Error("{}: the row has {} cells instead of {}; {}", where, cells.size(), columns, kMend);
}

// Every whole line but the header.
std::vector<std::string> lines_of(const fs::path& file, const RowFormat& format) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw Error("{}: cannot be read; check that it is a file and may be read", file.string());
  const std::string header = format.header + '\n';
  if (bytes.empty()) return {};
  if (bytes.compare(0, header.size(), header) != 0) {
    throw Error("{}:1: is not the header of this experiment's rows; name another folder with --out", file.string());
  }
  std::vector<std::string> lines;
  std::size_t from = header.size();
  for (std::size_t end = bytes.find('\n', from); end != std::string::npos; end = bytes.find('\n', from)) {
    lines.push_back(bytes.substr(from, end - from));
    from = end + 1;
  }
  return lines;
}

void check_origin(const Cells& cells, const RowFormat& format, const fs::path& file) {
  if (cells[kVersion] != version()) {
    throw Error("{}: its rows are of movis {}, this is {}; name another folder with --out", file.string(),
                cells[kVersion], version());
  }
  if (cells[kDigest] != format.digest) {
    throw Error(
        "{}: its rows are of other settings: the experiment's file or one that it names has changed, or --quick "
        "was given to one run only; name another folder with --out",
        file.string());
  }
}

// Each cell must be what the experiment writes.
void check_row(std::int64_t row, const Cells& cells, const RowFormat& format, std::uint64_t seed,
               const std::string& where) {
  if (block_of(format.blocks, row) == format.blocks.size()) {
    throw Error("{}: this experiment has no row {}; {}", where, row, kMend);
  }
  const Cells expected = cells_of(format.line(row, cells, seed, where));
  const Cells columns = cells_of(format.header);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (cells[i] == expected[i]) continue;
    throw Error("{}: '{}' stands in column {} where row {} has '{}'; {}", where, cells[i], columns[i], row, expected[i],
                kMend);
  }
}

}  // namespace

Cells cells_of(const std::string& line) {
  Cells cells;
  std::size_t from = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', from)) {
    cells.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  cells.push_back(line.substr(from));
  return cells;
}

std::int64_t row_number(const std::string& line) {
  return number_of<std::int64_t>(line.substr(0, line.find(',')), "a row");
}

std::size_t block_of(const std::vector<RowBlock>& blocks, std::int64_t row) {
  const auto after =
      std::upper_bound(blocks.begin(), blocks.end(), row,
                       [](std::int64_t sought, const RowBlock& block) { return sought < block.first_row; });
  if (after == blocks.begin()) return blocks.size();
  const RowBlock& block = *std::prev(after);
  return row < block.first_row + block.rows ? static_cast<std::size_t>(std::prev(after) - blocks.begin())
                                            : blocks.size();
}

StoredRows read_rows(const fs::path& file, const RowFormat& format) {
  StoredRows stored;
  std::size_t at = 1;
  for (std::string& line : lines_of(file, format)) {
    const std::string where = fmt::format("{}:{}", file.string(), ++at);
    const Cells cells = row_cells(line, format, where);
    if (stored.lines.empty()) {
      check_origin(cells, format, file);
      stored.seed = number_of<std::uint64_t>(cells[kSeed], where);
    }
    const auto row = number_of<std::int64_t>(cells[kRow], where);
    check_row(row, cells, format, stored.seed, where);
    if (!stored.lines.emplace(row, std::move(line)).second) {
      throw Error("{}: row {} stands here for the second time; {}", where, row, kMend);
    }
  }
  return stored;
}

}  // namespace movis::experiments
