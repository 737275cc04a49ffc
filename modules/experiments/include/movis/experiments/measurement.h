#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "movis/control/robot_model.h"
#include "movis/experiments/experiment.h"
#include "movis/omni/deviation.h"
#include "movis/scan/colours.h"
#include "movis/sim/look.h"
#include "movis/triangulation/cramer_rao.h"

// The measurement experiment (the paper's §4.1, Fig. 4 and 7): a ball on the points of a lattice around the robot, seen
// by rigs whose cameras differ from their drawings; how far off are distance and direction, by which system, and by
// what is known of its rig? docs/measurement.md tells the method.
namespace movis::experiments {

// How bearings come about.
//   bearings  the true rig's exact pixel of the ball, plus the stated noise, turned back by the believed rig: geometry
//             alone; nothing is hidden
//   images    the true rig's rendered pictures, scanned with the believed rig: the whole path
enum class Level { bearings, images };

// Which individual differences the cameras have.
enum class Differences { all, none, position, yaw, tilt, focal, principal_point };

inline constexpr std::array kLevels{Level::bearings, Level::images};
inline constexpr std::array kDifferences{
    Differences::all,  Differences::none,  Differences::position,       Differences::yaw,
    Differences::tilt, Differences::focal, Differences::principal_point};

const char* word(Level level);
const char* word(Differences differences);

// The rigs that are compared, by their place in MeasurementSettings::rigs.
enum RigIndex { kSingleRig, kVerticalRig, kShortVerticalRig, kMovisRig };
inline constexpr int kRigs = 4;

// A way from bearings to a point.
struct MeasurementSystem {
  const char* name;   // in files
  const char* title;  // for people
  RigIndex rig;
};
inline constexpr std::array<MeasurementSystem, 8> kSystems{{
    {"single-elevation", "single omni, by elevation", kSingleRig},
    {"single-contact", "single omni, by ground contact", kSingleRig},
    {"vertical", "vertical stereo", kVerticalRig},
    {"vertical-short", "vertical stereo, short", kShortVerticalRig},
    {"vertical-joint", "vertical stereo, jointly", kVerticalRig},
    {"movis-pairs", "MOVIS, pairs", kMovisRig},
    {"movis-azimuths", "MOVIS, jointly by azimuths", kMovisRig},
    {"movis-joint", "MOVIS, jointly", kMovisRig},
}};

// The experiment file. Numbers of draws may be 0, though not all: that part is left out.
struct MeasurementSettings {
  std::string name;                   // the file's, without its extension
  std::array<omni::Rig, kRigs> rigs;  // as drawn
  control::RobotModel robot;
  sim::Look look;
  scan::Colours colours;
  omni::Deviation differences = omni::individual_differences();  // one sigma
  double half_width = 4.0;                                       // metres, of the lattice
  double step = 0.5;
  int calibration_points = 40;     // balls at known places, of each draw
  triangulation::Picture picture;  // what the noise of level `bearings` follows from
  double detector_factor = 2.0;    // times the bound of a bearing: sigma of its noise
  int bearing_draws = 20;
  int image_draws = 10;
  int alone_draws = 20;     // with one kind of difference at a time
  double alone_step = 1.0;  // metres, of their lattice
  std::string digest;       // of everything above: rows of equal digests belong together
};

// Strict; files are relative to it. `quick`: with the file's map `quick` on top.
MeasurementSettings read_measurement(const std::filesystem::path& file, bool quick);

// One measurement. `row` is its number in the whole experiment, from 0, which with the seed replays it.
struct MeasurementRow {
  std::int64_t row = 0;
  Level level = Level::bearings;
  Differences differences = Differences::all;
  int draw = 0;
  int point = 0;   // of the lattice
  int system = 0;  // of kSystems
  Knowledge knowledge = Knowledge::nominal;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of the ball, robot frame, metres
  std::string status;            // of a PointEstimate, or not_calibrated: no correction or rig could be fitted
  double distance_error = 0.0;   // measured less true distance from the robot's origin, metres; 0 unless ok
  double direction_error = 0.0;  // radians
};

// What is done at once: one draw of one rig, at all points.
struct MeasurementBlock {
  Level level = Level::bearings;
  Differences differences = Differences::all;
  int draw = 0;
  RigIndex rig = kSingleRig;
  std::int64_t first_row = 0;
  std::int64_t rows = 0;
};
std::vector<MeasurementBlock> blocks_of(const MeasurementSettings& settings);

// The lattice's points that are not under the robot, row by row from (−half_width, −half_width).
struct Lattice {
  std::vector<Eigen::Vector2d> points;
  int under_robot = 0;
};
Lattice lattice_of(const MeasurementSettings& settings, Differences differences);

// Measures and writes `folder`/rows.csv, where the rows of every finished block stand at once; in the end they are in
// order. Throws an Error, before it measures and with rows.csv as it was, where the folder or one of rows.csv,
// summary.json and index.html in it cannot be written; where rows.csv exists and is not to be resumed, or is to be
// resumed and does not exist, is of other settings, another seed or another version, or holds a row that is not one of
// this experiment.
std::vector<MeasurementRow> run_measurement(const MeasurementSettings& settings, const ExperimentRun& run,
                                            const std::filesystem::path& folder);

// A row of `folder`/rows.csv as it stands there, and recomputed. Writes nothing.
ReplayedRow replay_measurement(const MeasurementSettings& settings, std::int64_t row,
                               const std::filesystem::path& folder);

}  // namespace movis::experiments
