#include "measurement_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "measurement_bench.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/status.h"
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

constexpr const char* kMend = "the file was changed: remove it and run again";

template <typename Number>
Number number_of(const std::string& cell, const std::string& where) {
  Number value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(static_cast<double>(value))) {
    throw Error("{}: '{}' stands where a number should; {}", where, cell, kMend);
  }
  return value;
}

void check_status(const std::string& status, const std::string& where) {
  constexpr std::array kStatuses{PointStatus::ok,
                                 PointStatus::not_seen,
                                 PointStatus::one_camera,
                                 PointStatus::parallel_rays,
                                 PointStatus::behind_camera,
                                 PointStatus::contradiction};
  if (status == kNotCalibrated) return;
  if (std::any_of(kStatuses.begin(), kStatuses.end(), [&](PointStatus s) { return status == movis::word(s); })) return;
  throw Error("{}: there is no status '{}'; {}", where, status, kMend);
}

std::vector<std::string> row_cells(const std::string& line, const std::string& where) {
  std::vector<std::string> cells = cells_of(line);
  if (cells.size() == kColumns) return cells;
  throw Error("{}: the row has {} cells instead of {}; {}", where, cells.size(), static_cast<int>(kColumns), kMend);
}

// Every whole line but the header.
std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream) throw Error("{}: cannot be read; check that it is a file and may be read", file.string());
  const std::string header = rows_header() + '\n';
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

void check_origin(const std::vector<std::string>& cells, const MeasurementSettings& settings, const fs::path& file) {
  if (cells[kVersion] != version()) {
    throw Error("{}: its rows are of movis {}, this is {}; name another folder with --out", file.string(),
                cells[kVersion], version());
  }
  if (cells[kDigest] != settings.digest) {
    throw Error(
        "{}: its rows are of other settings: the experiment's file or one that it names has changed, or --quick "
        "was given to one run only; name another folder with --out",
        file.string());
  }
}

}  // namespace

RowPlan::RowPlan(const MeasurementSettings& settings) : blocks_(blocks_of(settings)) {
  for (std::size_t i = 0; i < kDifferences.size(); ++i) lattices_[i] = lattice_of(settings, kDifferences[i]);
}

const MeasurementBlock* RowPlan::block(std::int64_t number) const {
  const auto after =
      std::upper_bound(blocks_.begin(), blocks_.end(), number,
                       [](std::int64_t sought, const MeasurementBlock& block) { return sought < block.first_row; });
  if (after == blocks_.begin()) return nullptr;
  const MeasurementBlock& block = *std::prev(after);
  return number < block.first_row + block.rows ? &block : nullptr;
}

std::optional<MeasurementRow> RowPlan::row(std::int64_t number) const {
  const MeasurementBlock* of = block(number);
  if (of == nullptr) return std::nullopt;
  const std::vector<Knowledge> knowledges = knowledges_of(of->differences);
  const std::vector<int> systems = systems_of(of->rig);
  const auto in_block = static_cast<std::size_t>(number - of->first_row);
  const std::size_t point = in_block / (knowledges.size() * systems.size());
  MeasurementRow row;
  row.row = number;
  row.level = of->level;
  row.differences = of->differences;
  row.draw = of->draw;
  row.point = static_cast<int>(point);
  row.system = systems[in_block % systems.size()];
  row.knowledge = knowledges[in_block / systems.size() % knowledges.size()];
  row.place = lattices_.at(static_cast<std::size_t>(of->differences)).points.at(point);
  return row;
}

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

MeasurementRow parse_row(const std::string& line, const MeasurementSettings& settings, std::uint64_t seed,
                         const RowPlan& plan, const std::string& where) {
  const std::vector<std::string> cells = row_cells(line, where);
  const auto number = number_of<std::int64_t>(cells[kRow], where);
  const std::optional<MeasurementRow> planned = plan.row(number);
  if (!planned) throw Error("{}: this experiment has no row {}; {}", where, number, kMend);
  MeasurementRow row = *planned;
  row.status = cells[kStatus];
  check_status(row.status, where);
  if (row.status == movis::word(PointStatus::ok)) {
    row.distance_error = number_of<double>(cells[kDistance], where);
    row.direction_error = radians(number_of<double>(cells[kDirection], where));
  }
  const std::vector<std::string> expected = cells_of(line_of(row, settings, seed));
  const std::vector<std::string> columns = cells_of(rows_header());
  for (std::size_t i = 0; i < kColumns; ++i) {
    if (cells[i] == expected[i]) continue;
    throw Error("{}: '{}' stands in column {} where row {} has '{}'; {}", where, cells[i], columns[i], number,
                expected[i], kMend);
  }
  return row;
}

StoredRows read_rows(const fs::path& file, const MeasurementSettings& settings, const RowPlan& plan) {
  StoredRows stored;
  std::size_t at = 1;
  for (std::string& line : lines_of(file)) {
    const std::string where = fmt::format("{}:{}", file.string(), ++at);
    const std::vector<std::string> cells = row_cells(line, where);
    if (stored.lines.empty()) {
      check_origin(cells, settings, file);
      stored.seed = number_of<std::uint64_t>(cells[kSeed], where);
    }
    const std::int64_t number = parse_row(line, settings, stored.seed, plan, where).row;
    if (!stored.lines.emplace(number, std::move(line)).second) {
      throw Error("{}: row {} stands here for the second time; {}", where, number, kMend);
    }
  }
  return stored;
}

}  // namespace movis::experiments
