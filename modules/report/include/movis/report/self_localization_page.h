#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "movis/core/field.h"

// A page about a self-localization experiment: by localizer, by what is known of its rig and by spot of the field, how
// far off the robot's pose is while it turns. Plain data for a screen: metres, and degrees where a name says so. A
// number that is not finite is shown as unknown.
namespace movis::report {

struct LocalizationSpot {
  std::string name;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // field frame
};

// One fix, or why there is none.
struct LocalizationError {
  std::string status;
  double x = 0.0, y = 0.0, beta_deg = 0.0;  // measured less true, of status ok
};

struct LocalizationCell {
  std::string goals;      // "coloured" or "white"
  std::string knowledge;  // of the rig, e.g. "nominal"
  std::string localizer;
  int spot = -1;  // of the page's spots; −1: all of them
  int asked = 0;
  int ok = 0;
  int far_off = 0;                                         // of the ok ones
  double mean = 0.0, low = 0.0, high = 0.0;                // of the position error's magnitude; its interval
  double median = 0.0, percentile95 = 0.0, largest = 0.0;  // of it
  double x_mean = 0.0, x_percentile95 = 0.0, y_mean = 0.0, y_percentile95 = 0.0;  // of magnitudes
  double beta_mean_deg = 0.0, beta_percentile95_deg = 0.0, beta_largest_deg = 0.0;
  double nees = 0.0;    // mean
  double within = 0.0;  // share within the 95 % ellipsoid

  // By heading of the page; empty of all spots.
  std::vector<LocalizationError> first;     // of the first draw
  std::vector<double> position_by_heading;  // magnitude, mean over draws
};

// What the paper observed, beside ours by knowledge.
struct LocalizationObservation {
  struct Ours {
    std::string knowledge, figures, verdict;
  };
  std::string paper;
  std::vector<Ours> ours;
};

// Sentences on one topic.
struct LocalizationFinding {
  std::string topic;
  std::vector<std::string> sentences;
};

struct SelfLocalizationPage {
  std::string title;
  std::string version;
  std::string command;
  Field field;
  double robot_radius = 0.0;
  double far_off = 0.0;  // what counts as far off
  int heading_step_deg = 5;
  int coloured_draws = 0, white_draws = 0;
  std::vector<LocalizationSpot> spots;
  std::vector<LocalizationCell> cells;
  std::vector<LocalizationObservation> observations;
  std::vector<LocalizationFinding> findings;
};

// Writes one HTML file that needs nothing beside it and no network. An Error where it cannot be written, or where a
// cell's spot is not one of the page's; then no file is left behind.
void write_self_localization_page(const SelfLocalizationPage& page, const std::filesystem::path& file);

}  // namespace movis::report
