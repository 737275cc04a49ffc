#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/obstacle.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"

namespace movis::triangulation {

// Obstacles from the sights of all cameras.
//
// One sight, of a foot whose nearest point is r away under azimuths φ_l (left) and φ_r (right), taken as round:
//   α = (φ_l − φ_r)/2     R = r sin α/(1 − sin α)     d = r + R = r/(1 − sin α)     axis: d away at (φ_l + φ_r)/2
// with variances, σ of the distance and τ of each of the two azimuths,
//   along the sight   σ²/(1 − sin α)² + (r cos α/(1 − sin α)²)² τ²/2       across it   d² τ²/2
// Sights whose axes are as near to each other as one body allows are of one obstacle. Its axis is their mean, weighted
// with the inverse covariances, its radius that weighted with the inverse variances. The covariance of the foot
// is that of the best sight alone, since what errs most, the shadow at a foot, errs alike in all. Robot frame; metres,
// radians.
//
// Where this fails: a body that is not round is off by what it differs from its inscribed circle; one that something
// else hides in part is taken for a slimmer one that stands nearer the visible part; two that touch may become one.
struct ObstacleOptions {
  double azimuth_sigma_deg = 0.4;  // τ: half the step between two azimuths of the scan, and its direction
  double distance_sigma = 0.01;    // of a foot on the floor, beside the sight's own, metres: shadow, not quite round
  double largest_radius = 0.4;     // metres
  double same_distance = 0.2;      // between the axes of sights of one obstacle, metres, beside two of their sigmas
};

ObstacleOptions read_obstacle_options(const YamlMap& map);

// `obstacles` is cleared first; at most kMostObstacles. Sights of a camera that the rig has not, and a rig of more than
// 32 cameras, throw an Error.
inline constexpr int kMostObstacles = 32;
void merge_obstacles(const omni::Rig& rig, const std::vector<ObstacleSight>& sights, const ObstacleOptions& options,
                     std::vector<Obstacle>& obstacles);

// The edges of goals that lie within or at the border of an obstacle's azimuths, as one camera sees both, are hidden
// somewhere behind it, since the obstacle's foot would not be seen through the goal. The edge's standard deviation
// becomes half of the goal's seen width, and edge and bearing are flagged kCutByObject. Sights and bearings are to be of
// the same instant, both corrected or both not.
void hide_covered_edges(const std::vector<ObstacleSight>& sights, std::vector<Bearing>& bearings);

}  // namespace movis::triangulation
