#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "movis/sim/look.h"

namespace movis::sim {

inline constexpr int kMostLanes = 16;           // floats in a vector
inline constexpr int kMostRadius = 3;           // of the blur, pixels
inline constexpr int kChannelStride = 0x10000;  // between the noise counters of two channels of a row

// A Sensor, worked out for rows of one width.
struct SensorRow {
  std::vector<float> taps;  // of the Gaussian blur, from its middle outwards
  std::array<float, 3> gains{};
  int width = 0;
  int row_floats = 0;  // of a row's plane: the width with radius() more on both sides, filled up to whole vectors
  float read_variance = 0.0F;
  float shot_variance = 0.0F;  // of a signal of 1

  int radius() const { return static_cast<int>(taps.size()) - 1; }  // rows and columns that a pixel needs around it
};

SensorRow make_sensor_row(const Sensor& sensor, int width);

// The rows that one row of the picture needs: rows[channel][i] is the plane (red, green, blue) of the row i − radius()
// below it, row_floats long.
using LightRows = std::array<std::vector<const float*>, 3>;

// What lens and sensor make of linear light: the pixels from `begin` to `end` of a row of 8-bit blue, green, red; see
// Sensor in look.h. The noise is a function of the key and the pixel alone. `scratch` holds 3·row_floats.
void expose(const LightRows& rows, const SensorRow& sensor, int begin, int end, std::uint32_t noise_key, float* scratch,
            std::uint8_t* bgr);

}  // namespace movis::sim
