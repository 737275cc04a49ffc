#pragma once

#include <cstdint>
#include <vector>

#include "movis/sim/look.h"

namespace movis::sim {

// What a camera's sensor makes of the even colour beside the mirror: so much of it that every row can begin somewhere
// else.
class Surrounding {
 public:
  Surrounding(const Colour& colour, const Sensor& sensor, int width);

  // The pixels from `begin` to `end` of a row of 8-bit blue, green, red.
  void copy(std::uint32_t noise_key, int begin, int end, std::uint8_t* bgr) const;

 private:
  std::vector<std::uint8_t> bgr_;
};

}  // namespace movis::sim
