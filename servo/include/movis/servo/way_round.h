#pragma once

#include "movis/core/field.h"
#include "movis/core/pose.h"

// The way round the ball, in the shot frame: origin under the ball's centre, y axis from the ball to the goal's centre,
// z up. The robot shoots from (0, −standoff) along y.
//
// The shortest way from a place P to the shooting place that keeps the distance ρ (`orbit`) from the ball is a tangent
// of the circle of radius ρ, an arc of it, and the way in. With R = |P|, the tangent touches the circle after a turn of
//   τ = acos(ρ/R)   (0 for R ≤ ρ)
// about the ball. A servo needs one pose to go to: here it is the point of that tangent `lead` λ beyond the touching
// point, which lies at the distance ρ/cos λ. On the circle the robot then moves along the circle; from inside it moves
// outwards; and from outside it never comes closer than ρ. As it goes round, the point runs ahead of it until it has
// come behind the ball; then, as the detour δ (the turn about the ball that is left) goes from τ + λ to τ, its
// distance goes from ρ/cos λ to the standoff, and for |δ| ≤ τ the shooting place is in sight and is the goal itself.
namespace movis::servo {

// Distances from the ball's centre to the robot's, metres. 0 < standoff ≤ orbit, 0 < lead < π/2.
struct WayRound {
  double standoff = 0.0;
  double orbit = 0.0;
  double lead = 0.0;  // radians
};

// The turn about the ball, from the robot's place to the shooting place, in (−π, π], as control::Percepts::detour. 0 at
// the ball's centre.
double detour_of(const Eigen::Vector2d& robot_in_shot);

// Where to go from a place at a distance from the ball. The sign of the detour is the side on which to go round; it may
// be the longer way, with |detour| > π.
Eigen::Vector2d waypoint_in_shot(const WayRound& way, double distance, double detour);

// The nearest place that keeps the distance `room` from the goals' side walls and posts: where the ball lies before a
// post, the shooting place may be one that the hull cannot take. Field frame.
Eigen::Vector2d clear_of_goals(const Eigen::Vector2d& place, const Field& field, double room);

}  // namespace movis::servo
