#pragma once

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "movis/core/field.h"
#include "movis/core/pose.h"
#include "movis/core/random.h"
#include "movis/localization/localizer.h"
#include "movis/triangulation/goal_points.h"

// Both goals as the robot at a given pose measures them, and the checks that hold for every method of the paper.
namespace movis::localization {

using triangulation::GoalLandmarks;
using triangulation::GoalPoints;

using GoalMethod = Fix (*)(const GoalLandmarks&, const Field&);  // method1, method2 or composed

// The paper's 3.5 m × 4 m, with goals whose silhouette is 1 m wide: w = 0.4 + 0.1 = 0.5. All four edges then lie at
// √(2² + 0.5²) = √4.25 from the centre spot.
inline Field paper_field() {
  Field field;
  field.half_width = 1.75;
  field.half_length = 2.0;
  field.Fd = 2.0;
  field.Fw = 0.4;
  field.goal_thickness = 0.1;
  field.goal_depth = 0.4;
  return field;
}

inline GoalPoints seen_goal(const Eigen::Vector2d& centre, const Eigen::Vector2d& left, const Eigen::Vector2d& right) {
  GoalPoints goal;
  goal.centre_status = PointStatus::ok;
  goal.edges_status = PointStatus::ok;
  goal.centre = centre;
  goal.left = left;
  goal.right = right;
  return goal;
}

// Exact landmarks of paper_field(). From inside the field P1 = (−w, Fd) and Q2 = (w, −Fd) are the left edges.
inline GoalLandmarks landmarks_from(const Pose2& world_from_robot) {
  const Pose2 robot_from_world = inverse(world_from_robot);
  const auto in_robot = [&](double x, double y) { return robot_from_world * Eigen::Vector2d(x, y); };
  return {seen_goal(in_robot(0.0, 2.0), in_robot(-0.5, 2.0), in_robot(0.5, 2.0)),
          seen_goal(in_robot(0.0, -2.0), in_robot(0.5, -2.0), in_robot(-0.5, -2.0))};
}

inline std::array<GoalPoints*, 2> goals(GoalLandmarks& landmarks) {
  return {&landmarks.yellow, &landmarks.blue};
}

inline bool is_finite(const Fix& fix) {
  return std::isfinite(fix.world_from_robot.x) && std::isfinite(fix.world_from_robot.y) &&
         std::isfinite(fix.world_from_robot.beta) && fix.covariance.allFinite();
}

// Estimate minus truth as (x, y, beta).
inline Eigen::Vector3d error(const Pose2& estimate, const Pose2& truth) {
  return {estimate.x - truth.x, estimate.y - truth.y, turn(truth.beta, estimate.beta)};
}

inline void expect_pose(const Fix& fix, const Pose2& expected, double tolerance) {
  ASSERT_EQ(fix.status, FixStatus::ok) << word(fix.status);
  EXPECT_NEAR(fix.world_from_robot.x, expected.x, tolerance);
  EXPECT_NEAR(fix.world_from_robot.y, expected.y, tolerance);
  EXPECT_NEAR(turn(expected.beta, fix.world_from_robot.beta), 0.0, tolerance);
  EXPECT_LE(std::abs(fix.world_from_robot.beta), kPi);
}

// A lattice over the whole field, the lines included, and 24 headings. X is never 0 and no spot is nearer than 4 cm to
// the circle of √4.25 through all edges: what happens there has tests of its own.
inline void for_each_pose(const std::function<void(const Pose2&)>& visit) {
  for (const double x : {-1.75, -1.3, -0.85, -0.45, -0.1, 0.1, 0.45, 0.85, 1.3, 1.75}) {
    for (const double y : {-1.9, -1.5, -1.0, -0.4, 0.0, 0.4, 1.0, 1.5, 1.9}) {
      if (std::abs(std::hypot(x, y) - std::sqrt(4.25)) < 0.04) continue;
      for (int step = 0; step < 24; ++step) visit({x, y, wrap_angle(radians(15.0 * step))});
    }
  }
}

// Statuses of goals that cannot give a fix, the same for every method; `spoil` takes what it needs from one goal.
inline void expect_missing_goals_reported(GoalMethod method,
                                          const std::function<void(GoalPoints&, PointStatus)>& spoil) {
  const Field field = paper_field();
  const GoalLandmarks both = landmarks_from({0.5, 0.3, 0.4});
  ASSERT_EQ(method(both, field).status, FixStatus::ok);
  EXPECT_EQ(method({}, field).status, FixStatus::no_goal);
  EXPECT_EQ(method({both.yellow, {}}, field).status, FixStatus::one_goal);
  EXPECT_EQ(method({{}, both.blue}, field).status, FixStatus::one_goal);
  GoalLandmarks glimpsed;  // an edge here, a centre there: seen, though not measured
  glimpsed.yellow.edges_status = glimpsed.blue.centre_status = PointStatus::one_camera;
  EXPECT_EQ(method(glimpsed, field).status, FixStatus::no_distance);
  for (const PointStatus status : {PointStatus::one_camera, PointStatus::parallel_rays, PointStatus::behind_camera}) {
    for (const int which : {0, 1}) {
      GoalLandmarks landmarks = both;
      spoil(*goals(landmarks)[which], status);
      EXPECT_EQ(method(landmarks, field).status, FixStatus::no_distance) << word(status);
    }
  }
}

// The numbers of a goal's points: (centre, left, right).
inline Eigen::Matrix<double, 6, 1> stacked(const GoalPoints& goal) {
  Eigen::Matrix<double, 6, 1> points;
  points << goal.centre, goal.left, goal.right;
  return points;
}

inline void set_stacked(GoalPoints& goal, const Eigen::Matrix<double, 6, 1>& points) {
  goal.centre = points.segment<2>(0);
  goal.left = points.segment<2>(2);
  goal.right = points.segment<2>(4);
}

// No number in the landmarks, however wrong, may come out as one that is not finite; `first` and `last` bound the
// coordinates (0 … 5: centre, left, right) that the method needs: a NaN among those is a status.
inline void expect_bad_numbers_reported(GoalMethod method, int first, int last) {
  const Field field = paper_field();
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e308, 1e160, 1e-320, 0.0}) {
    for (const int which : {0, 1}) {
      for (int i = 0; i < 6; ++i) {
        GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
        Eigen::Matrix<double, 6, 1> points = stacked(*goals(landmarks)[which]);
        points[i] = bad;
        set_stacked(*goals(landmarks)[which], points);
        const Fix fix = method(landmarks, field);
        EXPECT_TRUE(is_finite(fix)) << bad << " at " << i;
        if (!std::isfinite(bad) && i >= first && i <= last) {
          EXPECT_EQ(fix.status, FixStatus::no_distance) << bad << " at " << i;
        }
      }
    }
  }
  GoalLandmarks landmarks = landmarks_from({0.5, 0.3, 0.4});
  landmarks.blue.covariance(first, first) = std::nan("");
  EXPECT_EQ(method(landmarks, field).status, FixStatus::no_distance);
  EXPECT_TRUE(is_finite(method(landmarks, field)));
  GoalLandmarks at_origin;
  at_origin.yellow = at_origin.blue = seen_goal({0.0, 0.0}, {0.0, 0.0}, {0.0, 0.0});
  EXPECT_EQ(method(at_origin, field).status, FixStatus::no_distance);
  EXPECT_TRUE(is_finite(method(at_origin, field)));
}

// A factor L of a goal's covariance L Lᵀ in which all points are correlated: no method may drop an off-diagonal block.
inline Eigen::Matrix<double, 6, 6> noise_factor(double sigma) {
  Eigen::Matrix<double, 6, 6> factor;
  factor << 1.0, 0.0, 0.0, 0.0, 0.0, 0.0,  //
      0.3, 1.4, 0.0, 0.0, 0.0, 0.0,        //
      0.6, -0.2, 0.9, 0.0, 0.0, 0.0,       //
      0.1, 0.7, 0.4, 1.1, 0.0, 0.0,        //
      0.5, 0.2, -0.3, 0.1, 0.8, 0.0,       //
      -0.1, 0.6, 0.2, -0.4, 0.3, 1.2;
  return sigma * factor;
}

inline GoalLandmarks with_covariance(GoalLandmarks landmarks, double sigma) {
  const Eigen::Matrix<double, 6, 6> factor = noise_factor(sigma);
  for (GoalPoints* goal : goals(landmarks)) goal->covariance = factor * factor.transpose();
  return landmarks;
}

// The covariance must be J C Jᵀ with the J that central differences of the method itself give. The step of 1 µm leaves
// them exact to about 1e-7 even where the root of (17) bends most.
inline void expect_first_order_covariance(GoalMethod method, const GoalLandmarks& exact) {
  const Field field = paper_field();
  const GoalLandmarks landmarks = with_covariance(exact, 1e-3);
  const Fix fix = method(landmarks, field);
  ASSERT_EQ(fix.status, FixStatus::ok) << word(fix.status);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (const int which : {0, 1}) {
    Eigen::Matrix<double, 3, 6> jacobian;
    for (int i = 0; i < 6; ++i) {
      const double step = 1e-6;
      std::array<Fix, 2> moved;
      for (const int side : {0, 1}) {
        GoalLandmarks shifted = landmarks;
        Eigen::Matrix<double, 6, 1> points = stacked(*goals(shifted)[which]);
        points[i] += side == 1 ? step : -step;
        set_stacked(*goals(shifted)[which], points);
        moved[side] = method(shifted, field);
        ASSERT_EQ(moved[side].status, FixStatus::ok);
      }
      jacobian.col(i) = error(moved[1].world_from_robot, moved[0].world_from_robot) / (2.0 * step);
    }
    expected += jacobian * landmarks.yellow.covariance * jacobian.transpose();
  }
  EXPECT_LT((fix.covariance - expected).norm(), 1e-6 * expected.norm()) << fix.covariance << "\n\n" << expected;
}

// The mean of eᵀ C⁻¹ e over seeded draws. It is χ² of 3 degrees of freedom, of mean 3 and variance 6, when C is the
// covariance of the error e: over 20 000 draws the mean then has a standard deviation of 0.017, 0.6 %.
inline double mean_nees(GoalMethod method, const Pose2& truth, double sigma, std::uint64_t seed) {
  constexpr int kDraws = 20000;
  const Field field = paper_field();
  const GoalLandmarks exact = with_covariance(landmarks_from(truth), sigma);
  const Eigen::Matrix<double, 6, 6> factor = noise_factor(sigma);
  RandomStream stream = make_stream(seed, 0);
  std::normal_distribution<double> normal;
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    GoalLandmarks measured = exact;
    for (GoalPoints* goal : goals(measured)) {
      Eigen::Matrix<double, 6, 1> z;
      for (double& value : z) value = normal(stream);
      set_stacked(*goal, stacked(*goal) + factor * z);
    }
    const Fix fix = method(measured, field);
    if (fix.status != FixStatus::ok) return std::nan("");
    const Eigen::Vector3d e = error(fix.world_from_robot, truth);
    sum += e.dot(fix.covariance.ldlt().solve(e));
  }
  return sum / kDraws;
}

inline void expect_consistent_covariance(GoalMethod method) {
  std::uint64_t seed = 1;
  for (const Pose2& truth : {Pose2{0.9, 0.3, 0.5}, Pose2{-0.8, -0.9, -2.0}, Pose2{-1.2, 0.7, 3.1}}) {
    const double nees = mean_nees(method, truth, 1e-3, seed++);
    EXPECT_GT(nees, 0.97 * 3.0) << truth.x << ' ' << truth.y;
    EXPECT_LT(nees, 1.03 * 3.0) << truth.x << ' ' << truth.y;
  }
}

// With the colours exchanged the field looks the same from the opposite side: a fix turned by 180°, and no way to tell.
inline void expect_swapped_goals_turn_the_field(GoalMethod method) {
  const GoalLandmarks true_colours = landmarks_from({0.5, 0.3, 0.4});
  expect_pose(method({true_colours.blue, true_colours.yellow}, paper_field()), {-0.5, -0.3, 0.4 - kPi}, 1e-9);
}

}  // namespace movis::localization
