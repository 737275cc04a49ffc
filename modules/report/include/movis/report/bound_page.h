#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

// A page that shows how well a rig can measure a ball at best, all over the floor: maps of the Cramér–Rao bound of
// distance and direction, from above and unrolled over the azimuth. Everything here is plain data for a screen: metres,
// and degrees where a name ends in _deg; a number that is not finite is shown as unknown.
namespace movis::report {

// One standard deviation each; they mean nothing unless the status is "ok".
struct BoundSigma {
  std::string status;  // "ok", "not_seen" or "unobservable"
  double distance = 0.0;
  double direction_deg = 0.0;
  double position = 0.0;
};

struct BoundPlace {
  int cameras = 0;   // that see the ball
  BoundSigma floor;  // the ball's height is known
  BoundSigma free;   // it is not
};

struct BoundRow {
  double distance = 0.0;  // from the robot
  std::string knowledge;  // "floor" or "free"
  double mean_distance = 0.0, worst_distance = 0.0;
  double mean_direction_deg = 0.0, worst_direction_deg = 0.0;
  int measurable = 0, directions = 0;  // of so many
};

struct BoundCamera {
  std::string name;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // in the robot frame, from above
};

struct BoundPage {
  std::string title;
  std::string version;
  std::string command;
  std::string rig;  // its file
  double contrast = 0.0, noise = 0.0, blur_px = 0.0;
  double ball_radius = 0.0, height = 0.0, floor_sigma = 0.0;
  bool diameter = false;    // the ball's apparent size counts
  bool free_first = false;  // which knowledge the page begins with
  std::vector<BoundCamera> cameras;
  std::vector<BoundRow> rows;

  double step = 0.0;              // of the square map
  int columns = 0;                // and rows, an odd number: the robot stands in the middle one
  std::vector<BoundPlace> cells;  // columns² of them, row by row, y ascending

  int directions = 0;             // of the polar map: azimuths 360° (i + ½)/directions
  std::vector<double> distances;  // ascending
  std::vector<BoundPlace> polar;  // distance by distance, then direction
};

// Writes one HTML file that needs nothing beside it and no network. An Error where the file cannot be written or the
// numbers of places do not fit; then no file is left behind.
void write_bound_page(const BoundPage& page, const std::filesystem::path& file);

}  // namespace movis::report
