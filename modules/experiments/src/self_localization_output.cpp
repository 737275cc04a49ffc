// The summary as a table, as JSON and as a page.
#include <fmt/format.h>

#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/output_file.h"
#include "movis/core/version.h"
#include "movis/experiments/self_localization.h"
#include "movis/report/self_localization_page.h"
#include "summary_numbers.h"

namespace movis::experiments {
namespace {

std::string spot_name(const SelfLocalizationSummary& summary, int spot) {
  return spot == kAllSpots ? "all" : summary.settings.spots.at(static_cast<std::size_t>(spot)).name;
}

Json cell_json(const SelfLocalizationSummary& summary, const SelfLocalizationCell& cell) {
  return {{"goals", word(cell.goals)},
          {"rig", word(cell.knowledge)},
          {"localizer", cell.localizer},
          {"spot", spot_name(summary, cell.spot)},
          {"asked", cell.asked},
          {"ok", cell.ok},
          {"far_off", cell.far_off},
          {"position_m", statistics_json(cell.position, 1.0)},
          {"x_m", statistics_json(cell.x, 1.0)},
          {"y_m", statistics_json(cell.y, 1.0)},
          {"beta_deg", statistics_json(cell.beta, degrees(1.0))},
          {"nees", number(cell.nees)},
          {"within_95", number(cell.within)}};
}

report::LocalizationCell page_cell(const SelfLocalizationCell& cell) {
  report::LocalizationCell shown;
  shown.goals = word(cell.goals);
  shown.knowledge = word(cell.knowledge);
  shown.localizer = cell.localizer;
  shown.spot = cell.spot;
  shown.asked = cell.asked;
  shown.ok = cell.ok;
  shown.far_off = cell.far_off;
  shown.mean = cell.position.mean;
  shown.low = cell.position.mean_interval.low;
  shown.high = cell.position.mean_interval.high;
  shown.median = cell.position.median;
  shown.percentile95 = cell.position.percentile95;
  shown.largest = cell.position.largest;
  shown.x_mean = cell.x.mean;
  shown.x_percentile95 = cell.x.percentile95;
  shown.y_mean = cell.y.mean;
  shown.y_percentile95 = cell.y.percentile95;
  shown.beta_mean_deg = degrees(cell.beta.mean);
  shown.beta_percentile95_deg = degrees(cell.beta.percentile95);
  shown.beta_largest_deg = degrees(cell.beta.largest);
  shown.nees = cell.nees;
  shown.within = cell.within;
  for (const SelfLocalizationRow& row : cell.first) {
    shown.first.push_back({row.status, row.error.x(), row.error.y(), degrees(row.error.z())});
  }
  shown.position_by_heading = cell.position_by_heading;
  return shown;
}

}  // namespace

std::string table_of(const SelfLocalizationSummary& summary) {
  std::string table = fmt::format("  {:<10}{:<11}{:<11}{:>9}{:>9}{:>15}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}\n", "goals",
                                  "rig", "localizer", "poses", "mean cm", "95 % interval", "95 %", "max", "X cm",
                                  "Y cm", "heading°", "far off", "NEES");
  for (const SelfLocalizationCell& cell : summary.cells) {
    if (cell.spot != kAllSpots) continue;
    const ErrorStatistics& p = cell.position;
    const std::string interval =
        std::isfinite(p.mean_interval.low)
            ? fmt::format("{:.2f} – {:.2f}", 100.0 * p.mean_interval.low, 100.0 * p.mean_interval.high)
            : "–";
    table += fmt::format("  {:<10}{:<11}{:<11}{:>9}{:>9}{:>15}{:>8}{:>8}{:>8}{:>8}{:>9}{:>9}{:>8}\n", word(cell.goals),
                         word(cell.knowledge), cell.localizer, fmt::format("{:.1f} %", 100.0 * cell.ok / cell.asked),
                         text(100.0 * p.mean, 2), interval, text(100.0 * p.percentile95, 2), text(100.0 * p.largest, 1),
                         text(100.0 * cell.x.mean, 2), text(100.0 * cell.y.mean, 2), text(degrees(cell.beta.mean), 3),
                         cell.ok > 0 ? fmt::format("{:.2f} %", 100.0 * cell.far_off / cell.ok) : "–",
                         text(cell.nees, cell.nees < 100.0 ? 1 : 0));
  }
  for (const Observation& observation : summary.observations) {
    table += fmt::format("  {}:", observation.paper);
    for (std::size_t i = 0; i < observation.ours.size(); ++i) {
      const Observation::Ours& ours = observation.ours[i];
      const bool first = i == 0 || observation.ours[i - 1].verdict != ours.verdict;
      const bool last = i + 1 == observation.ours.size() || observation.ours[i + 1].verdict != ours.verdict;
      table += first ? fmt::format("{} {} (", i == 0 ? "" : ",", ours.verdict) : ", ";
      table += word(ours.knowledge);
      if (last) table += ')';
    }
    table += '\n';
  }
  return table;
}

void write_summary(const SelfLocalizationSummary& summary, const std::filesystem::path& file) {
  const SelfLocalizationSettings& settings = summary.settings;
  Json json = {{"experiment", settings.name},
               {"version", version()},
               {"settings", settings.digest},
               {"seed", summary.seed},
               {"spots", Json::array()},
               {"headings", settings.headings()},
               {"coloured_draws", settings.coloured_draws},
               {"white_draws", settings.white_draws},
               {"triangulation", settings.triangulation},
               {"calibration_points", settings.calibration_points},
               {"far_off_m", kFarOff},
               {"cells", Json::array()},
               {"observations", Json::array()},
               {"findings", Json::array()}};
  for (const Spot& spot : settings.spots) {
    json["spots"].push_back({{"name", spot.name}, {"place", {spot.place.x(), spot.place.y()}}});
  }
  for (const SelfLocalizationCell& cell : summary.cells) json["cells"].push_back(cell_json(summary, cell));
  for (const Observation& observation : summary.observations) {
    Json ours = Json::array();
    for (const Observation::Ours& o : observation.ours) {
      ours.push_back({{"rig", word(o.knowledge)}, {"figures", o.figures}, {"verdict", o.verdict}});
    }
    json["observations"].push_back({{"paper", observation.paper}, {"ours", ours}});
  }
  for (const Finding& finding : summary.findings) {
    json["findings"].push_back({{"topic", finding.topic}, {"sentences", finding.sentences}});
  }
  OutputFile output(file);
  output.stream() << json.dump(1) << '\n';
  output.commit();
}

void write_page(const SelfLocalizationSummary& summary, const std::string& command, const std::filesystem::path& file) {
  const SelfLocalizationSettings& settings = summary.settings;
  report::SelfLocalizationPage page;
  page.title = "MOVIS: self-localization";
  page.version = std::string("movis ") + version();
  page.command = command;
  page.field = settings.field;
  page.robot_radius = settings.robot.radius;
  page.far_off = kFarOff;
  page.heading_step_deg = settings.heading_step_deg;
  page.coloured_draws = settings.coloured_draws;
  page.white_draws = settings.white_draws;
  for (const Spot& spot : settings.spots) page.spots.push_back({spot.name, spot.place});
  for (const SelfLocalizationCell& cell : summary.cells) page.cells.push_back(page_cell(cell));
  for (const Observation& observation : summary.observations) {
    report::LocalizationObservation shown{observation.paper, {}};
    for (const Observation::Ours& o : observation.ours) shown.ours.push_back({word(o.knowledge), o.figures, o.verdict});
    page.observations.push_back(std::move(shown));
  }
  for (const Finding& finding : summary.findings) page.findings.push_back({finding.topic, finding.sentences});
  report::write_self_localization_page(page, file);
}

}  // namespace movis::experiments
