#pragma once

#include <cstdint>
#include <vector>

#include "movis/core/line_point.h"
#include "movis/core/pose.h"
#include "movis/core/status.h"
#include "movis/localization/instant.h"

namespace movis::localization {

// The pose from points on white lines alone. Of each LinePoint, `point` (robot frame, metres) and `sigma_on_floor` are
// used, the standard deviation of its distance from the line's middle. Points that are not finite, or whose sigma is
// not in (0, largest_sigma], are left out.
//
// The error of a pose is, with d_i the distance of point i from the nearest line's middle,
//   E = Σ (c_i²/σ_i²) d_i²/(c_i² + d_i²),   c_i² = s² + (3 f σ_i)²
// that of Lauer, Lange, Riedmiller (line_map.h), 1 − c²/(c² + d²) with c = 0.25 m, but weighted by what is known of the
// points. It is minimized on SE(2) by Levenberg–Marquardt, first with s = 0.25 m, then with s = 0, when the noise alone
// sets the scale; f ≥ 1 is by how much the distances spread more than their sigmas tell (1.4826 times the median of
// |d|/σ).
//
// Covariance of (x, y, β) in m and rad: that of an M-estimator with independent normal errors of f σ_i,
//   C = (E[ψ²]/E[ψ']²) f² (Σ J_iᵀ J_i/σ_i²)⁻¹   over the points with |d_i| < 3 f σ_i,   ψ(u) = u (9/(9 + u²))²
// times max(1, n/`independent`) for n points: neighbouring pixels share the errors of their camera's calibration, so
// more points do not tell ever more. Where the errors are independent, set `independent` to n.
//
// No line tells the half turn about the centre spot, which maps the lines of every field onto themselves: `symmetric` is
// always true, and a pose found without a guess is given in the half with y ≤ 0.
//
// Fails with
//   no_field     the map has no lines
//   no_landmark  too few points, or all on one line or one circle: a direction of the pose is left free
//   bad_fit      another field, or another camera's calibration:
//                - a larger share of the points than `outliers` lies on no line. On a line is what lies within t = half
//                  a line and 2 σ from its middle; p(t) of what lies anywhere does so by chance, p being that part of
//                  the field. With a share a of points that do and their mean p̄, the share of points that lie on a
//                  line because they are seen there is (a − p̄)/(1 − p̄)
//                - 1.4826 times the median of |d|/√(σ² + w²/12), w the line's width, exceeds `worst_spread`: the
//                  distances are more than the points' sigmas and the line itself explain. It is 1 for normal errors of
//                  that size. The line is counted here even where σ leaves it out, as that of a line's middle found to
//                  millimetres does: a pose good to a line's width may spread such points by many of their sigmas
//                - a larger share of the points than `most_left_out` is left out
//   ambiguous    (without a guess) another pose, other than by the half turn, explains the points nearly as well
struct LineMatchOptions {
  double outliers = 0.3;        // the largest share of points that may lie on no line
  double largest_sigma = 0.25;  // metres; a point that is less certain tells no line from the next one
  double worst_spread = 1.5;    // at √2 half of the variance is unexplained
  double most_left_out = 0.5;   // the largest share of points that may be left out
  double independent = 100.0;   // points count in the covariance for no more than so many
  double distinct = 0.1;        // the share of points that the best pose must explain and no other one does
  int fewest_points = 12;
};

struct LineFit {
  Fix fix;
  // Of the best pose, with status bad_fit and ambiguous too.
  int points = 0;            // that were used
  double median = 0.0;       // |distance| from the nearest line's middle, metres
  double within_15cm = 0.0;  // share of the points
  double within_5cm = 0.0;
  double on_lines = 0.0;   // the share (a − p̄)/(1 − p̄)
  double spread = 0.0;     // 1.4826 times the median of |d|/√(σ² + w²/12)
  double support = 0.0;    // the mean of t²/(t² + d²) over the points that the search takes
  double runner_up = 0.0;  // `support` of the best other pose; 0 where none was sought or found
  Pose2 other;             // that pose
};

// What the functions below write while they work; kept from call to call, they allocate nothing once they have seen as
// many points.
struct LineMatchScratch {
  struct Point {
    double x, y, sigma;
  };
  std::vector<Point> points;   // all that are used
  std::vector<Point> thinned;  // as the search takes them: one in every square of a line's width, at most 200
  std::vector<double> sizes, spreads;
  std::vector<std::uint64_t> taken;   // squares, a bit each
  std::vector<std::uint16_t> scores;  // of the positions of one heading
};

// From a guess, some decimetres and up to about 10° off.
LineFit match_lines(const std::vector<LinePoint>& points, const FieldMap& map, const Pose2& guess,
                    const LineMatchOptions& options, LineMatchScratch& scratch);

// Without a guess: every 1/24 of the field's half width and every 3° the lattice LineMap::Costs tells how well up to
// 200 points fit; the best places that differ are refined as by match_lines.
LineFit find_by_lines(const std::vector<LinePoint>& points, const FieldMap& map, const LineMatchOptions& options,
                      LineMatchScratch& scratch);

}  // namespace movis::localization
