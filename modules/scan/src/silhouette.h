#pragma once

#include <Eigen/Core>
#include <optional>

#include "movis/core/image_view.h"
#include "movis/scan/polar_map.h"
#include "movis/scan/refine.h"

namespace movis::scan {

// The circular cone under which a ball is seen, in the robot's axes.
struct BallCone {
  double azimuth = 0.0, elevation = 0.0, radius = 0.0;   // of the axis, and half the opening angle; radians
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of the three, rad²
};

// Columns and rows of the image, ends excluded.
struct Box {
  int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};

// Fits the cone to the pixels on the ball's border, by Gauss–Newton from a start that is right to some two pixels.
//
// With n(azimuth, elevation) the cone's axis and γ its radius, a pixel with ray r lies
//   d = (n·r − cos γ)/|∇(n·r)|            pixels inside of the outline (∇: by the pixel's column and row),
// and lens and pixel let the ball have the share Φ(d/s) of its light; Φ is the normal distribution, s is fitted. Its
// light, linear red, green and blue, is the mixture  I w + B (1 − w)  of two lights around it:
//   I  of the ball: where all lamps that light a part of a sphere are far away, Lambert's law makes its brightness
//      linear in the surface's normal, so that with x, y across the disc in units of its radius
//      I = c0 + c1 x + c2 y + c3 √(1 − x² − y²); the twelve coefficients are fitted to the pixels that are not mixed;
//   B  of the surroundings: the mean beside the outline, in each of some ten to sixty sectors.
// A pixel's share is measured as  w = h·(L − B),  h = Σ⁻¹(I − B)/((I − B)ᵀ Σ⁻¹ (I − B)),  with the variance
// 1/((I − B)ᵀ Σ⁻¹ (I − B)). Σ is what the light may differ from the two: the pixels' noise and the surroundings'
// scatter as they are seen, and errors of brightness of I and B along their own colours. It is that last part that
// makes w depend on colour where brightness cannot be trusted: before a white line, at the horizon.
//
// Sectors in which something black ends the ball, or which contradict the others, are left out: a ball that the robot's
// body cuts has its centre where its visible outline says. The covariance is that of the least squares, from contrast,
// size and noise, scaled by what the residuals are.
//
// Nothing where the ball is too small, or too little of its outline is left, to carry four parameters.
std::optional<BallCone> fit_silhouette(const ImageView& image, const PolarMap& map, const Box& box,
                                       const BallCone& start, RefineScratch& scratch);

}  // namespace movis::scan
