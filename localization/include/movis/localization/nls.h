#pragma once

#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/localization/instant.h"
#include "movis/localization/line_match.h"

namespace movis::localization {

// Robust nonlinear least squares: the pose that explains best under which azimuths every camera sees the goals' edges
// and where it sees white lines.
//
// Unknowns: pose (x, y, β) and, for each goal, the bias b of its edges, outwards, radians. Detected edges of one goal err
// together (how its light mixes with its surroundings', how thick its paint is), so that more cameras do not average it
// away; it has the prior N(0, edge_bias²).
//   edge    r = φ − (azimuth of the silhouette's corner as seen from the camera's viewpoint − β) − s b,
//           s = +1 for the left edge, −1 for the right one; the silhouette is that of goal_silhouette.h
//   line    r = signed distance of the point, placed in the field, from the middle of the nearest line (line_map.h)
// Loss: Geman–McClure, ρ(u) = ½ u² c²/(c² + u²) of u = r/σ. Its width shrinks from the start's uncertainty to c = 4
// in the end (graduated non-convexity: A. Blake, A. Zisserman, Visual Reconstruction, 1987; H. Yang et al., RA-L 5(2),
// 2020), but not below the narrowest at which six in ten of the clean edges agree: where those spread more than their
// sigmas tell, as with a rig that is not what its file says, all sigmas grow by their robust scale. An edge that
// something covers is an outlier and loses its weight, also when the scan did not notice. Line points of one line err
// together as well: all of them weigh no more than `line_points` independent ones, and they have a scale of their own.
//
// Start without a guess: places on a lattice over the field, the heading of each by the edges' circular mean, the best of
// them refined; where the edges do not suffice, by lines (line_match.h).
//
// Covariance of (x, y, β): the inverse of the weighted normal equations, the biases eliminated.
// What speaks against a pose: half of the clean edges of either goal lying elsewhere; six in ten line points lying on no
// line (less those that would by chance). Where no lines are seen though the field has some, both goals must be seen and
// three quarters of the clean edges agree, to three times their sigmas.
// Fails with
//   no_goal, one_goal, no_landmark  not enough was seen: of coloured goals none, one or both, or of lines
//   ambiguous     another pose fits nearly as well. The pose given is one of them; where it is the half turn that is
//                 open, `symmetric` is set: lines alone, on a field with coloured goals
//   bad_fit       edges or lines speak against the best pose, or the edges' scale exceeds `worst_scale`
//   outside_field farther than half a metre beyond the lines or the goals' backs
// With white goals (field.yaml) only lines are used: ok with `symmetric` set, right up to the half turn.
// Allocates nothing, after the first call in a thread.
struct NlsOptions {
  double edge_floor_deg = 0.014;  // sigma added to each edge's own: the silhouette's model, the lens's
  double edge_bias_deg = 0.015;
  double line_floor = 0.003;  // sigma added to each line point's own, metres
  double line_points = 25.0;  // that all line points count for at most
  double loss_width = 4.0;    // c
  double worst_scale = 60.0;  // of the residuals over their sigma
  double worst_sigma = 0.10;  // of the position, metres: above it, the pose counts as not determined
  LineMatchOptions lines;     // for the start by lines
};

NlsOptions read_nls_options(const YamlMap& map);

// From no guess.
Fix nls(const Instant& instant, const FieldMap& map, const NlsOptions& options);

// From a guess of the pose, to within about half a metre and 20°.
Fix nls_from(const Pose2& guess, const Instant& instant, const FieldMap& map, const NlsOptions& options);

}  // namespace movis::localization
