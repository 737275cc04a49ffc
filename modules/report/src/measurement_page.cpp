#include "movis/report/measurement_page.h"

#include <ostream>

#include "json.h"
#include "movis/core/error.h"
#include "template.h"

namespace movis::report {
namespace {

Json statistics_json(const MeasurementStatistics& s, int digits) {
  return {{"mean", number(s.mean, digits)},      {"low", number(s.low, digits)},
          {"high", number(s.high, digits)},      {"median", number(s.median, digits)},
          {"rms", number(s.rms, digits)},        {"percentile95", number(s.percentile95, digits)},
          {"largest", number(s.largest, digits)}};
}

Json map_json(const std::vector<double>& values, int digits, const MeasurementPage& page, const MeasurementCell& cell) {
  if (values.empty()) return nullptr;
  if (values.size() != page.points.size()) {
    throw Error("report: the map of '{}', {}, has {} numbers for {} points", cell.system, cell.knowledge, values.size(),
                page.points.size());
  }
  Json json = Json::array();
  for (const double value : values) json.push_back(number(value, digits));
  return json;
}

Json cell_json(const MeasurementCell& cell, const MeasurementPage& page) {
  return {{"level", cell.level},
          {"differences", cell.differences},
          {"system", cell.system},
          {"knowledge", cell.knowledge},
          {"asked", cell.asked},
          {"measured", cell.measured},
          {"distance", statistics_json(cell.distance, kMetreDigits)},
          {"direction", statistics_json(cell.direction_deg, kDegreeDigits)},
          {"common", cell.common},
          {"common_distance", number(cell.common_distance, kMetreDigits)},
          {"common_direction", number(cell.common_direction_deg, kDegreeDigits)},
          {"distance_free_bound", number(cell.distance_free_bound, kMetreDigits)},
          {"distance_bound", number(cell.distance_bound, kMetreDigits)},
          {"direction_bound", number(cell.direction_bound_deg, kDegreeDigits)},
          {"mean",
           {{"distance", map_json(cell.mean_distance, kMetreDigits, page, cell)},
            {"direction", map_json(cell.mean_direction_deg, kDegreeDigits, page, cell)}}},
          {"first",
           {{"distance", map_json(cell.first_distance, kMetreDigits, page, cell)},
            {"direction", map_json(cell.first_direction_deg, kDegreeDigits, page, cell)}}}};
}

Json page_json(const MeasurementPage& page) {
  Json json = {{"half_width", number(page.half_width, kMetreDigits)},
               {"step", number(page.step, kMetreDigits)},
               {"robot_radius", number(page.robot_radius, kMetreDigits)},
               {"under_robot", page.under_robot},
               {"points", Json::array()},
               {"cells", Json::array()},
               {"findings", Json::array()}};
  for (const Eigen::Vector2d& point : page.points) json["points"].push_back(vector(point, kMetreDigits));
  for (const MeasurementCell& cell : page.cells) json["cells"].push_back(cell_json(cell, page));
  for (const MeasurementFinding& finding : page.findings) {
    json["findings"].push_back({{"topic", finding.topic}, {"sentences", finding.sentences}});
  }
  return json;
}

}  // namespace

void write_measurement_page(const MeasurementPage& page, const std::filesystem::path& file) {
  const std::string data = script_text(page_json(page));
  write_page(
      "measurement/page.html", {page.title, page.version, page.command}, [&data](std::ostream& out) { out << data; },
      file);
}

}  // namespace movis::report
