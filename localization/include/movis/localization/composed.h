#pragma once

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/triangulation/goal_points.h"

namespace movis::localization {

// The composed method: X and heading of method 1, whose X is the better one, with the Y of method 2.
//
// Source: the MOVIS paper, section 3.2 (the second of that number), (19)–(20), as docs/paper.md corrects it; symbols as
// in method1.h and method2.h, metres and radians:
//   β   = atan2(x_p − x_q, y_p − y_q)                                                  (11)
//   X_R = ½ (y_p sin β − x_p cos β + y_q sin β − x_q cos β)                            (19), the mean of (7) and (9)
//   Y_R = [(r_P² − Y_Pc²) − (r_Q² − Y_Qc²)] / [2 (Y_Qc − Y_Pc)]                        (20), the same as (18)
// As (7) and (9) are one number, (19) averages no noise away. (17) is not used: circles that do not meet are no
// failure.
//
// Covariance of (x, y, β) in m and rad: first order, from the centres' and the edges' covariance and what they share.
// Domain: in front of both goal lines, away from the circle of radius √(Fd² + w²) about the centre spot.
// Fails with no_goal, one_goal, no_distance (a centre or an edge without a point, θ outside (0, π), or numbers that are
// not finite), contradiction (the distance between the centres is far from 2 Fd), coinciding_circles (as method2) and
// outside_field (as method1).
Fix composed(const triangulation::GoalLandmarks& landmarks, const Field& field);

}  // namespace movis::localization
