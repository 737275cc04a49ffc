#pragma once

#include <vector>

#include "hall.h"
#include "standpoint.h"

namespace movis::sim {

// Hall::colour() for many rays at once, a vector of them at a time.
struct RayPlanes {
  const float* x;  // robot's axes; of any length
  const float* y;
  const float* z;
};
struct LightPlanes {
  float* red;
  float* green;
  float* blue;
};

// Along `count` rays. The light is written up to the next whole vector.
void see_hall(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint, const RayPlanes& rays,
              int count, const LightPlanes& light);

// The same through the middles of `count` pixels, whose upper left corners' rays are given; the lower left ones are
// `stride` floats further on.
void see_hall_between(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint,
                      const RayPlanes& corners, int stride, int count, const LightPlanes& light);

}  // namespace movis::sim
