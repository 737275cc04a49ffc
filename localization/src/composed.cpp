#include "movis/localization/composed.h"

#include "goal_centres.h"
#include "goal_circles.h"

namespace movis::localization {

Fix composed(const triangulation::GoalLandmarks& landmarks, const Field& field) {
  if (const FixStatus status = landmark_status(landmarks, Needs::both); status != FixStatus::ok) return failed(status);
  if (centres_contradict(landmarks, field)) return failed(FixStatus::contradiction);
  const GoalCircles circles = meet_circles(landmarks, field);
  if (circles.status != FixStatus::ok) return failed(circles.status);

  Solution solution = solve_centres(landmarks);  // (19) and (11)
  solution.world_from_robot.y = circles.y_r;     // (20)
  solution.by_yellow.row(kY) = circles.y_by_yellow;
  solution.by_blue.row(kY) = circles.y_by_blue;
  return fix_from(solution, landmarks, field);
}

}  // namespace movis::localization
