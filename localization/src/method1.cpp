#include "movis/localization/method1.h"

#include "goal_centres.h"

namespace movis::localization {

Fix method1(const triangulation::GoalLandmarks& landmarks, const Field& field) {
  if (const FixStatus status = landmark_status(landmarks, Needs::centres); status != FixStatus::ok)
    return failed(status);
  return fix_from(solve_centres(landmarks), landmarks, field);
}

}  // namespace movis::localization
