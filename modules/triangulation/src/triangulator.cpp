#include "movis/triangulation/triangulator.h"

#include <Eigen/Core>
#include <algorithm>
#include <string>

#include "movis/core/error.h"
#include "movis/core/names.h"
#include "sights.h"

namespace movis::triangulation {
namespace {

constexpr double kShortestBaseline = 0.01;  // metres

double longest_baseline(const omni::Rig& rig, int dimensions) {
  double longest = 0.0;
  for (const omni::Camera& one : rig.cameras) {
    for (const omni::Camera& two : rig.cameras) {
      longest = std::max(longest, (one.position - two.position).head(dimensions).norm());
    }
  }
  return longest;
}

PointEstimate ball_by_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, const Options& options) {
  return triangulate_pairs(rig, bearings, ObjectClass::ball, options.pairs);
}

GoalPoints goal_by_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                         const Options& options) {
  return triangulate_goal_pairs(rig, bearings, goal, options.pairs);
}

void require_for_pairs(const omni::Rig& rig) {
  if (rig.cameras.size() < 2) {
    throw Error("triangulation needs a rig of two or more cameras; this one has {}", rig.cameras.size());
  }
  if (longest_baseline(rig, 2) >= kShortestBaseline) return;
  throw Error(
      "triangulation by pairs needs two cameras that stand at least {} m apart on the floor plane; check `position` of "
      "the rig's cameras, or triangulate jointly",
      kShortestBaseline);
}

PointEstimate ball_jointly(const omni::Rig& rig, const std::vector<Bearing>& bearings, const Options& options) {
  return triangulate_joint(rig, bearings, ObjectClass::ball, options.joint);
}

GoalPoints goal_jointly(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                        const Options& options) {
  return triangulate_goal_joint(rig, bearings, goal, options.joint);
}

void require_for_joint(const omni::Rig& rig) {
  require_joint_rig(rig);
  if (longest_baseline(rig, 3) >= kShortestBaseline) return;
  throw Error("triangulation needs two cameras that are at least {} m apart; check `position` of the rig's cameras",
              kShortestBaseline);
}

struct Entry {
  std::string_view name;
  Triangulator triangulator;
};

constexpr Entry kTriangulators[] = {{"pairs", {ball_by_pairs, goal_by_pairs, require_for_pairs}},
                                    {"joint", {ball_jointly, goal_jointly, require_for_joint}}};

}  // namespace

Options read_options(const YamlMap& map) {
  map.allow({"pairs", "joint", "obstacles"});
  Options options;
  if (map.has("pairs")) options.pairs = read_pairs_options(map.map("pairs"));
  if (map.has("joint")) options.joint = read_joint_options(map.map("joint"));
  if (map.has("obstacles")) options.obstacles = read_obstacle_options(map.map("obstacles"));
  return options;
}

std::vector<std::string_view> triangulator_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kTriangulators) names.push_back(entry.name);
  return names;
}

Triangulator find_triangulator(std::string_view name) {
  for (const Entry& entry : kTriangulators) {
    if (entry.name == name) return entry.triangulator;
  }
  const auto known = triangulator_names();
  throw Error("there is no triangulator '{}'{}", name, suggestion(name, {known.begin(), known.end()}));
}

}  // namespace movis::triangulation
