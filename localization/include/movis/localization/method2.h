#pragma once

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/triangulation/goal_points.h"

namespace movis::localization {

// Method 2: the position where the two circles meet on which the goals appear under their measured angles.
//
// Source: the MOVIS paper, section 3.1 (Method 2), (12)–(18), as docs/paper.md corrects it. w is half the distance
// between a goal's visible edges. Field::Fw is half the INNER width and the walls lie outside of it, so a camera in
// front sees the silhouette end at X = ±w with w = Fw + goal_thickness, on the goal line Y = ±Fd: P1, Q1 = (−w, ±Fd)
// and P2, Q2 = (w, ±Fd). From inside the field P1 and Q2 are the left edges of their goals.
//   θ = azimuth of the left edge − azimuth of the right edge, seen from the robot's origin, in (0, π)
//   r = w / sin θ                                                          (12)–(13), of either goal
//   X_Pc = X_Qc = 0                                                        (14)
//   Y_Pc = Fd − w cot θ_P,   Y_Qc = −Fd + w cot θ_Q                        (15)–(16): ∓√(r² − w²) without its cases
//   Y_R = [(r_P² − Y_Pc²) − (r_Q² − Y_Qc²)] / [2 (Y_Qc − Y_Pc)]            (18)
//   X_R = ∓√(r_P² − (Y_R − Y_Pc)²), − where P1 is not farther than P2      (17)
// The paper gives no heading. Here it is the circular mean of the headings that the four edges imply at (X_R, Y_R):
//   β_i = atan2(Y_i − Y_R, X_i − X_R) − atan2(y_i, x_i);
// as a goal's angle θ is met exactly, its two edges imply the same heading, and this is the mean of both goals.
//
// Covariance of (x, y, β) in m and rad: first order, from the covariance of the edges' points; distances enter only
// through the sign in (17). It grows without bound as X_R → 0, where the root's slope does.
// Domain: in front of both goal lines; away from X = 0, where the sign in (17) is noise; away from the circle of
// radius √(Fd² + w²) about the centre spot, which passes through all four edges and makes (18) 0/0.
// Fails with no_goal, one_goal, no_distance (an edge without a point, θ outside (0, π), or numbers that are not
// finite), coinciding_circles (the distance between the circles' centres is below 1 cm or within three of its own
// standard deviations of zero), negative_radicand (the circles do not meet, or only touch: then the root has no slope;
// noise does this on about half of the fixes near X = 0) and outside_field (as method1).
Fix method2(const triangulation::GoalLandmarks& landmarks, const Field& field);

}  // namespace movis::localization
