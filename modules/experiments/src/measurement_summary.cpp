#include "movis/experiments/measurement_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "findings.h"
#include "measurement_bench.h"
#include "movis/sim/scene.h"
#include "resampling.h"

namespace movis::experiments {
namespace {

std::vector<Sum> sums_by_draw(const std::vector<const MeasurementRow*>& rows, double MeasurementRow::*error) {
  std::map<int, Sum> sums;
  for (const MeasurementRow* row : rows) {
    Sum& sum = sums[row->draw];
    if (row->status == "ok") sum.add(std::abs(row->*error));
  }
  std::vector<Sum> result;
  for (const auto& [draw, sum] : sums) result.push_back(sum);
  return result;
}

std::vector<double> magnitudes_of(const std::vector<const MeasurementRow*>& rows, double MeasurementRow::*error) {
  std::vector<double> magnitudes;
  for (const MeasurementRow* row : rows) {
    if (row->status == "ok") magnitudes.push_back(std::abs(row->*error));
  }
  return magnitudes;
}

std::vector<double> means_by_point(const std::vector<const MeasurementRow*>& rows, double MeasurementRow::*error,
                                   std::size_t points) {
  std::vector<Sum> sums(points);
  for (const MeasurementRow* row : rows) {
    if (row->status == "ok") sums.at(static_cast<std::size_t>(row->point)).add(std::abs(row->*error));
  }
  std::vector<double> means;
  for (const Sum& sum : sums) means.push_back(sum.mean());
  return means;
}

std::vector<double> first_draw(const std::vector<const MeasurementRow*>& rows, double MeasurementRow::*error,
                               std::size_t points) {
  std::vector<double> values(points, kUnknown);
  for (const MeasurementRow* row : rows) {
    if (row->draw == 0 && row->status == "ok") values.at(static_cast<std::size_t>(row->point)) = row->*error;
  }
  return values;
}

std::vector<Bearing> bearing_bounds(const MeasurementSettings& settings, const omni::Rig& rig,
                                    const Eigen::Vector3d& ball) {
  std::vector<Bearing> bearings;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Eigen::Matrix3d covariance =
        settings.detector_factor * settings.detector_factor *
        triangulation::bearing_bound(rig.cameras[i], ball, sim::kBallRadius, settings.picture);
    if (!covariance.allFinite()) continue;
    Bearing bearing;
    bearing.camera = static_cast<int>(i);
    bearing.covariance = covariance.topLeftCorner<2, 2>();
    bearing.radius_variance = covariance(2, 2);
    bearing.radius_covariance = covariance.col(2).head<2>();
    bearings.push_back(bearing);
  }
  return bearings;
}

// Of the rig as drawn. `everything`: with the diameter and the floor.
MeanBound mean_bound(const MeasurementSettings& settings, const omni::Rig& rig, const Lattice& lattice,
                     bool everything) {
  const double mean_of_normal = std::sqrt(2.0 / kPi);  // E|x| of a normal variable of sigma 1
  Sum distance, direction;
  for (const Eigen::Vector2d& place : lattice.points) {
    const Eigen::Vector3d ball(place.x(), place.y(), sim::kBallRadius);
    std::vector<Bearing> bearings = bearing_bounds(settings, rig, ball);
    if (!everything) {
      for (Bearing& bearing : bearings) bearing.radius_variance = 0.0;
    }
    const Eigen::Matrix3d bound =
        triangulation::position_bound(rig, ball, bearings, sim::kBallRadius, everything ? 0.0 : -1.0);
    if (!bound.allFinite()) continue;
    const triangulation::FloorSigma sigma = triangulation::floor_sigma_of(bound, ball);
    distance.add(mean_of_normal * sigma.distance);
    direction.add(mean_of_normal * sigma.direction);
  }
  return {distance.mean(), direction.mean()};
}

using Key = std::tuple<Level, Differences, int, Knowledge>;
using Rows = std::vector<const MeasurementRow*>;

using Case = std::pair<int, int>;  // draw and point

// The cases that every system of the cells answered; one that answered none is not asked.
std::set<Case> common_cases(const std::vector<const Rows*>& cells) {
  std::map<Case, std::size_t> answers;
  std::size_t systems = 0;
  for (const Rows* rows : cells) {
    std::size_t measured = 0;
    for (const MeasurementRow* row : *rows) {
      if (row->status != "ok") continue;
      ++answers[{row->draw, row->point}];
      ++measured;
    }
    if (measured > 0) ++systems;
  }
  std::set<Case> common;
  for (const auto& [which, count] : answers) {
    if (count == systems) common.insert(which);
  }
  return common;
}

void add_common(const std::map<Key, Rows>& rows, MeasurementSummary& summary) {
  std::map<std::tuple<Level, Differences, Knowledge>, std::vector<const Rows*>> groups;
  for (const auto& [key, of_key] : rows) {
    const auto& [level, differences, system, knowledge] = key;
    groups[{level, differences, knowledge}].push_back(&of_key);
  }
  std::map<std::tuple<Level, Differences, Knowledge>, std::set<Case>> common;
  for (const auto& [group, cells] : groups) common[group] = common_cases(cells);
  for (MeasurementCell& cell : summary.cells) {
    const std::set<Case>& cases = common[{cell.level, cell.differences, cell.knowledge}];
    Sum distance, direction;
    for (const MeasurementRow* row : rows.at({cell.level, cell.differences, cell.system, cell.knowledge})) {
      if (row->status != "ok" || cases.count({row->draw, row->point}) == 0) continue;
      distance.add(std::abs(row->distance_error));
      direction.add(std::abs(row->direction_error));
    }
    cell.common = distance.count;
    cell.common_distance = distance.mean();
    cell.common_direction = direction.mean();
  }
}

MeasurementCell cell_of(const Key& key, const Rows& rows, const MeasurementSettings& settings) {
  MeasurementCell cell;
  std::tie(cell.level, cell.differences, cell.system, cell.knowledge) = key;
  const std::size_t points = lattice_of(settings, cell.differences).points.size();
  cell.asked = static_cast<int>(rows.size());
  std::vector<double> distances = magnitudes_of(rows, &MeasurementRow::distance_error);
  cell.measured = static_cast<int>(distances.size());
  cell.distance = statistics_of(std::move(distances), sums_by_draw(rows, &MeasurementRow::distance_error));
  cell.direction = statistics_of(magnitudes_of(rows, &MeasurementRow::direction_error),
                                 sums_by_draw(rows, &MeasurementRow::direction_error));
  cell.distance_by_point = means_by_point(rows, &MeasurementRow::distance_error, points);
  cell.direction_by_point = means_by_point(rows, &MeasurementRow::direction_error, points);
  cell.first_distance = first_draw(rows, &MeasurementRow::distance_error, points);
  cell.first_direction = first_draw(rows, &MeasurementRow::direction_error, points);
  return cell;
}

void add_bounds(const MeasurementSettings& settings, MeasurementSummary& summary) {
  std::array<MeanBound, kRigs> free, all;
  for (std::size_t i = 0; i < kRigs; ++i) {
    free[i] = mean_bound(settings, settings.rigs[i], summary.lattice, false);
    all[i] = mean_bound(settings, settings.rigs[i], summary.lattice, true);
  }
  for (MeasurementCell& cell : summary.cells) {
    const RigIndex rig = kSystems.at(static_cast<std::size_t>(cell.system)).rig;
    const bool bounded = cell.level == Level::bearings && cell.differences == Differences::all;
    cell.free_bound = bounded ? free[rig] : MeanBound{kUnknown, kUnknown};
    cell.bound = bounded ? all[rig] : MeanBound{kUnknown, kUnknown};
  }
}

}  // namespace

const MeasurementCell* MeasurementSummary::find(Level level, Differences differences, const char* system,
                                                Knowledge knowledge) const {
  const int index = system_index(system);
  for (const MeasurementCell& cell : cells) {
    if (cell.level == level && cell.differences == differences && cell.system == index && cell.knowledge == knowledge) {
      return &cell;
    }
  }
  return nullptr;
}

Ratio ratio_of(const std::vector<MeasurementRow>& rows, Level level, const char* one, Knowledge one_knowledge,
               const char* other, Knowledge other_knowledge) {
  const int first = system_index(one);
  const int second = system_index(other);
  std::map<Case, std::pair<std::optional<double>, std::optional<double>>> cases;
  for (const MeasurementRow& row : rows) {
    if (row.level != level || row.differences != Differences::all || row.status != "ok") continue;
    const double error = std::abs(row.distance_error);
    if (row.system == first && row.knowledge == one_knowledge) cases[{row.draw, row.point}].first = error;
    if (row.system == second && row.knowledge == other_knowledge) cases[{row.draw, row.point}].second = error;
  }
  std::map<int, std::pair<Sum, Sum>> draws;
  for (const auto& [which, errors] : cases) {
    if (!errors.first || !errors.second) continue;
    draws[which.first].first.add(*errors.first);
    draws[which.first].second.add(*errors.second);
  }
  std::vector<std::pair<Sum, Sum>> pairs;
  for (const auto& [draw, pair] : draws) pairs.push_back(pair);
  return ratio_of(pairs);
}

MeasurementSummary summarize_measurement(const MeasurementSettings& settings, std::uint64_t seed,
                                         const std::vector<MeasurementRow>& rows) {
  MeasurementSummary summary;
  summary.settings = settings;
  summary.seed = seed;
  summary.lattice = lattice_of(settings, Differences::all);
  std::map<Key, Rows> cells;
  for (const MeasurementRow& row : rows) {
    cells[{row.level, row.differences, row.system, row.knowledge}].push_back(&row);
  }
  for (const auto& [key, of_key] : cells) summary.cells.push_back(cell_of(key, of_key, settings));
  add_common(cells, summary);
  add_bounds(settings, summary);
  summary.findings = findings_of(summary, rows);
  return summary;
}

}  // namespace movis::experiments
