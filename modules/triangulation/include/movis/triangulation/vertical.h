#pragma once

#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/omni/rig.h"

namespace movis::triangulation {

// Vertical omnidirectional stereo: two cameras above one another, range from the two elevations. MOVIS is compared with
// it (J. Gluckman, S. K. Nayar, K. J. Thoresz, Real-time omnidirectional and panoramic stereo, DARPA Image
// Understanding Workshop 1998; the paper's reference is H. Koyasu, J. Miura, Y. Shirai, 2002).
//
// The rays' planes coincide: the azimuth φ is the mean of the two, weighted by their variances. With t = tan e and z
// the viewpoints' heights the heights on both rays agree at the horizontal range
//   ρ = (z2 − z1) / (t1 − t2)
// from their common axis, and the object's height is z1 + ρ t1. No floor is needed. Real viewpoints are not quite above
// one another: with c̄ the viewpoints' weighted mean, o_k = d·(c_k − c̄) along the direction d = (cos φ, sin φ),
//   ρ = (z2 − z1 + o1 t1 − o2 t2) / (t1 − t2),   z = z1 + (ρ − o1) t1,   point = c̄ + ρ d
// which is exact along d, and across it up to the square of (offset / ρ). Covariance to first order.
// Far away var ρ = 2 ρ⁴ σ²/b² for elevations of variance σ² each and the baseline b.
struct VerticalOptions {
  double min_parallax_deg = 0.2;  // elevations that differ by less are parallel: beyond 286 baselines
};

VerticalOptions read_vertical_options(const YamlMap& map);

// The object's position in the robot frame. Statuses: not_seen, one_camera, parallel_rays, behind_camera (the
// lower camera sees it lower than the upper one does: the rays meet behind). Throws an Error where the rig is no
// vertical pair: two cameras, and their offset no more than a tenth of their distance.
PointEstimate triangulate_vertical(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                                   const VerticalOptions& options = {});

}  // namespace movis::triangulation
