#pragma once

#include <string_view>
#include <vector>

#include "movis/triangulation/joint.h"
#include "movis/triangulation/obstacles.h"
#include "movis/triangulation/pairs.h"

namespace movis::triangulation {

struct Options {
  PairsOptions pairs;
  JointOptions joint;
  ObstacleOptions obstacles;
};

// Strict: the maps `pairs`, `joint` and `obstacles`, each optional.
Options read_options(const YamlMap& map);

// How bearings become points: pairs or joint. Both have one shape, so that comparing them is a table.
struct Triangulator {
  PointEstimate (*ball)(const omni::Rig& rig, const std::vector<Bearing>& bearings, const Options& options);
  GoalPoints (*goal)(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                     const Options& options);
  void (*require)(const omni::Rig& rig);  // throws an Error where the rig has no parallax for it
};

// What a program uses that is not told otherwise.
inline constexpr std::string_view kDefaultTriangulator = "joint";

std::vector<std::string_view> triangulator_names();
Triangulator find_triangulator(std::string_view name);  // throws an Error naming what there is

}  // namespace movis::triangulation
