#include "bound_command.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <limits>

#include "interrupt.h"
#include "movis/core/angle.h"
#include "movis/core/output_file.h"
#include "movis/core/version.h"
#include "movis/report/bound_page.h"
#include "outputs.h"
#include "progress.h"
#include "wrong_arguments.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;
using triangulation::BoundCell;
using triangulation::BoundMapOptions;
using triangulation::BoundStatus;
using Knowledge = BoundCell::Sigma BoundCell::*;

constexpr int kDirections = 72;
constexpr int kMostColumns = 401;   // of a page's map
constexpr int kMostDistances = 40;  // of a page's polar map

int rows_of_map(const BoundArguments& arguments) {
  int rows = 0;
  try {
    rows = bound_map_rows(arguments.options);
  } catch (const Error& error) {
    throw WrongArguments(error.what());
  }
  if (arguments.page && rows > kMostColumns) {
    throw WrongArguments("--page: a map of more than {} × {} places is no page; give a coarser --step than {} m",
                         kMostColumns, kMostColumns, arguments.options.step);
  }
  return rows;
}

std::vector<BoundCell> make_map(const omni::Rig& rig, const BoundMapOptions& options, int rows) {
  Progress progress("bound", static_cast<std::size_t>(rows));
  return bound_map(rig, options, [&] {
    check_interrupts();
    progress.advance();
  });
}

// The CSV file

void write_sigma(const BoundCell::Sigma& cell, std::ostream& out) {
  if (cell.status == BoundStatus::ok) {
    fmt::print(out, ",{},{:.6g},{:.6g},{:.6g}", word(cell.status), cell.sigma.distance, degrees(cell.sigma.direction),
               cell.sigma.position);
  } else {
    fmt::print(out, ",{},,,", word(cell.status));
  }
}

void write_cells(const std::vector<BoundCell>& cells, std::ostream& out) {
  out << "x,y,cameras,floor_status,floor_distance_sigma,floor_direction_sigma_deg,floor_position_sigma,"
         "free_status,free_distance_sigma,free_direction_sigma_deg,free_position_sigma\n";
  for (const BoundCell& cell : cells) {
    fmt::print(out, "{:.6g},{:.6g},{}", cell.place.x(), cell.place.y(), cell.cameras);
    write_sigma(cell.floor, out);
    write_sigma(cell.free, out);
    out << '\n';
  }
}

// All around the robot

report::BoundRow row_of(const std::vector<BoundCell>& ring, double distance, Knowledge knowledge) {
  report::BoundRow row;
  row.distance = distance;
  row.knowledge = knowledge == &BoundCell::floor ? "floor" : "free";
  row.directions = static_cast<int>(ring.size());
  for (const BoundCell& cell : ring) {
    const BoundCell::Sigma& at = cell.*knowledge;
    if (at.status != BoundStatus::ok) continue;
    ++row.measurable;
    row.mean_distance += at.sigma.distance;
    row.mean_direction_deg += degrees(at.sigma.direction);
    row.worst_distance = std::max(row.worst_distance, at.sigma.distance);
    row.worst_direction_deg = std::max(row.worst_direction_deg, degrees(at.sigma.direction));
  }
  if (row.measurable == 0) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    row.mean_distance = row.worst_distance = row.mean_direction_deg = row.worst_direction_deg = kUnknown;
  } else {
    row.mean_distance /= row.measurable;
    row.mean_direction_deg /= row.measurable;
  }
  return row;
}

std::vector<report::BoundRow> summarize(const omni::Rig& rig, const BoundMapOptions& options, bool free_first) {
  std::vector<Knowledge> order{&BoundCell::floor, &BoundCell::free};
  if (free_first) std::reverse(order.begin(), order.end());
  std::vector<report::BoundRow> rows;
  for (const Knowledge knowledge : order) {
    for (const double distance : {1.0, 2.0, 4.0}) {
      rows.push_back(row_of(bound_ring(rig, distance, kDirections, options), distance, knowledge));
    }
  }
  return rows;
}

std::string table_of(const std::vector<report::BoundRow>& rows) {
  std::string text = fmt::format("  {:<10}{:>9}{:>14}{:>10}{:>14}{:>10}{:>14}\n", "height", "distance",
                                 "σ distance:", "worst", "σ direction:", "worst", "measurable");
  text += fmt::format("  {:<10}{:>9}{:>13}{:>10}{:>13}{:>10}{:>14}\n", "", "m", "mean, mm", "mm", "mean, °", "°",
                      "directions");
  for (const report::BoundRow& row : rows) {
    text += fmt::format("  {:<10}{:>9g}", row.knowledge == "floor" ? "known" : "not known", row.distance);
    if (row.measurable > 0) {
      text += fmt::format("{:>13.3f}{:>10.3f}{:>13.5f}{:>10.5f}", 1000.0 * row.mean_distance,
                          1000.0 * row.worst_distance, row.mean_direction_deg, row.worst_direction_deg);
    } else {
      text += fmt::format("{:>13}{:>10}{:>13}{:>10}", "–", "–", "–", "–");
    }
    text += fmt::format("{:>8} of {}\n", row.measurable, row.directions);
  }
  return text;
}

// The page

report::BoundSigma shown(const BoundCell::Sigma& cell) {
  return {word(cell.status), cell.sigma.distance, degrees(cell.sigma.direction), cell.sigma.position};
}

std::vector<report::BoundPlace> shown(const std::vector<BoundCell>& cells) {
  std::vector<report::BoundPlace> places;
  places.reserve(cells.size());
  for (const BoundCell& cell : cells) places.push_back({cell.cameras, shown(cell.floor), shown(cell.free)});
  return places;
}

void add_polar_map(const omni::Rig& rig, const BoundMapOptions& options, report::BoundPage& page) {
  page.directions = kDirections;
  const double step = std::max(options.step, options.half_width / kMostDistances);
  for (int i = 1; i * step <= options.half_width * (1.0 + 1e-9); ++i) {
    page.distances.push_back(i * step);
    for (report::BoundPlace& place : shown(bound_ring(rig, i * step, kDirections, options))) {
      page.polar.push_back(std::move(place));
    }
  }
}

std::string command_of(const BoundArguments& arguments) {
  const BoundMapOptions& o = arguments.options;
  return fmt::format(
      "movis bound --rig {} --contrast {} --noise {} --blur {} --half-width {} --step {} --ball-radius {} --height {} "
      "--floor-sigma {}{}{} --out {}",
      arguments.rig.string(), o.picture.contrast, o.picture.noise, o.picture.blur_px, o.half_width, o.step,
      o.ball_radius, o.height, o.floor_sigma, o.diameter ? " --diameter" : "", arguments.free ? " --free" : "",
      arguments.out.string());
}

report::BoundPage make_page(const BoundArguments& arguments, const omni::Rig& rig, const std::vector<BoundCell>& cells,
                            const std::vector<report::BoundRow>& rows) {
  const BoundMapOptions& options = arguments.options;
  report::BoundPage page;
  page.title = "MOVIS: how well this rig can measure";
  page.version = std::string("movis ") + version();
  page.command = command_of(arguments);
  page.rig = arguments.rig.filename().string();
  page.contrast = options.picture.contrast;
  page.noise = options.picture.noise;
  page.blur_px = options.picture.blur_px;
  page.ball_radius = options.ball_radius;
  page.height = options.height;
  page.floor_sigma = options.floor_sigma;
  page.diameter = options.diameter;
  page.free_first = arguments.free;
  for (const omni::Camera& camera : rig.cameras) page.cameras.push_back({camera.name, camera.position.head<2>()});
  page.rows = rows;
  page.step = options.step;
  page.columns = static_cast<int>(std::lround(std::sqrt(static_cast<double>(cells.size()))));
  page.cells = shown(cells);
  add_polar_map(rig, options, page);
  return page;
}

}  // namespace

void bound(BoundArguments arguments) {
  arguments.options.height = arguments.height.value_or(arguments.options.ball_radius);
  const int rows_of_places = rows_of_map(arguments);
  const BoundMapOptions& options = arguments.options;
  const omni::Rig rig = omni::read_rig(arguments.rig);
  refuse_to_overwrite({{"--out", arguments.out}, {"--page", arguments.page}}, files_of(rig, arguments.rig));
  OutputFile file(arguments.out);
  const std::vector<BoundCell> cells = make_map(rig, options, rows_of_places);
  write_cells(cells, file.stream());
  flush(file);
  const std::vector<report::BoundRow> rows = summarize(rig, options, arguments.free);
  if (arguments.page) write_bound_page(make_page(arguments, rig, cells, rows), *arguments.page);
  file.commit();

  const auto seen = std::count_if(cells.begin(), cells.end(), [](const BoundCell& cell) { return cell.cameras > 0; });
  fmt::print("{}: {} camera{}, the ball is seen at {} of {} places; at best, the robot's body out of the way:\n{}",
             arguments.rig.filename().string(), rig.cameras.size(), rig.cameras.size() == 1 ? "" : "s", seen,
             cells.size(), table_of(rows));
  fmt::print("map: {}\n", arguments.out.string());
  if (arguments.page) fmt::print("open in a browser: {}\n", fs::absolute(*arguments.page).string());
}

}  // namespace movis::app
