#pragma once

#include <cstdint>

namespace movis::sim {

inline constexpr int kMostLanes = 16;           // floats in a vector
inline constexpr int kChannelStride = 0x10000;  // between the noise counters of two channels of a row

inline constexpr int kMostRadius = 3;  // of the blur, pixels

// The sRGB curve: 8-bit values of linear light in steps of 1/kToneSteps.
inline constexpr int kToneSteps = 4095;
const std::int32_t* tone_table();

}  // namespace movis::sim
