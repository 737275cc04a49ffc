#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "movis/control/robot_model.h"
#include "movis/core/field.h"
#include "movis/core/pose.h"
#include "movis/core/status.h"
#include "movis/experiments/experiment.h"
#include "movis/experiments/statistics.h"
#include "movis/omni/deviation.h"
#include "movis/scan/colours.h"
#include "movis/sim/look.h"
#include "movis/triangulation/triangulator.h"

// The self-localization experiment (the paper's second §4.1, Fig. 8–16): the robot turns on nine spots of its field, and
// its cameras differ from their drawings. How far off is the pose of one instant, by which localizer, and by what is
// known of the rig? docs/self-localization.md tells the method.
namespace movis::experiments {

struct Spot {
  std::string name;                                 // the paper's: A to I
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // field frame, metres
};

// The experiment file. One of the numbers of draws may be 0: that part is left out.
struct SelfLocalizationSettings {
  std::string name;  // the file's, without its extension
  omni::Rig rig;     // as drawn
  control::RobotModel robot;
  sim::Look look;
  scan::Colours colours;
  Field field;  // with coloured goals
  std::vector<Spot> spots;
  int heading_step_deg = 5;
  std::string triangulation{triangulation::kDefaultTriangulator};
  omni::Deviation differences = omni::individual_differences();  // one sigma
  int calibration_points = 40;                                   // balls at known places, of each draw
  double calibration_half_width = 4.0;                           // metres, of the square around the robot they lie in
  int coloured_draws = 10;
  int white_draws = 10;  // with white goals, for the localizers that can
  std::string digest;    // of everything above: rows of equal digests belong together

  int headings() const { return 360 / heading_step_deg; }
};

// Strict; files are relative to it. `quick`: with the file's map `quick` on top.
SelfLocalizationSettings read_self_localization(const std::filesystem::path& file, bool quick);

// Without `calibrated`, which is the measurement experiment's: the paper corrected its measurements.
inline constexpr std::array kLocalizationKnowledges{Knowledge::nominal, Knowledge::corrected, Knowledge::true_rig};

// The localizers that can do with such goals, in their order.
std::vector<std::string_view> localizers_for(const SelfLocalizationSettings& settings, Field::Goals goals);

const char* word(Field::Goals goals);

// One fix. `row` is its number in the whole experiment, from 0, which with the seed replays it.
struct SelfLocalizationRow {
  std::int64_t row = 0;
  Field::Goals goals = Field::Goals::coloured;
  int draw = 0;
  int spot = 0;     // of the settings
  int heading = 0;  // β = heading · heading_step
  Knowledge knowledge = Knowledge::nominal;
  std::string_view localizer;
  std::string status;      // of the fix, or not_calibrated: no correction could be fitted
  bool symmetric = false;  // of the fix; then the errors are those of the nearer of the two poses
  // x, y, β, measured less true, field frame, metres and radians; 0 unless ok.
  Eigen::Vector3d error = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma = Eigen::Vector3d::Zero();  // that the fix states
  double nees = 0.0;                                // eᵀC⁻¹e, 3 on average if C is honest; NaN: C has no inverse

  bool ok() const { return status == "ok"; }
  double distance() const { return error.head<2>().norm(); }
};

// A fix as a row's answer.
void judge(const Fix& fix, const Pose2& truth, SelfLocalizationRow& row);

// What is done at once: one draw of the rig on all spots, by all localizers on the same images.
struct SelfLocalizationBlock {
  Field::Goals goals = Field::Goals::coloured;
  int draw = 0;
  std::int64_t first_row = 0;
  std::int64_t rows = 0;
};
std::vector<SelfLocalizationBlock> blocks_of(const SelfLocalizationSettings& settings);

// As run_measurement and replay_measurement.
std::vector<SelfLocalizationRow> run_self_localization(const SelfLocalizationSettings& settings,
                                                       const ExperimentRun& run, const std::filesystem::path& folder);
ReplayedRow replay_self_localization(const SelfLocalizationSettings& settings, std::int64_t row,
                                     const std::filesystem::path& folder);

inline constexpr double kFarOff = 0.20;  // metres: an ok fix farther off than this is a wrong one
inline constexpr int kAllSpots = -1;

// Of fewer draws there is neither an interval nor a verdict: by chance all five lie on the same side in 2/2⁵ = 6 % of
// the cases, and no bootstrap tells more than the draws.
inline constexpr int kFewestDraws = 6;

// One localizer with one knowledge of the rig, over all draws and headings of a spot, or of all spots.
struct SelfLocalizationCell {
  Field::Goals goals = Field::Goals::coloured;
  Knowledge knowledge = Knowledge::nominal;
  std::string_view localizer;
  int spot = kAllSpots;
  int asked = 0;
  int ok = 0;
  int far_off = 0;                          // of the ok ones
  ErrorStatistics position, x, y, beta;     // metres and radians, of the ok ones
  double nees = 0.0;                        // mean, of the ok ones
  double within = 0.0;                      // share of them within the 95 % ellipsoid that they state
  std::vector<SelfLocalizationRow> first;   // of a spot: the first draw's rows by heading
  std::vector<double> position_by_heading;  // of a spot: mean over draws, NaN: never measured
};

// The mean error of one localizer as a multiple of another's, over the cases that both answered.
struct LocalizerRatio {
  Ratio ratio;
  int cases = 0;
};
LocalizerRatio localizer_ratio(const std::vector<SelfLocalizationRow>& rows, Field::Goals goals, Knowledge knowledge,
                               std::string_view one, std::string_view other);

// What the paper observed, and what the rows say to it.
struct Observation {
  std::string paper;
  struct Ours {
    Knowledge knowledge = Knowledge::nominal;
    std::string figures;
    std::string verdict;  // agrees, does not agree, not decided (the interval holds both, or why not), not tested: why
  };
  std::vector<Ours> ours;
};

struct SelfLocalizationSummary {
  SelfLocalizationSettings settings;
  std::uint64_t seed = 0;
  std::vector<SelfLocalizationCell> cells;
  std::vector<Observation> observations;
  std::vector<Finding> findings;

  const SelfLocalizationCell* find(Field::Goals goals, Knowledge knowledge, std::string_view localizer, int spot) const;
};

SelfLocalizationSummary summarize_self_localization(const SelfLocalizationSettings& settings, std::uint64_t seed,
                                                    const std::vector<SelfLocalizationRow>& rows);

std::string table_of(const SelfLocalizationSummary& summary);

void write_summary(const SelfLocalizationSummary& summary, const std::filesystem::path& file);  // JSON

void write_page(const SelfLocalizationSummary& summary, const std::string& command, const std::filesystem::path& file);

}  // namespace movis::experiments
