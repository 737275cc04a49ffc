#pragma once

#include <Eigen/Core>
#include <vector>

#include "movis/sim/scene.h"

namespace movis::sim {

// An upright slab of the field frame, standing on the floor: a wall of a goal, or of the hall.
struct Panel {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();  // half its extent along X and Y
  double height = 0.0;
};

// Both goals: two side walls each, outside ±Fw from the goal line outward, and the back between them.
std::vector<Panel> goal_panels(const Field& field);

// The four sides of the wall; none without a wall or a field.
std::vector<Panel> wall_panels(const Arena& arena);

// From a point to the nearest of the panels' surfaces, metres; 0 inside one, infinite without panels.
double distance(const std::vector<Panel>& panels, const Eigen::Vector2d& point);

}  // namespace movis::sim
