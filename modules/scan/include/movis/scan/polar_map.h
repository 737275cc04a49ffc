#pragma once

#include <cstdint>
#include <vector>

#include "movis/omni/rig.h"

namespace movis::scan {

// A stretch of a row that is scanned: columns [begin, end).
struct Run {
  int row = 0;
  int begin = 0;
  int end = 0;
};

// A pixel's unit ray in the robot's axes and the solid angle that it covers (sr; 0 where it is not scanned).
struct PixelRay {
  float x = 0.0F, y = 0.0F, z = 0.0F;
  float solid_angle = 0.0F;
};

// The paper's polar scan (§2.2, equations 1–2) turned inside out: the polar coordinates of every pixel are computed
// once, and images are visited in memory order. Azimuth bins are in the robot's axes, after tilt, so that upright
// posts stand upright. Arrays are as large as the image, row by row: index = v · width + u.
struct PolarMap {
  int width = 0;
  int height = 0;
  int bins = 0;
  std::vector<Run> runs;           // the pixels that are scanned, in memory order
  std::vector<std::uint16_t> bin;  // of the azimuth: see Histogram
  std::vector<PixelRay> ray;

  std::size_t index(int u, int v) const { return static_cast<std::size_t>(v) * width + u; }
  bool contains(int u, int v) const {
    return u >= 0 && v >= 0 && u < width && v < height && ray[index(u, v)].solid_angle > 0.0F;
  }
  std::size_t scanned_pixels() const;
};

// Scanned are the pixels that have a ray with an elevation in the given range (radians) and that the camera's mask
// leaves open. Throws an Error where the mask cannot be read or has another size than the image.
PolarMap make_polar_map(const omni::Camera& camera, int bins, double min_elevation, double max_elevation);

}  // namespace movis::scan
