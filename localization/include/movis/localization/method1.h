#pragma once

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/triangulation/goal_points.h"

namespace movis::localization {

// Method 1: the pose from the centres of both goals, P = (0, Fd) of the yellow one and Q = (0, −Fd) of the blue one.
//
// Source: the MOVIS paper, section 3.1, (5)–(11), with p and q the measured centres in the robot frame, metres:
//   β   = atan2(x_p − x_q, y_p − y_q)          (11), with the quadrant that the printed arctan loses (docs/paper.md)
//   X_R = y_p sin β − x_p cos β                (7), the same number as (9) once β comes from (11) (docs/paper.md)
//   Y_R = ½ [(Fd − x_p sin β − y_p cos β) + (−Fd − x_q sin β − y_q cos β)]        the mean of (8) and (10)
// The paper offers (8) and (10) without saying which is taken; the mean treats both goals alike, as its (19) does.
//
// Covariance of (x, y, β) in m and rad: first order, from the covariance of the two centres.
// Domain: any pose, but p ≠ q. The distance between p and q is not compared with 2 Fd: method 1 has no such check.
// Fails with no_goal, one_goal, no_distance (a centre without a point, or numbers that are not finite) and
// outside_field (farther than kOutsideMargin beyond the lines or the goals' backs).
// Two goals alone cannot tell that their colours were swapped: the fix is then turned by 180° about the centre spot.
Fix method1(const triangulation::GoalLandmarks& landmarks, const Field& field);

}  // namespace movis::localization
