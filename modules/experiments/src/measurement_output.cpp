// The summary as a table, as JSON and as a page.
#include <fmt/format.h>

#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/output_file.h"
#include "movis/core/version.h"
#include "movis/experiments/measurement_summary.h"
#include "movis/report/measurement_page.h"
#include "summary_numbers.h"

namespace movis::experiments {
namespace {

Json cell_json(const MeasurementCell& cell) {
  return {{"level", word(cell.level)},
          {"differences", word(cell.differences)},
          {"system", kSystems.at(static_cast<std::size_t>(cell.system)).name},
          {"knowledge", word(cell.knowledge)},
          {"asked", cell.asked},
          {"measured", cell.measured},
          {"distance_m", statistics_json(cell.distance, 1.0)},
          {"direction_deg", statistics_json(cell.direction, degrees(1.0))},
          {"common", cell.common},
          {"common_distance_m", number(cell.common_distance)},
          {"common_direction_deg", number(degrees(cell.common_direction))},
          {"distance_free_bound_m", number(cell.free_bound.distance)},
          {"direction_free_bound_deg", number(degrees(cell.free_bound.direction))},
          {"distance_bound_m", number(cell.bound.distance)},
          {"direction_bound_deg", number(degrees(cell.bound.direction))}};
}

report::MeasurementStatistics page_statistics(const ErrorStatistics& s, double unit) {
  return {unit * s.mean,
          unit * s.mean_interval.low,
          unit * s.mean_interval.high,
          unit * s.median,
          unit * s.rms,
          unit * s.percentile95,
          unit * s.largest};
}

std::vector<double> scaled(std::vector<double> values, double unit) {
  for (double& value : values) value *= unit;
  return values;
}

report::MeasurementCell page_cell(const MeasurementCell& cell) {
  report::MeasurementCell shown;
  const MeasurementSystem& system = kSystems.at(static_cast<std::size_t>(cell.system));
  shown.level = word(cell.level);
  shown.differences = word(cell.differences);
  shown.system = system.title;
  shown.knowledge = word(cell.knowledge);
  shown.asked = cell.asked;
  shown.measured = cell.measured;
  const double to_degrees = degrees(1.0);
  shown.distance = page_statistics(cell.distance, 1.0);
  shown.direction_deg = page_statistics(cell.direction, to_degrees);
  shown.common = cell.common;
  shown.common_distance = cell.common_distance;
  shown.common_direction_deg = to_degrees * cell.common_direction;
  shown.distance_free_bound = cell.free_bound.distance;
  shown.distance_bound = cell.bound.distance;
  shown.direction_bound_deg = to_degrees * cell.bound.direction;
  if (cell.differences != Differences::all) return shown;  // their lattice is another
  shown.mean_distance = cell.distance_by_point;
  shown.mean_direction_deg = scaled(cell.direction_by_point, to_degrees);
  shown.first_distance = cell.first_distance;
  shown.first_direction_deg = scaled(cell.first_direction, to_degrees);
  return shown;
}

}  // namespace

std::string table_of(const MeasurementSummary& summary) {
  std::string table =
      fmt::format("  {:<10}{:<31}{:<12}{:>12}{:>10}{:>18}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "level", "system", "rig",
                  "measured", "mean cm", "95 % interval", "common", "median", "95 %", "bound", "dir. °");
  for (const MeasurementCell& cell : summary.cells) {
    if (cell.differences != Differences::all) continue;
    const auto& d = cell.distance;
    const std::string interval =
        std::isfinite(d.mean_interval.low)
            ? fmt::format("{:.2f} – {:.2f}", 100.0 * d.mean_interval.low, 100.0 * d.mean_interval.high)
            : "–";
    const double common = cell.common < cell.asked ? cell.common_distance : std::nan("");  // else it is the mean
    table += fmt::format("  {:<10}{:<31}{:<12}{:>12}{:>10}{:>18}{:>10}{:>10}{:>10}{:>10}{:>10}\n", word(cell.level),
                         kSystems.at(static_cast<std::size_t>(cell.system)).title, word(cell.knowledge),
                         fmt::format("{}/{}", cell.measured, cell.asked), text(100.0 * d.mean, 2), interval,
                         text(100.0 * common, 2), text(100.0 * d.median, 2), text(100.0 * d.percentile95, 2),
                         text(100.0 * cell.bound.distance, 2), text(degrees(cell.direction.mean), 4));
  }
  return table +
         "  common: mean over the cases that every system of this level and rig answered, where one left some out\n";
}

void write_summary(const MeasurementSummary& summary, const std::filesystem::path& file) {
  Json json = {
      {"experiment", summary.settings.name},
      {"version", version()},
      {"settings", summary.settings.digest},
      {"seed", summary.seed},
      {"points", summary.lattice.points.size()},
      {"points_under_robot", summary.lattice.under_robot},
      {"calibration_points", summary.settings.calibration_points},
      {"detector_factor", summary.settings.detector_factor},
      {"paper", {{"single_distance_m", 0.9263}, {"single_direction_deg", 0.61}, {"stereo_direction_deg", 1.5}}},
      {"cells", Json::array()},
      {"findings", Json::array()}};
  for (const MeasurementCell& cell : summary.cells) json["cells"].push_back(cell_json(cell));
  for (const Finding& finding : summary.findings) {
    json["findings"].push_back({{"topic", finding.topic}, {"sentences", finding.sentences}});
  }
  OutputFile output(file);
  output.stream() << json.dump(1) << '\n';
  output.commit();
}

void write_page(const MeasurementSummary& summary, const std::string& command, const std::filesystem::path& file) {
  report::MeasurementPage page;
  page.title = "MOVIS: measuring a ball";
  page.version = std::string("movis ") + version();
  page.command = command;
  page.half_width = summary.settings.half_width;
  page.step = summary.settings.step;
  page.robot_radius = summary.settings.robot.radius;
  page.under_robot = summary.lattice.under_robot;
  page.points = summary.lattice.points;
  for (const Finding& finding : summary.findings) page.findings.push_back({finding.topic, finding.sentences});
  for (const MeasurementCell& cell : summary.cells) page.cells.push_back(page_cell(cell));
  report::write_measurement_page(page, file);
}

}  // namespace movis::experiments
