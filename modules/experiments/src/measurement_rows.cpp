#include "measurement_rows.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <iterator>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/version.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeader =
    "row,version,settings,seed,level,differences,draw,point,x,y,system,knowledge,status,distance_error_m,"
    "direction_error_deg";
enum Column {
  kRow,
  kVersion,
  kDigest,
  kSeed,
  kLevel,
  kDifference,
  kDraw,
  kPoint,
  kX,
  kY,
  kSystem,
  kKnowledge,
  kStatus,
  kDistance,
  kDirection,
  kColumns
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::size_t from = 0;
  for (std::size_t comma = line.find(','); comma != std::string::npos; comma = line.find(',', from)) {
    cells.push_back(line.substr(from, comma - from));
    from = comma + 1;
  }
  cells.push_back(line.substr(from));
  return cells;
}

template <typename Number>
Number number_of(const std::string& cell, const fs::path& file) {
  Number value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) {
    throw Error("{}: '{}' stands where a number should; the file was changed: remove it and run again", file.string(),
                cell);
  }
  return value;
}

template <typename Values>
auto value_of(const std::string& cell, const Values& values, const fs::path& file) {
  for (const auto value : values) {
    if (cell == word(value)) return value;
  }
  throw Error("{}: holds the unknown word '{}'; the file was changed: remove it and run again", file.string(), cell);
}

// A run that was killed may leave half a line, which nobody misses: its block is measured again.
void cut_unfinished_line(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  stream.close();
  const std::size_t end = bytes.rfind('\n');
  const std::size_t whole = end == std::string::npos ? 0 : end + 1;
  if (whole < bytes.size()) fs::resize_file(file, whole);
}

}  // namespace

std::string rows_header() {
  return kHeader;
}

std::string line_of(const MeasurementRow& row, const MeasurementSettings& settings, std::uint64_t seed) {
  std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{:g},{:g},{},{},{},", row.row, version(), settings.digest, seed,
                  word(row.level), word(row.differences), row.draw, row.point, row.place.x(), row.place.y(),
                  kSystems.at(static_cast<std::size_t>(row.system)).name, word(row.knowledge), row.status);
  if (row.status != "ok") return line + ',';
  return line + fmt::format("{:.7g},{:.7g}", row.distance_error, degrees(row.direction_error));
}

MeasurementRow parse_row(const std::string& line, const fs::path& file) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() != kColumns) {
    throw Error("{}: a row has {} cells instead of {}; the file was changed: remove it and run again", file.string(),
                cells.size(), static_cast<int>(kColumns));
  }
  MeasurementRow row;
  row.row = number_of<std::int64_t>(cells[kRow], file);
  row.level = value_of(cells[kLevel], kLevels, file);
  row.differences = value_of(cells[kDifference], kDifferences, file);
  row.draw = number_of<int>(cells[kDraw], file);
  row.point = number_of<int>(cells[kPoint], file);
  row.place = {number_of<double>(cells[kX], file), number_of<double>(cells[kY], file)};
  row.system = -1;
  for (std::size_t i = 0; i < kSystems.size(); ++i) {
    if (cells[kSystem] == kSystems[i].name) row.system = static_cast<int>(i);
  }
  if (row.system < 0) throw Error("{}: there is no system '{}'", file.string(), cells[kSystem]);
  row.knowledge = value_of(cells[kKnowledge], kKnowledges, file);
  row.status = cells[kStatus];
  if (row.status == "ok") {
    row.distance_error = number_of<double>(cells[kDistance], file);
    row.direction_error = radians(number_of<double>(cells[kDirection], file));
  }
  return row;
}

StoredRows read_rows(const fs::path& file) {
  cut_unfinished_line(file);
  std::ifstream stream(file);
  StoredRows stored;
  std::string line;
  if (!std::getline(stream, line)) return stored;
  if (line != kHeader) {
    throw Error("{}:1: is not the header of this experiment's rows; name another folder with --out", file.string());
  }
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    if (cells.size() != kColumns) throw Error("{}: the row '{}' is not complete; remove the file", file.string(), line);
    const auto seed = number_of<std::uint64_t>(cells[kSeed], file);
    if (stored.lines.empty()) {
      stored.version = cells[kVersion];
      stored.digest = cells[kDigest];
      stored.seed = seed;
    } else if (cells[kVersion] != stored.version || cells[kDigest] != stored.digest || seed != stored.seed) {
      throw Error("{}: holds rows of different runs; remove it and run again", file.string());
    }
    stored.lines[number_of<std::int64_t>(cells[kRow], file)] = line;
  }
  return stored;
}

}  // namespace movis::experiments
