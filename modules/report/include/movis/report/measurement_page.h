#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

// A page about a measurement experiment: by system and by what is known of its rig, how far off distance and direction
// of a ball are, over a lattice around the robot. Plain data for a screen: metres, and degrees where a name says so. A
// number that is not finite is shown as unknown.
namespace movis::report {

// Of magnitudes of errors. `low` and `high` enclose the mean.
struct MeasurementStatistics {
  double mean = 0.0, low = 0.0, high = 0.0, median = 0.0, rms = 0.0, percentile95 = 0.0, largest = 0.0;
};

struct MeasurementCell {
  std::string level;        // e.g. "images"
  std::string differences;  // "all": a row of the table; others: of the table of single differences
  std::string system;
  std::string knowledge;  // of the rig, e.g. "nominal"
  int asked = 0;
  int measured = 0;
  MeasurementStatistics distance;
  MeasurementStatistics direction_deg;
  int common = 0;                // cases that every system of the same level, differences and knowledge answered
  double common_distance = 0.0;  // mean magnitude over them
  double common_direction_deg = 0.0;
  double distance_free_bound = 0.0;  // of the mean magnitude, by azimuths and elevations alone
  double distance_bound = 0.0;       // by all that the cameras tell
  double direction_bound_deg = 0.0;

  // By point of the page; empty: no map.
  std::vector<double> mean_distance;  // magnitude, mean over draws
  std::vector<double> mean_direction_deg;
  std::vector<double> first_distance;  // signed, of the first draw
  std::vector<double> first_direction_deg;
};

// Sentences on one topic.
struct MeasurementFinding {
  std::string topic;
  std::vector<std::string> sentences;
};

struct MeasurementPage {
  std::string title;
  std::string version;
  std::string command;
  double half_width = 0.0;  // of the lattice
  double step = 0.0;
  double robot_radius = 0.0;
  int under_robot = 0;                  // points left out
  std::vector<Eigen::Vector2d> points;  // robot frame
  std::vector<MeasurementCell> cells;
  std::vector<MeasurementFinding> findings;
};

// Writes one HTML file that needs nothing beside it and no network. An Error where it cannot be written, or where a map
// has not one number for every point; then no file is left behind.
void write_measurement_page(const MeasurementPage& page, const std::filesystem::path& file);

}  // namespace movis::report
