#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/scan/refine.h"
#include "spans.h"

namespace movis::scan {

// The points of the outline, finer than a pixel, into scratch.outline: where the membership passes ½ between
// neighbours. Left out are those at which the ball ends at something black, which hides the rest of it.
void collect_outline(const ImageView& image, const PolarMap& map, Rows rows, RefineScratch& scratch);

struct Cone {
  Eigen::Vector3d axis;
  Eigen::Matrix3d axis_covariance;
  double radius;  // half the opening angle, radians
};

// Fits r·m = 1 (refine.h), trimming what lies farther off than three times the median. `pixel` is the angle that a
// pixel covers. Nothing where too little is left.
std::optional<Cone> fit_cone(const std::vector<Eigen::Vector3f>& outline, double pixel, std::vector<float>& values);

}  // namespace movis::scan
