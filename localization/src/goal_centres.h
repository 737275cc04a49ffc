#pragma once

#include "landmark_fix.h"

namespace movis::localization {

// (7)–(11): the pose from the goals' centres, with its derivatives. Not finite where both centres are one point.
Solution solve_centres(const triangulation::GoalLandmarks& landmarks);

}  // namespace movis::localization
