#include "movis/report/bound_page.h"

#include <cmath>
#include <ostream>

#include "json.h"
#include "movis/core/error.h"
#include "template.h"

namespace movis::report {
namespace {

Json significant(double value) {
  constexpr int kDigits = 4;
  if (!std::isfinite(value) || value == 0.0) return number(value, 0);
  return number(value, kDigits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))));
}

// Column by column: a page may hold ten thousands of places.
Json sigmas_json(const std::vector<BoundPlace>& places, BoundSigma BoundPlace::*knowledge) {
  Json status = Json::array(), distance = Json::array(), direction_deg = Json::array(), position = Json::array();
  for (const BoundPlace& place : places) {
    const BoundSigma& sigma = place.*knowledge;
    const bool ok = sigma.status == "ok";
    status.push_back(sigma.status);
    distance.push_back(ok ? significant(sigma.distance) : Json());
    direction_deg.push_back(ok ? significant(sigma.direction_deg) : Json());
    position.push_back(ok ? significant(sigma.position) : Json());
  }
  return {{"status", status}, {"distance", distance}, {"direction_deg", direction_deg}, {"position", position}};
}

Json places_json(const std::vector<BoundPlace>& places) {
  Json cameras = Json::array();
  for (const BoundPlace& place : places) cameras.push_back(place.cameras);
  return {{"cameras", cameras},
          {"floor", sigmas_json(places, &BoundPlace::floor)},
          {"free", sigmas_json(places, &BoundPlace::free)}};
}

Json row_json(const BoundRow& row) {
  return {{"distance", number(row.distance, kMetreDigits)},
          {"knowledge", row.knowledge},
          {"mean_distance", significant(row.mean_distance)},
          {"worst_distance", significant(row.worst_distance)},
          {"mean_direction_deg", significant(row.mean_direction_deg)},
          {"worst_direction_deg", significant(row.worst_direction_deg)},
          {"measurable", row.measurable},
          {"directions", row.directions}};
}

void check(const BoundPage& page) {
  const auto squared = static_cast<std::size_t>(page.columns) * static_cast<std::size_t>(page.columns);
  if (page.columns < 1 || page.columns % 2 == 0 || page.cells.size() != squared) {
    throw Error("report: {} places of a map of {} columns; it needs an odd number of columns, squared",
                page.cells.size(), page.columns);
  }
  if (page.directions < 0 || page.polar.size() != page.distances.size() * static_cast<std::size_t>(page.directions)) {
    throw Error("report: {} places of a polar map of {} distances and {} directions", page.polar.size(),
                page.distances.size(), page.directions);
  }
}

Json to_json(const BoundPage& page) {
  Json cameras = Json::array(), rows = Json::array(), distances = Json::array();
  for (const BoundCamera& camera : page.cameras) {
    cameras.push_back({{"name", camera.name}, {"position", vector(camera.position, kMetreDigits)}});
  }
  for (const BoundRow& row : page.rows) rows.push_back(row_json(row));
  for (const double distance : page.distances) distances.push_back(number(distance, kMetreDigits));
  return {{"rig", page.rig},
          {"contrast", significant(page.contrast)},
          {"noise", significant(page.noise)},
          {"blur_px", significant(page.blur_px)},
          {"ball_radius", significant(page.ball_radius)},
          {"height", significant(page.height)},
          {"floor_sigma", significant(page.floor_sigma)},
          {"diameter", page.diameter},
          {"knowledge", page.free_first ? "free" : "floor"},
          {"cameras", cameras},
          {"rows", rows},
          {"step", significant(page.step)},
          {"columns", page.columns},
          {"cells", places_json(page.cells)},
          {"directions", page.directions},
          {"distances", distances},
          {"polar", places_json(page.polar)}};
}

}  // namespace

void write_bound_page(const BoundPage& page, const std::filesystem::path& file) {
  check(page);
  write_page(
      "bound/page.html", {page.title, page.version, page.command},
      [&page](std::ostream& out) { out << script_text(to_json(page)); }, file);
}

}  // namespace movis::report
