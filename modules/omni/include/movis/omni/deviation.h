#pragma once

#include <Eigen/Core>
#include <array>

#include "movis/core/random.h"
#include "movis/omni/rig.h"

namespace movis::omni {

// By how much a built camera differs from its drawing, in nine numbers:
//   0–2  position of the viewpoint, metres          3  yaw, radians       4, 5  tilt_x, tilt_y, radians
//   6    focal length, as a factor less 1: of fu and fv, of a radial model's ρ                  7, 8  principal point u0, v0, pixels
inline constexpr int kDeviations = 9;
using Deviation = Eigen::Matrix<double, kDeviations, 1>;

inline constexpr std::array<const char*, kDeviations> kDeviationNames{"x",      "y",     "z",  "yaw", "tilt_x",
                                                                      "tilt_y", "focal", "u0", "v0"};

// The individual differences of the measurement experiment, one sigma each: 2 mm, 0.6°, 0.25°, 0.4 %, 1.5 px. They are
// also what a calibration expects of a rig before it has seen anything.
Deviation individual_differences();

Camera deviated(const Camera& nominal, const Deviation& deviation);

// A rig as it might be built from the drawing `nominal`: independent normal deviations of the given sigma. Cameras are
// drawn one after the other, so that the same stream gives the same rig.
Rig draw_rig(const Rig& nominal, const Deviation& sigma, RandomStream& random);

}  // namespace movis::omni
