#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "movis/control/robot_model.h"
#include "movis/omni/rig.h"
#include "movis/sim/look.h"

namespace movis::sim {

// A part of a pixel that another unit's mirror fills: what it shows comes along this ray.
struct Reflection {
  int row, column;            // of the pixel
  float weight;               // of the pixel
  Eigen::Vector3f origin;     // robot frame
  Eigen::Vector3f direction;  // robot's axes, unit
};

// What a camera sees of its own robot, and of nothing: the hull, the other sensor units (camera and mirror), and the
// picture beside the mirror. It stands still in the picture, so it is found once and laid over everything else. Only
// what the other mirrors show changes: a ball or a goal is seen a second time in them.
struct OwnRobot {
  std::vector<float> open;                   // by pixel: the part of it that shows the world
  std::vector<bool> outside;                 // by pixel: beside the mirror
  std::array<std::vector<float>, 3> planes;  // linear red, green, blue of the other part, without the reflections
  std::vector<Reflection> reflections;       // row by row
};

// As the camera of that index in the rig sees it.
OwnRobot see_own_robot(const omni::Rig& rig, std::size_t index, const control::RobotModel& robot, const Look& look);

}  // namespace movis::sim
