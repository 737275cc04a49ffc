#pragma once

#include <Eigen/Core>
#include <string>

#include "movis/sim/scene.h"

namespace movis::sim {

// What stands closer than `gap` to a round body, as words for a message; empty where it is free. A body on the far side
// of the wall is not free.
std::string in_the_way(const Arena& arena, const Eigen::Vector2d& position, double radius, double gap);

}  // namespace movis::sim
