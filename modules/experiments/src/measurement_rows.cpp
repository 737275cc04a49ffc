#include "measurement_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "measurement_bench.h"
#include "movis/core/angle.h"
#include "movis/core/status.h"
#include "movis/core/version.h"

namespace movis::experiments {
namespace {

constexpr const char* kHeader =
    "row,version,settings,seed,level,differences,draw,point,x,y,system,knowledge,status,distance_error_m,"
    "direction_error_deg";
enum Column { kStatus = 12, kDistance, kDirection };

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

// The planned row with its answer.
MeasurementRow answered(std::int64_t number, const Cells& cells, const RowPlan& plan, const std::string& where) {
  MeasurementRow row = plan.row(number).value();
  row.status = cells[kStatus];
  check_status(row.status, where);
  if (row.status == movis::word(PointStatus::ok)) {
    row.distance_error = number_of<double>(cells[kDistance], where);
    row.direction_error = radians(number_of<double>(cells[kDirection], where));
  }
  return row;
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

std::string line_of(const MeasurementRow& row, const MeasurementSettings& settings, std::uint64_t seed) {
  std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{:g},{:g},{},{},{},", row.row, version(), settings.digest, seed,
                  word(row.level), word(row.differences), row.draw, row.point, row.place.x(), row.place.y(),
                  kSystems.at(static_cast<std::size_t>(row.system)).name, word(row.knowledge), row.status);
  if (row.status != "ok") return line + ',';
  return line + fmt::format("{:.7g},{:.7g}", row.distance_error, degrees(row.direction_error));
}

MeasurementRow row_of(const std::string& line, const RowPlan& plan) {
  return answered(row_number(line), cells_of(line), plan, "a row");
}

RowFormat format_of(const MeasurementSettings& settings, const RowPlan& plan) {
  RowFormat format{kHeader, settings.digest, {}, {}};
  for (const MeasurementBlock& block : plan.blocks()) format.blocks.push_back({block.first_row, block.rows});
  format.line = [&](std::int64_t row, const Cells& cells, std::uint64_t seed, const std::string& where) {
    return line_of(answered(row, cells, plan, where), settings, seed);
  };
  return format;
}

}  // namespace movis::experiments
