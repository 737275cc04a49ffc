#include "goal_scene.h"
#include "movis/localization/method1.h"

namespace movis::localization {
namespace {

// By hand: robot at (0.5, 0.3), β = 30°, Fd = 2. P − R = (−0.5, 1.7) and Q − R = (−0.5, −2.3) in the field frame.
// Turned by −30° (x' = x cos + y sin, y' = −x sin + y cos; cos = 0.8660254038, sin = 0.5):
//   p = (−0.4330127019 + 0.85, 0.25 + 1.4722431864) = (0.4169872981, 1.7222431864)
//   q = (−0.4330127019 − 1.15, 0.25 − 1.9918584287) = (−1.5830127019, −1.7418584287)
TEST(Method1, KnownAnswer) {
  GoalLandmarks landmarks;
  landmarks.yellow = seen_goal({0.4169872981, 1.7222431864}, {0.0, 0.0}, {0.0, 0.0});
  landmarks.blue = seen_goal({-1.5830127019, -1.7418584287}, {0.0, 0.0}, {0.0, 0.0});
  expect_pose(method1(landmarks, paper_field()), {0.5, 0.3, kPi / 6.0}, 1e-9);
}

// By hand: robot at the origin, β = 0, p measured 0.2 m too far: p = (0, 2.2), q = (0, −2). (8) gives 2 − 2.2 = −0.2,
// (10) gives −2 + 2 = 0; their mean is −0.1.
TEST(Method1, YIsTheMeanOfBothGoals) {
  GoalLandmarks landmarks = landmarks_from({0.0, 0.0, 0.0});
  landmarks.yellow.centre = {0.0, 2.2};
  expect_pose(method1(landmarks, paper_field()), {0.0, -0.1, 0.0}, 1e-12);
}

TEST(Method1, RoundTripOverTheField) {
  for_each_pose([](const Pose2& truth) { expect_pose(method1(landmarks_from(truth), paper_field()), truth, 1e-12); });
}

// On the paper's best spots and where method 2 fails, method 1 has nothing to fear.
TEST(Method1, SolvesTheAxisAndTheCircleThroughAllEdges) {
  for (const Pose2& truth :
       {Pose2{0.0, 1.1, 2.0}, Pose2{0.0, 0.0, -1.0}, Pose2{1.75, 1.09, 0.3}, Pose2{0.0, 1.9, kPi}}) {
    expect_pose(method1(landmarks_from(truth), paper_field()), truth, 1e-12);
  }
}

// docs/paper.md: (7) and (9) are the same number once β comes from (11), however noisy p and q are; (8) and (10) are
// not.
TEST(Method1, Equations7And9Agree) {
  RandomStream stream = make_stream(3, 0);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (int draw = 0; draw < 200; ++draw) {
    GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.03 * draw});
    for (GoalPoints* goal : goals(landmarks)) goal->centre += Eigen::Vector2d(normal(stream), normal(stream));
    const Eigen::Vector2d p = landmarks.yellow.centre;
    const Eigen::Vector2d q = landmarks.blue.centre;
    const double beta = std::atan2(p.x() - q.x(), p.y() - q.y());
    const double x_by_7 = p.y() * std::sin(beta) - p.x() * std::cos(beta);
    const double x_by_9 = q.y() * std::sin(beta) - q.x() * std::cos(beta);
    const double y_by_8 = 2.0 - p.x() * std::sin(beta) - p.y() * std::cos(beta);
    const double y_by_10 = -2.0 - q.x() * std::sin(beta) - q.y() * std::cos(beta);
    EXPECT_NEAR(x_by_7, x_by_9, 1e-12);
    EXPECT_GT(std::abs(y_by_8 - y_by_10), 1e-6);
    expect_pose(method1(landmarks, paper_field()), {x_by_7, 0.5 * (y_by_8 + y_by_10), beta}, 1e-12);
  }
}

TEST(Method1, NoGoalOneGoalNoDistance) {
  expect_missing_goals_reported(method1, [](GoalPoints& goal, PointStatus status) { goal.centre_status = status; });
}

TEST(Method1, NeedsNoEdges) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  for (GoalPoints* goal : goals(landmarks)) goal->edges_status = PointStatus::parallel_rays;
  expect_pose(method1(landmarks, paper_field()), {0.5, 0.3, 0.4}, 1e-12);
}

// β has no meaning where both centres are one point.
TEST(Method1, CentresInOnePoint) {
  GoalLandmarks landmarks = with_covariance(landmarks_from({0.5, 0.3, 0.4}), 1e-3);
  landmarks.yellow.centre = landmarks.blue.centre = {0.3, 0.4};
  EXPECT_EQ(method1(landmarks, paper_field()).status, FixStatus::no_distance);
}

TEST(Method1, NonFiniteInput) {
  expect_bad_numbers_reported(method1, 0, 1);
}

// The goals' backs stand at 2 + 0.4 + 0.1 = 2.5 m, so a fix is believed up to 3.5 m in Y; in X up to 1.75 + 1 = 2.75 m.
TEST(Method1, OutsideField) {
  const Field field = paper_field();
  EXPECT_EQ(method1(landmarks_from({0.0, 3.45, 1.0}), field).status, FixStatus::ok);
  EXPECT_EQ(method1(landmarks_from({0.0, 3.55, 1.0}), field).status, FixStatus::outside_field);
  EXPECT_EQ(method1(landmarks_from({0.0, -3.55, 1.0}), field).status, FixStatus::outside_field);
  EXPECT_EQ(method1(landmarks_from({-2.70, 0.0, 1.0}), field).status, FixStatus::ok);
  EXPECT_EQ(method1(landmarks_from({-2.80, 0.0, 1.0}), field).status, FixStatus::outside_field);
}

TEST(Method1, GoalsSwapped) {
  expect_swapped_goals_turn_the_field(method1);
}

// By hand, robot at the origin, β = 0: dX = −(dx_p + dx_q)/2, dY = −(dy_p + dy_q)/2 (X_R and Y_R are 0, so β does not
// move them) and dβ = (dx_p − dx_q)/4. With variances (4, 9)e-4 m² of p and (16, 25)e-4 m² of q, uncorrelated:
// var X = (4 + 16)/4 = 5e-4, var Y = (9 + 25)/4 = 8.5e-4, var β = (4 + 16)/16 = 1.25e-4, cov(X, β) = (16 − 4)/8
// = 1.5e-4.
TEST(Method1, KnownCovariance) {
  GoalLandmarks landmarks = landmarks_from({0.0, 0.0, 0.0});
  landmarks.yellow.covariance.diagonal() << 4e-4, 9e-4, 0.0, 0.0, 0.0, 0.0;
  landmarks.blue.covariance.diagonal() << 16e-4, 25e-4, 0.0, 0.0, 0.0, 0.0;
  Eigen::Matrix3d expected;
  expected << 5e-4, 0.0, 1.5e-4,  //
      0.0, 8.5e-4, 0.0,           //
      1.5e-4, 0.0, 1.25e-4;
  EXPECT_LT((method1(landmarks, paper_field()).covariance - expected).norm(), 1e-15);
}

TEST(Method1, CovarianceIsFirstOrder) {
  for_each_pose([](const Pose2& truth) { expect_first_order_covariance(method1, landmarks_from(truth)); });
}

TEST(Method1, CovarianceIsConsistent) {
  expect_consistent_covariance(method1);
}

}  // namespace
}  // namespace movis::localization
