#include "movis/report/self_localization_page.h"

#include <ostream>

#include "json.h"
#include "movis/core/error.h"
#include "template.h"

namespace movis::report {
namespace {

// An ok fix as its three errors, any other as its status: half of the page is made of these.
Json error_json(const LocalizationError& error) {
  if (error.status != "ok") return error.status;
  return {number(error.x, kMetreDigits), number(error.y, kMetreDigits), degree(error.beta_deg)};
}

Json cell_json(const LocalizationCell& cell, const SelfLocalizationPage& page) {
  if (cell.spot < -1 || cell.spot >= static_cast<int>(page.spots.size())) {
    throw Error("report: a cell of '{}' is of spot {}; there are {}", cell.localizer, cell.spot, page.spots.size());
  }
  Json json = {{"goals", cell.goals},
               {"knowledge", cell.knowledge},
               {"localizer", cell.localizer},
               {"spot", cell.spot},
               {"asked", cell.asked},
               {"ok", cell.ok},
               {"far_off", cell.far_off},
               {"mean", number(cell.mean, kMetreDigits)},
               {"low", number(cell.low, kMetreDigits)},
               {"high", number(cell.high, kMetreDigits)},
               {"median", number(cell.median, kMetreDigits)},
               {"percentile95", number(cell.percentile95, kMetreDigits)},
               {"largest", number(cell.largest, kMetreDigits)},
               {"x", number(cell.x_mean, kMetreDigits)},
               {"x95", number(cell.x_percentile95, kMetreDigits)},
               {"y", number(cell.y_mean, kMetreDigits)},
               {"y95", number(cell.y_percentile95, kMetreDigits)},
               {"beta", degree(cell.beta_mean_deg)},
               {"beta95", degree(cell.beta_percentile95_deg)},
               {"beta_largest", degree(cell.beta_largest_deg)},
               {"nees", number(cell.nees, 2)},
               {"within", number(cell.within, 4)},
               {"first", Json::array()},
               {"mean_by_heading", Json::array()}};
  for (const LocalizationError& error : cell.first) json["first"].push_back(error_json(error));
  for (const double value : cell.position_by_heading) json["mean_by_heading"].push_back(number(value, kMetreDigits));
  return json;
}

Json observation_json(const LocalizationObservation& observation) {
  Json json = {{"paper", observation.paper}, {"ours", Json::array()}};
  for (const auto& ours : observation.ours) {
    json["ours"].push_back({{"knowledge", ours.knowledge}, {"figures", ours.figures}, {"verdict", ours.verdict}});
  }
  return json;
}

Json page_json(const SelfLocalizationPage& page) {
  Json json = {{"field", field_json(page.field)},
               {"robot_radius", number(page.robot_radius, kMetreDigits)},
               {"far_off", number(page.far_off, kMetreDigits)},
               {"heading_step", page.heading_step_deg},
               {"draws", {{"coloured", page.coloured_draws}, {"white", page.white_draws}}},
               {"spots", Json::array()},
               {"cells", Json::array()},
               {"observations", Json::array()},
               {"findings", Json::array()}};
  for (const LocalizationSpot& spot : page.spots) {
    json["spots"].push_back({{"name", spot.name}, {"place", vector(spot.place, kMetreDigits)}});
  }
  for (const LocalizationCell& cell : page.cells) json["cells"].push_back(cell_json(cell, page));
  for (const LocalizationObservation& observation : page.observations) {
    json["observations"].push_back(observation_json(observation));
  }
  for (const LocalizationFinding& finding : page.findings) {
    json["findings"].push_back({{"topic", finding.topic}, {"sentences", finding.sentences}});
  }
  return json;
}

}  // namespace

void write_self_localization_page(const SelfLocalizationPage& page, const std::filesystem::path& file) {
  const std::string data = script_text(page_json(page));
  write_page(
      "localization/page.html", {page.title, page.version, page.command}, [&data](std::ostream& out) { out << data; },
      file);
}

}  // namespace movis::report
