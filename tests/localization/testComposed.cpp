#include "goal_scene.h"
#include "movis/localization/composed.h"

namespace movis::localization {
namespace {

// By hand: the edges are those of a robot at (0.5, 0.3), the centres those of one at (0.7, −0.2), both at β = 90°,
// where a field vector (X, Y) is (Y, −X) in the robot frame. (18) takes Y = 0.3 from the edges (testMethod2.cpp derives
// it from the same angles), (19) takes X = 0.7 and (11) β = 90° from the centres:
//   P − (0.7, −0.2) = (−0.7, 2.2), so p = (2.2, 0.7);   Q − (0.7, −0.2) = (−0.7, −1.8), so q = (−1.8, 0.7)
//   P1 − (0.5, 0.3) = (−1, 1.7) → (1.7, 1),  P2: (0, 1.7) → (1.7, 0),  Q1: (−1, −2.3) → (−2.3, 1),  Q2 → (−2.3, 0)
//   (11): atan2(2.2 + 1.8, 0.7 − 0.7) = 90°;  (19): (0.7·1 − 0 + 0.7·1 − 0)/2 = 0.7
TEST(Composed, KnownAnswer) {
  const GoalLandmarks landmarks{seen_goal({2.2, 0.7}, {1.7, 1.0}, {1.7, 0.0}),
                                seen_goal({-1.8, 0.7}, {-2.3, 0.0}, {-2.3, 1.0})};
  expect_pose(composed(landmarks, paper_field()), {0.7, 0.3, kPi / 2.0}, 1e-12);
}

TEST(Composed, RoundTripOverTheField) {
  for_each_pose([](const Pose2& truth) { expect_pose(composed(landmarks_from(truth), paper_field()), truth, 1e-9); });
}

// (17) is not used, so X = 0, where its root is noise, is a spot like any other: the paper's B, E and H.
TEST(Composed, SolvesTheAxis) {
  for (const double y : {1.1, 0.0, -1.1, 1.8}) {
    expect_pose(composed(landmarks_from({0.0, y, 2.0}), paper_field()), {0.0, y, 2.0}, 1e-12);
  }
}

// (19) as it is printed, from noisy centres.
TEST(Composed, AgreesWithPrintedEquation19) {
  RandomStream stream = make_stream(4, 0);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (int draw = 0; draw < 200; ++draw) {
    GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.03 * draw});
    for (GoalPoints* goal : goals(landmarks)) goal->centre += Eigen::Vector2d(normal(stream), normal(stream));
    const Eigen::Vector2d p = landmarks.yellow.centre;
    const Eigen::Vector2d q = landmarks.blue.centre;
    const double beta = std::atan2(p.x() - q.x(), p.y() - q.y());
    const double c = std::cos(beta);
    const double s = std::sin(beta);
    expect_pose(composed(landmarks, paper_field()), {(p.y() * s - p.x() * c + q.y() * s - q.x() * c) / 2.0, 0.3, beta},
                1e-9);
  }
}

TEST(Composed, NoGoalOneGoalNoDistance) {
  expect_missing_goals_reported(composed, [](GoalPoints& goal, PointStatus status) { goal.centre_status = status; });
  expect_missing_goals_reported(composed, [](GoalPoints& goal, PointStatus status) { goal.edges_status = status; });
}

// The circle of radius √4.25 about the centre spot passes through all edges.
TEST(Composed, CoincidingCircles) {
  for (const Pose2& truth : {Pose2{1.75, 1.09, 0.3}, Pose2{std::sqrt(4.25), 0.0, 2.0}}) {
    const Fix fix = composed(landmarks_from(truth), paper_field());
    EXPECT_EQ(fix.status, FixStatus::coinciding_circles);
    EXPECT_TRUE(is_finite(fix));
  }
}

// The edges of Method2.NegativeRadicand, whose circles do not meet, though (20) has an answer: Y = 0 by symmetry.
TEST(Composed, NegativeRadicandIsNoFailure) {
  const GoalLandmarks landmarks{seen_goal({0.0, 2.0}, {-1.0, 2.0}, {1.0, 2.0}),
                                seen_goal({0.0, -2.0}, {1.0, -2.0}, {-1.0, -2.0})};
  expect_pose(composed(landmarks, paper_field()), {0.0, 0.0, 0.0}, 1e-12);
}

TEST(Composed, EdgesThatSubtendNoAngle) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  std::swap(landmarks.yellow.left, landmarks.yellow.right);
  EXPECT_EQ(composed(landmarks, paper_field()).status, FixStatus::no_distance);
}

TEST(Composed, NonFiniteInput) {
  expect_bad_numbers_reported(composed, 0, 5);
}

TEST(Composed, OutsideField) {
  EXPECT_EQ(composed(landmarks_from({2.70, 0.5, 1.0}), paper_field()).status, FixStatus::ok);
  EXPECT_EQ(composed(landmarks_from({2.80, 0.5, 1.0}), paper_field()).status, FixStatus::outside_field);
}

TEST(Composed, GoalsSwapped) {
  expect_swapped_goals_turn_the_field(composed);
}

TEST(Composed, CovarianceIsFirstOrder) {
  for_each_pose([](const Pose2& truth) { expect_first_order_covariance(composed, landmarks_from(truth)); });
}

TEST(Composed, CovarianceIsConsistent) {
  expect_consistent_covariance(composed);
}

}  // namespace
}  // namespace movis::localization
