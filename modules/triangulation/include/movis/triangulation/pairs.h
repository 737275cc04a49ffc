#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"
#include "movis/triangulation/goal_points.h"

namespace movis::triangulation {

// MOVIS by pairs (the paper's §2.4, equations 3–4; docs/paper.md for the geometry that they imply).
//
// Every two cameras are a stereo pair, and a pair owns the directions that are most nearly perpendicular to its
// baseline, whatever the rig. In an equilateral triangle that gives every pair two opposite sectors of 60°. The paper
// gives it one of 120°, the outward side of its baseline: at that area's borders another pair looks at the object more
// squarely, across the robot, and measures its distance better (docs/accuracy.md).
//
// Equations (3)–(4) divide by tan λ2 − tan λ1. Here the two directed lines
//   c1 + s1 (cos φ1, sin φ1),   c2 + s2 (cos φ2, sin φ2)
// are intersected instead: with b = c2 − c1 and D = sin(φ2 − φ1),
//   s1 = (b × d2)/D,   s2 = (b × d1)/D          (× is the planar cross product)
// which is well behaved in every direction. A point needs s1 > 0 and s2 > 0. The height is what the two elevations
// say, z_k + s_k tan(elevation_k), weighted by their variances. Covariance is propagated from the bearings' to first
// order, with bearings of different cameras independent.

struct PairsOptions {
  double min_parallax_deg = 0.2;  // rays that differ by less are parallel: beyond 286 baselines
};

PairsOptions read_pairs_options(const YamlMap& map);

// Two cameras' planar intersection, with its derivative by the two azimuths.
struct Intersection {
  PointStatus status = PointStatus::not_seen;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  double range1 = 0.0, range2 = 0.0;                            // along the rays, metres
  Eigen::Matrix2d point_by_azimuths = Eigen::Matrix2d::Zero();  // metres a radian
};

Intersection intersect(const Eigen::Vector2d& position1, double azimuth1, const Eigen::Vector2d& position2,
                       double azimuth2, const PairsOptions& options = {});

// The object's position in the robot frame from the bearings of its class. Where a pair's bearings are flagged or have
// a large covariance, the next best pair takes over. A precondition that is broken (a rig of one camera, a bearing of a
// camera that the rig has not) throws.
PointEstimate triangulate_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                const PairsOptions& options = {});

// A goal's centre and edges in the robot frame, each by the pair that owns its direction.
GoalPoints triangulate_goal_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                                  const PairsOptions& options = {});

}  // namespace movis::triangulation
