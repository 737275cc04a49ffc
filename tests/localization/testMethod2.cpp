#include "goal_scene.h"
#include "movis/localization/method2.h"

namespace movis::localization {
namespace {

GoalPoints edges(const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
  return seen_goal({0.0, 0.0}, left, right);
}

void turn_edges(GoalPoints& goal, double angle) {
  const Pose2 turned{0.0, 0.0, angle};
  goal.left = turned * goal.left;
  goal.right = turned * goal.right;
}

// By hand: robot at (0.5, 0.3), β = 30°, Fd = 2, w = 0.5. In the field frame P1 − R = (−1, 1.7), P2 − R = (0, 1.7),
// Q1 − R = (−1, −2.3), Q2 − R = (0, −2.3). P2 stands square to P1P2, so cot θ_P = 1.7/1 and likewise cot θ_Q = 2.3:
//   Y_Pc = 2 − 0.85 = 1.15, r_P² = 0.25 + 0.85² = 0.9725;  Y_Qc = −2 + 1.15 = −0.85, r_Q² = 0.25 + 1.15² = 1.5725
//   (18): ((0.9725 − 1.3225) − (1.5725 − 0.7225)) / (2·(−2)) = −1.2 / −4 = 0.3
//   (17): √(0.9725 − 0.85²) = √0.25 = 0.5, positive as P2 is the nearer edge
// Turned by −30° (cos = 0.8660254038, sin = 0.5):
//   P1 = (−0.8660254038 + 0.85, 0.5 + 1.4722431864),  P2 = (0.85, 1.4722431864)
//   Q1 = (−0.8660254038 − 1.15, 0.5 − 1.9918584287),  Q2 = (−1.15, −1.9918584287)
TEST(Method2, KnownAnswer) {
  const GoalLandmarks landmarks{edges({-0.0160254038, 1.9722431864}, {0.85, 1.4722431864}),
                                edges({-1.15, -1.9918584287}, {-2.0160254038, -1.4918584287})};
  expect_pose(method2(landmarks, paper_field()), {0.5, 0.3, kPi / 6.0}, 1e-9);
}

TEST(Method2, RoundTripOverTheField) {
  for_each_pose([](const Pose2& truth) { expect_pose(method2(landmarks_from(truth), paper_field()), truth, 1e-9); });
}

// (12)–(18) as they are printed, with the two cases of (15) and the corrections of docs/paper.md, give the same
// position; the second case is that of a robot within the half circle over the goal mouth. √(r² − w²) = w |cot θ| is
// what (15) rests on.
TEST(Method2, AgreesWithThePrintedEquations) {
  int wide = 0;
  const double w = 0.5;
  for_each_pose([&](const Pose2& truth) {
    GoalLandmarks landmarks = landmarks_from(truth);
    turn_edges(landmarks.yellow, 0.02);  // the position does not see it, the heading does
    const auto angle = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
      return std::acos(a.normalized().dot(b.normalized()));
    };
    const double theta_p = angle(landmarks.yellow.left, landmarks.yellow.right);
    const double theta_q = angle(landmarks.blue.left, landmarks.blue.right);
    const double r_p = w / std::sin(theta_p);
    const double r_q = w / std::sin(theta_q);
    const double root_p = std::sqrt(r_p * r_p - w * w);
    const double root_q = std::sqrt(r_q * r_q - w * w);
    EXPECT_NEAR(root_p, w * std::abs(1.0 / std::tan(theta_p)), 1e-9);
    const double y_pc = theta_p < kPi / 2.0 ? 2.0 - root_p : 2.0 + root_p;
    const double y_qc = theta_q < kPi / 2.0 ? -2.0 + root_q : -2.0 - root_q;
    const double y_r = ((r_p * r_p - y_pc * y_pc) - (r_q * r_q - y_qc * y_qc)) / (2.0 * (y_qc - y_pc));
    const double x_r = std::sqrt(r_p * r_p - (y_r - y_pc) * (y_r - y_pc));
    wide += theta_p >= kPi / 2.0 || theta_q >= kPi / 2.0 ? 1 : 0;
    const bool p1_is_nearer = landmarks.yellow.left.norm() <= landmarks.yellow.right.norm();
    const Fix fix = method2(landmarks, paper_field());
    ASSERT_EQ(fix.status, FixStatus::ok);
    EXPECT_NEAR(fix.world_from_robot.x, p1_is_nearer ? -x_r : x_r, 1e-6);
    EXPECT_NEAR(fix.world_from_robot.y, y_r, 1e-6);
  });
  EXPECT_GT(wide, 0);
}

// (17): only the nearer edge of the yellow goal tells the side. From (0.5, 0.3) P2 is nearer; measured as the farther
// one, on an unchanged bearing, it puts the robot at the mirror position.
TEST(Method2, TheNearerYellowEdgeTellsTheSide) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  EXPECT_NEAR(method2(landmarks, paper_field()).world_from_robot.x, 0.5, 1e-9);
  landmarks.yellow.right *= 2.0;
  const Fix mirrored = method2(landmarks, paper_field());
  EXPECT_NEAR(mirrored.world_from_robot.x, -0.5, 1e-9);
  EXPECT_NEAR(mirrored.world_from_robot.y, 0.3, 1e-9);
}

// The blue goal is not asked, and no other distance enters.
TEST(Method2, DistancesDoNotMatterBeyondTheSide) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  landmarks.yellow.left *= 1.3;
  landmarks.yellow.right *= 0.9;
  landmarks.blue.left *= 3.0;
  landmarks.blue.right *= 0.7;
  expect_pose(method2(landmarks, paper_field()), {0.5, 0.3, 0.4}, 1e-9);
}

// Turning both edges of the blue goal by 2° about the robot leaves both angles and so the position; the blue goal then
// implies a heading 2° less, and the circular mean is 1° less: across ±180° as well.
TEST(Method2, HeadingIsTheCircularMeanOfTheEdges) {
  for (const double beta_deg : {20.0, 180.0, 180.5, 181.0, -179.2}) {
    GoalLandmarks landmarks = landmarks_from({0.5, 0.3, radians(beta_deg)});
    turn_edges(landmarks.blue, radians(2.0));
    expect_pose(method2(landmarks, paper_field()), {0.5, 0.3, radians(beta_deg - 1.0)}, 1e-9);
  }
}

TEST(Method2, NoGoalOneGoalNoDistance) {
  expect_missing_goals_reported(method2, [](GoalPoints& goal, PointStatus status) { goal.edges_status = status; });
}

TEST(Method2, NeedsNoCentres) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  for (GoalPoints* goal : goals(landmarks)) goal->centre_status = PointStatus::parallel_rays;
  expect_pose(method2(landmarks, paper_field()), {0.5, 0.3, 0.4}, 1e-9);
}

// θ is not in (0, π): left and right exchanged, or both edges in one direction.
TEST(Method2, EdgesThatSubtendNoAngle) {
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  std::swap(landmarks.blue.left, landmarks.blue.right);
  EXPECT_EQ(method2(landmarks, paper_field()).status, FixStatus::no_distance);
  landmarks = landmarks_from({0.5, 0.3, 0.4});
  landmarks.yellow.left = 1.1 * landmarks.yellow.right;
  EXPECT_EQ(method2(landmarks, paper_field()).status, FixStatus::no_distance);
}

// All edges lie at √4.25 from the centre spot, and from anywhere on that circle both circles are that circle.
TEST(Method2, CoincidingCircles) {
  for (const Pose2& truth : {Pose2{1.75, 1.09, 0.3}, Pose2{-1.75, -1.09, 0.3}, Pose2{std::sqrt(4.25), 0.0, 2.0},
                             Pose2{-std::sqrt(4.25 - 0.81), 0.9, -2.0}, Pose2{std::sqrt(4.25 - 3.61), -1.9, 1.0}}) {
    EXPECT_EQ(method2(landmarks_from(truth), paper_field()).status, FixStatus::coinciding_circles);
  }
}

// By hand: seen from (X, Y), w cot θ_P = (X² + u² − w²)/(2u) with u = Fd − Y, and the same for θ_Q with v = Fd + Y. So
// the circles' centres are Y_Qc − Y_Pc = Fd (X² + Y² − Fd² − w²)/(Fd² − Y²) apart; on Y = 0 that is (X² − 4.25)/2. It
// is 9 mm where X² = 4.268, and 11 mm where X² = 4.272.
TEST(Method2, CirclesOneCentimetreApart) {
  EXPECT_EQ(method2(landmarks_from({std::sqrt(4.268), 0.0, 0.0}), paper_field()).status, FixStatus::coinciding_circles);
  EXPECT_EQ(method2(landmarks_from({std::sqrt(4.232), 0.0, 0.0}), paper_field()).status, FixStatus::coinciding_circles);
  expect_pose(method2(landmarks_from({std::sqrt(4.272), 0.0, 0.0}), paper_field()), {std::sqrt(4.272), 0.0, 0.0}, 1e-9);
  expect_pose(method2(landmarks_from({std::sqrt(4.228), 0.0, 0.0}), paper_field()), {std::sqrt(4.228), 0.0, 0.0}, 1e-9);
}

// By hand, at (1.7, 1.0) with every coordinate of every edge of standard deviation s: the centres are −0.24 m apart.
// w cot θ_P = 1.82, r_P²/w = 7.1248, Σ 1/|P_i|² = 1/5.84 + 1/2.44 = 0.58107, so Y_Pc has 7.1248·√0.58107 s = 5.4310 s.
// w cot θ_Q = 1.94, r_Q²/w = 8.0272, Σ 1/|Q_i|² = 1/13.84 + 1/10.44 = 0.16804, so Y_Qc has 3.2906 s. Together 6.3501 s,
// and three of these are 0.24 m at s = 12.60 mm.
TEST(Method2, CirclesWithinTheirNoiseOfEachOther) {
  GoalLandmarks landmarks = landmarks_from({1.7, 1.0, 0.3});
  for (GoalPoints* goal : goals(landmarks)) goal->covariance.setIdentity() *= 0.0125 * 0.0125;
  EXPECT_EQ(method2(landmarks, paper_field()).status, FixStatus::ok);
  for (GoalPoints* goal : goals(landmarks)) goal->covariance.setIdentity() *= 0.0127 * 0.0127;
  EXPECT_EQ(method2(landmarks, paper_field()).status, FixStatus::coinciding_circles);
}

// By hand: both goals appear as wide as from 2 m ahead of a goal twice as wide: edges (∓1, ±2), tan(θ/2) = 1/2,
// cot θ = 0.75, sin θ = 0.8, r = 0.625, Y_Pc = 1.625 = −Y_Qc. (18) gives 0, and the radicand is 0.390625 − 2.640625 <
// 0.
TEST(Method2, NegativeRadicand) {
  const GoalLandmarks landmarks{edges({-1.0, 2.0}, {1.0, 2.0}), edges({1.0, -2.0}, {-1.0, -2.0})};
  const Fix fix = method2(landmarks, paper_field());
  EXPECT_EQ(fix.status, FixStatus::negative_radicand);
  EXPECT_TRUE(is_finite(fix));
}

// On X = 0 noise decides whether the circles just meet or just do not: both happen, neither is a NaN.
TEST(Method2, OnTheAxisHalfOfTheRadicandsAreNegative) {
  RandomStream stream = make_stream(5, 0);
  std::normal_distribution<double> normal(0.0, 0.005);
  int negative = 0;
  for (int draw = 0; draw < 1000; ++draw) {
    GoalLandmarks landmarks = with_covariance(landmarks_from({0.0, 0.4, 1.0}), 0.005);
    for (GoalPoints* goal : goals(landmarks)) {
      goal->left += Eigen::Vector2d(normal(stream), normal(stream));
      goal->right += Eigen::Vector2d(normal(stream), normal(stream));
    }
    const Fix fix = method2(landmarks, paper_field());
    ASSERT_TRUE(is_finite(fix));
    if (fix.status == FixStatus::negative_radicand) {
      ++negative;
    } else {
      EXPECT_EQ(fix.status, FixStatus::ok);
      EXPECT_NEAR(fix.world_from_robot.y, 0.4, 0.1);
    }
  }
  EXPECT_GT(negative, 400);
  EXPECT_LT(negative, 600);
}

// Bearings of no pose in the field: the circles meet behind the yellow goal line, where P1P2 appears under π − θ_P. By
// hand: cot θ_P = 1.24, cot θ_Q = 4.1, so Y_Pc = 2 − 0.62 = 1.38, Y_Qc = −2 + 2.05 = 0.05, r_P² = 0.25 + 0.62² =
// 0.6344. As (18) is −Fd (Y_Pc + Y_Qc) / (Y_Qc − Y_Pc), Y_R = 2.86/1.33 = 2.150376; X_R = √(0.6344 − 0.770376²) =
// 0.202290. The yellow edges imply opposite headings, which cancel; the blue ones imply atan2(−4.150376, −0.702290) − π
// = 1.403173.
TEST(Method2, SolutionBehindAGoalLine) {
  const GoalLandmarks landmarks{edges({1.24, 1.0}, {1.0, 0.0}), edges({-4.1, -1.0}, {-1.0, 0.0})};
  expect_pose(method2(landmarks, paper_field()), {0.202290, 2.150376, 1.403173}, 1e-6);
  expect_first_order_covariance(method2, landmarks);
}

TEST(Method2, NonFiniteInput) {
  expect_bad_numbers_reported(method2, 2, 5);
}

// A fix is believed up to 1.75 + 1 = 2.75 m in X.
TEST(Method2, OutsideField) {
  EXPECT_EQ(method2(landmarks_from({2.70, 0.5, 1.0}), paper_field()).status, FixStatus::ok);
  EXPECT_EQ(method2(landmarks_from({2.80, 0.5, 1.0}), paper_field()).status, FixStatus::outside_field);
}

TEST(Method2, GoalsSwapped) {
  expect_swapped_goals_turn_the_field(method2);
}

// The edges that are seen are the walls' outer sides: w = Fw + goal_thickness, so only the sum matters.
TEST(Method2, WallsBelongToTheSilhouette) {
  Field thin = paper_field();
  thin.Fw = 0.5;
  thin.goal_thickness = 0.0;
  expect_pose(method2(landmarks_from({0.5, 0.3, 0.4}), thin), {0.5, 0.3, 0.4}, 1e-9);
}

TEST(Method2, CovarianceIsFirstOrder) {
  for_each_pose([](const Pose2& truth) { expect_first_order_covariance(method2, landmarks_from(truth)); });
}

TEST(Method2, CovarianceIsConsistent) {
  expect_consistent_covariance(method2);
}

}  // namespace
}  // namespace movis::localization
