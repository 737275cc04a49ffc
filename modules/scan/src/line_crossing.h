#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "membership.h"
#include "movis/scan/floor_scan.h"

// How a row or a column of the image crosses a line: c, w and what tells their noise (floor_scan.h).
namespace movis::scan {

inline constexpr int kLongest = 80;  // pixels of white along a row or column: the nearest line, crossed obliquely
inline constexpr int kBeside = 3;    // pixels looked at on either side: one that may be mixed, two of carpet

// Reads along a row or a column through (0): the channels of the pixel at a place.
struct Track {
  const std::uint8_t* origin;
  std::ptrdiff_t step;  // bytes
  int red;

  const std::uint8_t* at(int i) const { return origin + i * step; }
  Light light(int i) const {
    const auto& linear = linear_light();
    const std::uint8_t* pixel = at(i);
    return {linear[pixel[red]], linear[pixel[1]], linear[pixel[2 - red]]};
  }
  bool is(const IntegerClass& colour, int i) const {
    const std::uint8_t* pixel = at(i);
    return belongs(colour, pixel[red], pixel[1], pixel[2 - red]);
  }
};

// Where white lies along the track, in pixels from its origin.
struct LineCrossing {
  float middle = 0.0F;
  float width = 0.0F;
  bool resolved = false;    // its edges are apart
  float level = 0.0F;       // whiteness that is more than carpet
  float noise_gain = 0.0F;  // of the middle's variance
  float carpet_noise = 0.0F;
};

// Of `length` pixels, at most kLongest, that may be white, from the track's origin on, with kBeside pixels of the image
// on either side. None where they are no line: too little contrast to the carpet, carpet that is uneven or differs
// between the sides, a colour.
std::optional<LineCrossing> measure_crossing(const Track& track, int length, const Carpet& carpet,
                                             const FloorOptions& options);

}  // namespace movis::scan
