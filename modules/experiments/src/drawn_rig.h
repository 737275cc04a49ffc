#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "eyes.h"
#include "movis/calibration/sightings.h"
#include "movis/omni/deviation.h"
#include "movis/triangulation/correction.h"

// A rig as it was built in one draw of an experiment, and how it is measured out. The cameras and the noise at a place
// follow from the seed, the draw and the place alone, so that rigs are compared with the same numbers: cameras of the
// same number differ from their drawings alike, and have the same noise.
namespace movis::experiments {

struct RigDraw {
  std::uint64_t seed = 1;
  int draw = 0;
};

omni::Rig true_rig_of(const RigDraw& draw, const omni::Rig& nominal, const omni::Deviation& sigma);

// Places are numbered by the experiment, below kFirstCalibrationPlace.
inline constexpr std::uint64_t kFirstCalibrationPlace = std::uint64_t{1} << 20;
std::uint64_t noise_seed(const RigDraw& draw, std::uint64_t place);

// Balls at known places: evenly over a square around the robot, beside it.
struct CalibrationBalls {
  int count = 40;
  double half_width = 4.0;    // metres, of the square
  double robot_radius = 0.0;  // metres
};

// How far from the origin the robot and the ball beside it reach, metres.
double clearance_of(double robot_radius);

// What a believed rig, of this number, sees of the balls. An Error where the robot covers the square.
calibration::Sightings sightings_of(const RigDraw& draw, const CalibrationBalls& balls, const omni::Rig& believed,
                                    int number, Eyes& eyes);

// The paper's error correction; none where the data cannot carry it: that is a result.
std::optional<triangulation::Correction> correction_of(const calibration::Sightings& sightings);

}  // namespace movis::experiments
