#include "self_localization_rows.h"

#include <fmt/format.h>

#include "movis/core/angle.h"
#include "movis/core/status.h"
#include "movis/core/version.h"
#include "resampling.h"

namespace movis::experiments {
namespace {

constexpr const char* kHeader =
    "row,version,settings,seed,goals,draw,spot,heading_deg,rig,localizer,status,symmetric,x_error_m,y_error_m,"
    "beta_error_deg,sigma_x_m,sigma_y_m,sigma_beta_deg,nees";
enum Column { kStatus = 10, kSymmetric, kError, kSigma = kError + 3, kNees = kSigma + 3 };

void check_status(const std::string& status, const std::string& where) {
  if (status == kNotCalibrated) return;
  for (int i = 0; i <= static_cast<int>(FixStatus::bad_fit); ++i) {
    if (status == movis::word(static_cast<FixStatus>(i))) return;
  }
  throw Error("{}: there is no status '{}'; {}", where, status, kMend);
}

Eigen::Vector3d pose_of(const Cells& cells, std::size_t first, const std::string& where) {
  return {number_of<double>(cells[first], where), number_of<double>(cells[first + 1], where),
          radians(number_of<double>(cells[first + 2], where))};
}

SelfLocalizationRow answered(std::int64_t number, const Cells& cells, const SelfLocalizationPlan& plan,
                             const std::string& where) {
  SelfLocalizationRow row = plan.row(number);
  row.status = cells[kStatus];
  check_status(row.status, where);
  if (!row.ok()) return row;
  row.symmetric = cells[kSymmetric] == "1";
  row.error = pose_of(cells, kError, where);
  row.sigma = pose_of(cells, kSigma, where);
  row.nees = cells[kNees].empty() ? kUnknown : number_of<double>(cells[kNees], where);
  return row;
}

}  // namespace

SelfLocalizationPlan::SelfLocalizationPlan(const SelfLocalizationSettings& settings)
    : settings_(settings),
      blocks_(blocks_of(settings)),
      coloured_(localizers_for(settings, Field::Goals::coloured)),
      white_(localizers_for(settings, Field::Goals::white)) {}

std::vector<RowBlock> SelfLocalizationPlan::row_blocks() const {
  std::vector<RowBlock> blocks;
  for (const SelfLocalizationBlock& block : blocks_) blocks.push_back({block.first_row, block.rows});
  return blocks;
}

SelfLocalizationRow SelfLocalizationPlan::row(std::int64_t number) const {
  const SelfLocalizationBlock& block = blocks_.at(block_of(row_blocks(), number));
  const auto& localizers = block.goals == Field::Goals::coloured ? coloured_ : white_;
  auto rest = static_cast<std::size_t>(number - block.first_row);
  const auto take = [&rest](std::size_t count) {
    const std::size_t index = rest % count;
    rest /= count;
    return index;
  };
  SelfLocalizationRow row;
  row.row = number;
  row.goals = block.goals;
  row.draw = block.draw;
  row.localizer = localizers[take(localizers.size())];
  row.knowledge = kLocalizationKnowledges[take(kLocalizationKnowledges.size())];
  row.heading = static_cast<int>(take(static_cast<std::size_t>(settings_.headings())));
  row.spot = static_cast<int>(rest);
  return row;
}

std::string line_of(const SelfLocalizationRow& row, const SelfLocalizationSettings& settings, std::uint64_t seed) {
  std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{},{},{},", row.row, version(), settings.digest, seed, word(row.goals),
                  row.draw, settings.spots.at(static_cast<std::size_t>(row.spot)).name,
                  row.heading * settings.heading_step_deg, word(row.knowledge), row.localizer, row.status);
  if (!row.ok()) return line + ",,,,,,,";
  const auto pose = [&line](const Eigen::Vector3d& v) {
    line += fmt::format(",{:.7g},{:.7g},{:.7g}", v.x(), v.y(), degrees(v.z()));
  };
  line += row.symmetric ? '1' : '0';
  pose(row.error);
  pose(row.sigma);
  return line + (std::isfinite(row.nees) ? fmt::format(",{:.7g}", row.nees) : ",");
}

SelfLocalizationRow row_of(const std::string& line, const SelfLocalizationPlan& plan) {
  return answered(row_number(line), cells_of(line), plan, "a row");
}

RowFormat format_of(const SelfLocalizationPlan& plan) {
  RowFormat format{kHeader, plan.settings().digest, plan.row_blocks(), {}};
  format.line = [&](std::int64_t row, const Cells& cells, std::uint64_t seed, const std::string& where) {
    return line_of(answered(row, cells, plan, where), plan.settings(), seed);
  };
  return format;
}

}  // namespace movis::experiments
