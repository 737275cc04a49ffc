#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "eye.h"
#include "sensor.h"
#include "stage.h"
#include "surrounding.h"
#include "tile.h"

namespace movis::sim {

inline constexpr int kStripRows = 8 * kTile;  // of the picture, that are made in one piece

// A camera: its eye, its sensor, and what lies beside its mirror.
struct CameraParts {
  Eye eye;
  SensorRow sensor;
  Surrounding surrounding;
  Colour beside;
};

// Memory to make strips in, for one thread at a time and for cameras with rows up to a length.
struct Workspace {
  Workspace(int row_floats, int corners);

  std::vector<float> light;  // some rows of three planes, row by row around a ring
  std::vector<float> scratch;
  LightRows rows;
  using Row = std::array<std::vector<float>, 3>;
  Row above, below;  // light at the upper and lower corners of a row of pixels
  TileScratch tiles;
};

// The rows from first_row to end_row of a camera's picture: the stage's light, then what the sensor makes of it.
void make_strip(const CameraParts& camera, const Stage& stage, const Pose2& world_from_robot, int first_row,
                int end_row, std::uint64_t noise_seed, Workspace& workspace, std::uint8_t* bgr);

}  // namespace movis::sim
