#pragma once

#include "landmark_fix.h"

namespace movis::localization {

// (7)–(11): the pose from the goals' centres, with its derivatives. Not finite where both centres are one point.
Solution solve_centres(const triangulation::GoalLandmarks& landmarks);

// Is the measured distance of the goals from each other another one than 2 Fd? Farther off than five of its standard
// deviations and a quarter of 2 Fd: the mid-bearing makes both goals seem up to 15 % too far, and that is no
// contradiction.
bool centres_contradict(const triangulation::GoalLandmarks& landmarks, const Field& field);

}  // namespace movis::localization
