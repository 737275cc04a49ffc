#include <gtest/gtest.h>

#include <cmath>

#include "movis/localization/goal_silhouette.h"
#include "movis/core/angle.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

// Outer corners of the yellow goal: front (±0.5, 2), side walls' ends (±0.5, 2.5), back wall (±0.4, 2.6).
Field field() {
  Field field;
  field.Fd = 2.0;
  field.Fw = 0.4;
  field.goal_thickness = 0.1;
  field.goal_depth = 0.5;
  return field;
}

// From (0, 1.5) the front posts are at (±0.5, 0.5): at 45° and 135°.
TEST(GoalSilhouette, FrontPostsFromBeforeIt) {
  const Silhouette seen = goal_silhouette(field(), ObjectClass::yellow_goal, Vector2d(0.0, 1.5));
  EXPECT_NEAR(degrees(seen.left), 135.0, 1e-9);
  EXPECT_NEAR(degrees(seen.right), 45.0, 1e-9);
}

TEST(GoalSilhouette, BlueGoalIsTheMirrorImage) {
  const Silhouette seen = goal_silhouette(field(), ObjectClass::blue_goal, Vector2d(0.0, -1.5));
  EXPECT_NEAR(degrees(seen.left), -45.0, 1e-9);
  EXPECT_NEAR(degrees(seen.right), -135.0, 1e-9);
}

// From (1.5, 1.5), oblique: the left front post (−0.5, 2) lies at (−2, 0.5); on the right the near front post (0.5, 2)
// at (−1, 0.5) has 153.4°, the end of its wall (0.5, 2.5) at (−1, 1) has 135°, the back wall's corner (0.4, 2.6) at
// (−1.1, 1.1) the same.
TEST(GoalSilhouette, BackCornerFromBesideIt) {
  const Silhouette seen = goal_silhouette(field(), ObjectClass::yellow_goal, Vector2d(1.5, 1.5));
  EXPECT_NEAR(seen.left, std::atan2(0.5, -2.0), 1e-12);
  EXPECT_NEAR(degrees(seen.right), 135.0, 1e-9);
}

// From (1.5, 1.9), beside it, the back wall sticks out behind the side wall's end: (−1.1, 0.7) instead of (−1, 0.6).
TEST(GoalSilhouette, BackWallSticksOut) {
  const Silhouette seen = goal_silhouette(field(), ObjectClass::yellow_goal, Vector2d(1.5, 1.9));
  EXPECT_NEAR(seen.left, std::atan2(0.1, -2.0), 1e-12);
  EXPECT_NEAR(seen.right, std::atan2(0.7, -1.1), 1e-12);
  EXPECT_LT(seen.right, std::atan2(0.6, -1.0));
}

// Looking along −x the azimuths run across ±180°. From (2.5, 2.3) the near front post (0.5, 2) lies at (−2, −0.3), to
// the left, and the back wall's near corner (0.4, 2.6) at (−2.1, 0.3).
TEST(GoalSilhouette, AcrossTheCut) {
  const Silhouette seen = goal_silhouette(field(), ObjectClass::yellow_goal, Vector2d(2.5, 2.3));
  EXPECT_NEAR(seen.left, std::atan2(-0.3, -2.0), 1e-12);
  EXPECT_NEAR(seen.right, std::atan2(0.3, -2.1), 1e-12);
  EXPECT_GT(turn(seen.right, seen.left), 0.0);
}

}  // namespace
}  // namespace movis::localization
