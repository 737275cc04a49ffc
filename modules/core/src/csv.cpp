#include "movis/core/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <set>
#include <string_view>

#include "movis/core/error.h"

namespace movis {
namespace {

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (;;) {
    const auto comma = line.find(',');
    cells.emplace_back(trim(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

template <typename Number>
bool parse(const std::string& text, Number& value) {
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  return error == std::errc{} && stopped == end;
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error("{}: cannot be opened; check that it exists and may be read", file.string());
  CsvTable table;
  table.file_ = file;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);  // the byte order mark of some editors
    if (trim(text).empty()) continue;
    std::vector<std::string> cells = split(text);
    if (table.header_.empty()) {
      if (std::set<std::string>(cells.begin(), cells.end()).size() != cells.size()) {
        throw Error("{}:{}: a column name stands twice in the header", file.string(), line);
      }
      table.header_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.header_.size()) {
      throw Error("{}:{}: {} cells where the header has {} columns; is the line complete?", file.string(), line,
                  cells.size(), table.header_.size());
    }
    table.rows_.push_back({line, std::move(cells)});
  }
  if (stream.bad()) throw Error("{}: reading failed", file.string());
  if (table.header_.empty()) throw Error("{}: is empty; it needs a header line", file.string());
  return table;
}

std::optional<std::size_t> CsvTable::find_column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header_.begin());
}

std::size_t CsvTable::column(const std::string& name) const {
  if (const auto found = find_column(name)) return *found;
  throw Error("{}:1: the column '{}' is missing from the header", file_.string(), name);
}

std::string CsvTable::where(std::size_t row, std::size_t column) const {
  return fmt::format("{}:{}: column '{}'", file_.string(), rows_[row].line, header_[column]);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  double value = 0.0;
  if (!parse(text(row, column), value) || !std::isfinite(value)) {
    throw Error("{}: '{}' is not a finite number", where(row, column), text(row, column));
  }
  return value;
}

std::int64_t CsvTable::integer(std::size_t row, std::size_t column) const {
  std::int64_t value = 0;
  if (!parse(text(row, column), value)) {
    throw Error("{}: '{}' is not a whole number", where(row, column), text(row, column));
  }
  return value;
}

}  // namespace movis
