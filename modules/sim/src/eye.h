#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "backdrop.h"
#include "bounds.h"
#include "own_robot.h"

namespace movis::sim {

inline constexpr int kTile = 16;  // pixels along each side of a tile

// One camera of the rig: what stays the same from picture to picture.
struct Eye {
  Eye(const omni::Rig& rig, std::size_t camera, const control::RobotModel& robot, const Look& look);

  struct Tile {
    Bounds bounds;       // of its rays, in the robot's axes
    bool hidden = true;  // everywhere: there is nothing but the own robot
  };

  // The unit ray through the top left corner of a pixel, in the robot's axes; u ≤ width, v ≤ height.
  Eigen::Vector3f corner(int u, int v) const {
    const std::size_t i = static_cast<std::size_t>(v) * stride + u;
    return {corners[0][i], corners[1][i], corners[2][i]};
  }
  // The same, and those to the right of it.
  RayPlanes corner_row(int u, int v) const {
    const std::size_t i = static_cast<std::size_t>(v) * stride + u;
    return {&corners[0][i], &corners[1][i], &corners[2][i]};
  }

  // What the other units' mirrors show in a row.
  std::pair<const Reflection*, const Reflection*> reflections_of(int row) const {
    return {own.reflections.data() + first_reflection[row], own.reflections.data() + first_reflection[row + 1]};
  }

  Eigen::Vector3f position;  // of the viewpoint in the robot frame
  int width, height;
  int tile_columns, tile_rows;
  int stride;                                 // of the corners, filled up to whole vectors
  std::array<std::vector<float>, 3> corners;  // x, y, z
  OwnRobot own;
  std::vector<Tile> tiles;  // row by row

  // Parts of rows. Where the floor may be seen, light is taken at the pixels' corners as well as at their middles.
  struct Span {
    int begin = 0, end = 0;
    bool empty() const { return begin >= end; }
  };
  std::vector<std::vector<Span>> open;           // by row: pixels that are not all the own robot
  std::vector<std::vector<Span>> floor;          // by row: those of them that may show the floor
  std::vector<std::vector<Span>> floor_corners;  // by row of corners: those of such pixels
  std::vector<std::vector<Span>> own_robot;      // by row: pixels that are the own robot, at least in part
  std::vector<Span> mirror;                      // by row: beside it there is nothing but the colour `outside`
  std::vector<std::size_t> first_reflection;     // by row, and one more

 private:
  void find_corners(const omni::Camera& camera);
  void find_spans();
  Tile make_tile(int column, int row) const;
};

}  // namespace movis::sim
