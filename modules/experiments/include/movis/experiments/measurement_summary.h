#pragma once

#include <optional>
#include <string>
#include <vector>

#include "movis/experiments/measurement.h"
#include "movis/experiments/statistics.h"

namespace movis::experiments {

// Mean magnitudes over the lattice.
struct MeanBound {
  double distance = 0.0;   // metres
  double direction = 0.0;  // radians
};

// One system with one knowledge of its rig, over all draws and points.
struct MeasurementCell {
  Level level = Level::bearings;
  Differences differences = Differences::all;
  int system = 0;
  Knowledge knowledge = Knowledge::nominal;
  int asked = 0;
  int measured = 0;
  ErrorStatistics distance;   // metres
  ErrorStatistics direction;  // radians
  // Systems answer different cases, a draw's points, and what one leaves out may be what is hard. These cases were
  // answered by every system of this level, these differences and this knowledge that answered any.
  int common = 0;
  double common_distance = 0.0;   // mean magnitude over them, metres; NaN: there are none
  double common_direction = 0.0;  // radians
  // Mean magnitude that no unbiased estimator betters with this rig exactly known, on level `bearings`: by azimuths and
  // elevations alone, which a single camera cannot, and with the diameter and the floor too. NaN: there is none.
  MeanBound free_bound, bound;
  std::vector<double> distance_by_point;  // mean magnitude over draws, NaN: never measured
  std::vector<double> direction_by_point;
  std::vector<double> first_distance;  // signed, of the first draw, NaN: not measured
  std::vector<double> first_direction;
};

struct MeasurementSummary {
  MeasurementSettings settings;
  std::uint64_t seed = 0;
  Lattice lattice;
  std::vector<MeasurementCell> cells;
  std::vector<Finding> findings;

  const MeasurementCell* find(Level level, Differences differences, const char* system, Knowledge knowledge) const;
};

int system_index(const char* name);

// How much larger one system's mean distance error is than another's, over the points of a draw that both answered.
Ratio ratio_of(const std::vector<MeasurementRow>& rows, Level level, const char* one, Knowledge one_knowledge,
               const char* other, Knowledge other_knowledge);

MeasurementSummary summarize_measurement(const MeasurementSettings& settings, std::uint64_t seed,
                                         const std::vector<MeasurementRow>& rows);

std::string table_of(const MeasurementSummary& summary);

void write_summary(const MeasurementSummary& summary, const std::filesystem::path& file);  // JSON

void write_page(const MeasurementSummary& summary, const std::string& command, const std::filesystem::path& file);

}  // namespace movis::experiments
