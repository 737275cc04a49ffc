#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "line_field.h"
#include "movis/localization/line_match.h"
#include "support/allocations.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;
using test::large_field;
using test::seen_point;
using test::white_points;

const FieldMap& large_map() {
  static const FieldMap map(large_field());
  return map;
}

LineFit find(const std::vector<LinePoint>& points, const FieldMap& map = large_map()) {
  LineMatchScratch scratch;
  return find_by_lines(points, map, {}, scratch);
}

LineFit match(const std::vector<LinePoint>& points, const Pose2& guess, const FieldMap& map = large_map()) {
  LineMatchScratch scratch;
  return match_lines(points, map, guess, {}, scratch);
}

void expect_pose(const LineFit& fit, const Pose2& expected, double metres, double angle) {
  ASSERT_EQ(fit.fix.status, FixStatus::ok) << word(fit.fix.status);
  EXPECT_NEAR(fit.fix.world_from_robot.x, expected.x, metres);
  EXPECT_NEAR(fit.fix.world_from_robot.y, expected.y, metres);
  EXPECT_NEAR(turn(expected.beta, fit.fix.world_from_robot.beta), 0.0, angle);
}

// Points exactly on the middles of the side line x = 5.9375, the middle line and the circle: the pose that made them
// leaves no distance at all.
TEST(LineMatch, PointsOnTheMiddlesGiveThePoseBack) {
  const Pose2 truth{1.2, -0.7, 0.6};
  std::vector<LinePoint> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back(seen_point(truth, {5.9375, -4.0 + 0.2 * i}, 0.01));
    points.push_back(seen_point(truth, {-5.0 + 0.25 * i, 0.0}, 0.01));
    points.push_back(seen_point(truth, 2.0 * Vector2d(std::cos(0.157 * i), std::sin(0.157 * i)), 0.01));
  }
  const LineFit fit = match(points, {1.4, -0.9, 0.7});
  expect_pose(fit, truth, 1e-5, 1e-5);
  EXPECT_LT(fit.median, 1e-6);
  EXPECT_EQ(fit.points, 120);
  EXPECT_EQ(fit.within_15cm, 1.0);
  EXPECT_EQ(fit.within_5cm, 1.0);
  EXPECT_TRUE(fit.fix.symmetric);
}

// Found from nowhere, in the half with y ≤ 0: the half turn maps (x, y, β) to (−x, −y, β + π).
TEST(LineMatch, FoundWithoutAGuess) {
  RandomStream random = make_stream(11, 0);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int i = 0; i < 12; ++i) {
    const Pose2 truth{5.5 * unit(random), 8.5 * unit(random), kPi * unit(random)};
    const LineFit fit = find(white_points(large_field(), truth, 400, 6.0, 0.02, 0.1, random));
    const bool turned = truth.y > 0.0;
    expect_pose(fit, turned ? Pose2{-truth.x, -truth.y, truth.beta + kPi} : truth, 0.05, 0.02);
    // A quarter of a line's width is the median of points that fill it.
    EXPECT_NEAR(fit.median, 0.25 * 0.125, 0.015);
    EXPECT_GT(fit.on_lines, 0.8);
  }
}

TEST(LineMatch, GuessPicksTheHalf) {
  RandomStream random = make_stream(12, 0);
  const Pose2 truth{2.0, 4.0, 0.3};
  const std::vector<LinePoint> points = white_points(large_field(), truth, 300, 6.0, 0.02, 0.1, random);
  expect_pose(match(points, {2.3, 3.8, 0.4}), truth, 0.05, 0.02);
  expect_pose(match(points, {-2.2, -4.1, 0.3 + kPi}), {-2.0, -4.0, 0.3 + kPi}, 0.05, 0.02);
}

// A fifth of the points anywhere moves the pose by no more than noise does.
TEST(LineMatch, StrayPointsAreLeftAside) {
  RandomStream random = make_stream(13, 0);
  const Pose2 truth{-1.0, -5.0, 2.0};
  expect_pose(match(white_points(large_field(), truth, 400, 6.0, 0.02, 0.2, random), {-0.9, -5.2, 1.95}), truth, 0.03,
              0.01);
}

TEST(LineMatch, PointsOfAnotherFieldAreABadFit) {
  RandomStream random = make_stream(14, 0);
  Field other = large_field();
  other.half_width = 4.0;
  other.half_length = 6.0;
  other.circle = 1.0;
  other.penalty_area = {1.5, 5.0};
  other.goal_area = {0.5, 2.5};
  other.corner_arc = 0.5;
  for (const Pose2& truth : {Pose2{1.0, -2.0, 0.5}, Pose2{-2.0, 3.0, -1.0}, Pose2{0.0, -4.0, 2.0}}) {
    const LineFit fit = find(white_points(other, truth, 400, 8.0, 0.02, 0.0, random));
    EXPECT_EQ(fit.fix.status, FixStatus::bad_fit) << fit.on_lines;
    EXPECT_GT(fit.median, 0.0);
  }
}

TEST(LineMatch, PointsAnywhereAreABadFit) {
  RandomStream random = make_stream(15, 0);
  const auto points = white_points(large_field(), {0.0, -3.0, 0.0}, 400, 6.0, 0.0, 1.0, random);
  EXPECT_EQ(find(points).fix.status, FixStatus::bad_fit);
  EXPECT_EQ(match(points, {0.0, -3.0, 0.0}).fix.status, FixStatus::bad_fit);
}

// Pairs of points d to both sides of three lines leave the pose where it is and all |d_i| = d, so that with σ = 0.02 m
// and w = 0.125 m the spread is 1.4826 d/√(0.02² + 0.125²/12) = 35.94 d/m: 1.437 at 4 cm, 1.797 at 5 cm, beyond 1.5. All
// of them lie within half a line and 2 σ.
TEST(LineMatch, SpreadBeyondSigmaAndLineIsABadFit) {
  const Pose2 truth{1.5, -6.0, 0.8};
  for (const double d : {0.04, 0.05}) {
    std::vector<LinePoint> points;
    for (const double side : {-d, d}) {
      for (int i = 0; i < 40; ++i) {
        points.push_back(seen_point(truth, {5.9375 + side, -7.0 + 0.1 * i}, 0.02));
        points.push_back(seen_point(truth, {-2.5 + 0.125 * i, -6.8125 + side}, 0.02));
        points.push_back(seen_point(truth, {3.5 + 0.025 * i, -8.9375 + side}, 0.02));
      }
    }
    const LineFit fit = match(points, {1.6, -6.1, 0.75});
    EXPECT_NEAR(fit.spread, 35.94 * d, 0.01);
    EXPECT_EQ(fit.on_lines, 1.0);
    EXPECT_EQ(fit.fix.status, d < 0.045 ? FixStatus::ok : FixStatus::bad_fit);
  }
}

TEST(LineMatch, MoreLeftOutThanUsedIsABadFit) {
  RandomStream random = make_stream(23, 0);
  const Pose2 truth{1.0, -5.0, 0.0};
  std::vector<LinePoint> points = white_points(large_field(), truth, 300, 6.0, 0.02, 0.0, random);
  LinePoint vague = points.front();
  vague.sigma_on_floor = 1.0;
  points.resize(600, vague);
  EXPECT_EQ(match(points, truth).fix.status, FixStatus::ok);
  points.push_back(vague);
  EXPECT_EQ(match(points, truth).fix.status, FixStatus::bad_fit);
  EXPECT_EQ(find(points).fix.status, FixStatus::bad_fit);
}

// 300 points that count for 100 tell the variances of 100: three times those of 300.
TEST(LineMatch, NeighboursCountForNoMoreThanTheIndependent) {
  RandomStream random = make_stream(24, 0);
  const Pose2 truth{1.0, -5.0, 0.0};
  const std::vector<LinePoint> points = white_points(large_field(), truth, 300, 6.0, 0.02, 0.0, random);
  LineMatchScratch scratch;
  const auto covariance = [&](double independent) {
    LineMatchOptions options;
    options.independent = independent;
    return match_lines(points, large_map(), truth, options, scratch).fix.covariance;
  };
  EXPECT_TRUE(covariance(100.0).isApprox(3.0 * covariance(300.0), 1e-9));
  EXPECT_EQ(covariance(1000.0), covariance(300.0));
}

// One straight line, or one circle, leaves a direction free: no pose, found or matched from the true one.
TEST(LineMatch, OneLineIsNoLandmark) {
  RandomStream random = make_stream(16, 0);
  std::normal_distribution<double> noise(0.0, 0.02);
  const Pose2 truth{3.0, -2.0, 0.4};
  std::vector<LinePoint> line, circle;
  for (int i = 0; i < 200; ++i) {
    line.push_back(seen_point(truth, {5.9375 + noise(random), -5.0 + 0.03 * i}, 0.02));
    const double angle = 2.0 * kPi * i / 200.0;
    circle.push_back(seen_point(truth, (2.0 + noise(random)) * Vector2d(std::cos(angle), std::sin(angle)), 0.02));
  }
  for (const auto& points : {line, circle}) {
    EXPECT_EQ(match(points, truth).fix.status, FixStatus::no_landmark);
    const FixStatus found = find(points).fix.status;
    EXPECT_TRUE(found == FixStatus::no_landmark || found == FixStatus::ambiguous) << word(found);
  }
}

// A corner alone looks the same in all four; two of them differ by more than the half turn.
TEST(LineMatch, OneCornerIsAmbiguous) {
  const Pose2 truth{4.0, -7.0, 0.4};
  std::vector<LinePoint> points;
  for (int i = 0; i < 60; ++i) {
    points.push_back(seen_point(truth, {5.9375, -8.9375 + 0.03 * i}, 0.02));
    points.push_back(seen_point(truth, {5.9375 - 0.03 * i, -8.9375}, 0.02));
  }
  const LineFit fit = find(points);
  EXPECT_EQ(fit.fix.status, FixStatus::ambiguous) << word(fit.fix.status);
  EXPECT_GT(fit.runner_up, fit.support - 0.1);
}

// With M = diag(−1, 1), which maps the field's lines onto themselves, M (t + R(β) p) = M t + R(−β) M p: the points M p of
// a mirrored picture are seen from (−x, y, −β), and from nowhere near (x, y, β).
TEST(LineMatch, MirroredPointsAreOfAnotherPose) {
  RandomStream random = make_stream(17, 0);
  const Pose2 truth{-3.0, -4.0, 1.0};
  std::vector<LinePoint> points = white_points(large_field(), truth, 400, 6.0, 0.02, 0.0, random);
  for (LinePoint& point : points) point.point.x() = -point.point.x();
  expect_pose(find(points), {3.0, -4.0, -1.0}, 0.05, 0.02);
}

TEST(LineMatch, TooFewPointsAreNoLandmark) {
  RandomStream random = make_stream(18, 0);
  const Pose2 truth{1.0, -2.0, 0.0};
  EXPECT_EQ(find({}).fix.status, FixStatus::no_landmark);
  EXPECT_EQ(match({}, truth).fix.status, FixStatus::no_landmark);
  EXPECT_EQ(find(white_points(large_field(), truth, 11, 6.0, 0.0, 0.0, random)).fix.status, FixStatus::no_landmark);
}

TEST(LineMatch, WhatIsNoNumberIsLeftOut) {
  RandomStream random = make_stream(19, 0);
  const Pose2 truth{1.0, -5.0, 0.0};
  std::vector<LinePoint> points = white_points(large_field(), truth, 300, 6.0, 0.02, 0.0, random);
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    points.push_back(points.front());
    points.back().point.x() = bad;
    points.push_back(points.front());
    points.back().sigma_on_floor = bad;
  }
  points.push_back(points.front());
  points.back().sigma_on_floor = 0.0;
  const LineFit fit = find(points);
  EXPECT_EQ(fit.points, 300);
  expect_pose(fit, truth, 0.05, 0.02);
  const LineFit lost = match(points, {std::nan(""), 0.0, 0.0});
  EXPECT_NE(lost.fix.status, FixStatus::ok);
}

TEST(LineMatch, FieldWithoutLines) {
  Field field = large_field();
  field.line = 0.0;
  RandomStream random = make_stream(20, 0);
  const auto points = white_points(large_field(), {1.0, -2.0, 0.0}, 100, 6.0, 0.0, 0.0, random);
  EXPECT_EQ(find(points, FieldMap(field)).fix.status, FixStatus::no_field);
  EXPECT_EQ(match(points, {}, FieldMap(field)).fix.status, FixStatus::no_field);
}

// eᵀ C⁻¹ e is χ² of 3 degrees of freedom, of mean 3 and variance 6, if C is the covariance of the error e: over 400
// draws its mean has a standard deviation of 0.12. f, which is at least 1 and else follows the spread of 300 points, is
// 1.03 on average, so C is 6 % too large: 2.8.
TEST(LineMatch, CovarianceIsConsistent) {
  RandomStream random = make_stream(21, 0);
  std::normal_distribution<double> normal(0.0, 0.02);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  const Pose2 truth{1.5, -6.0, 0.8};
  constexpr int kDraws = 400;
  double sum = 0.0;
  LineMatchScratch scratch;
  LineMatchOptions options;
  options.independent = 300;  // as they are drawn
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<LinePoint> points;
    for (int i = 0; i < 100; ++i) {  // side line, penalty area's front, goal line away from other lines
      points.push_back(seen_point(truth, {5.9375 + normal(random), -7.0 + 4.0 * along(random)}, 0.02));
      points.push_back(seen_point(truth, {-2.5 + 5.0 * along(random), -6.8125 + normal(random)}, 0.02));
      points.push_back(seen_point(truth, {3.5 + along(random), -8.9375 + normal(random)}, 0.02));
    }
    const LineFit fit = match_lines(points, large_map(), {1.6, -6.1, 0.75}, options, scratch);
    ASSERT_EQ(fit.fix.status, FixStatus::ok);
    const Pose2& pose = fit.fix.world_from_robot;
    const Eigen::Vector3d e(pose.x - truth.x, pose.y - truth.y, turn(truth.beta, pose.beta));
    sum += e.dot(fit.fix.covariance.ldlt().solve(e));
  }
  EXPECT_GT(sum / kDraws, 2.8 - 4 * 0.12);
  EXPECT_LT(sum / kDraws, 2.8 + 4 * 0.12);
}

#if defined(MOVIS_COUNTS_ALLOCATIONS)
TEST(LineMatch, AllocatesNothingAfterTheFirst) {
  RandomStream random = make_stream(22, 0);
  const Pose2 truth{1.0, -5.0, 0.3};
  const std::vector<LinePoint> points = white_points(large_field(), truth, 400, 6.0, 0.02, 0.1, random);
  LineMatchScratch scratch;
  find_by_lines(points, large_map(), {}, scratch);
  EXPECT_EQ(test::allocations_in([&] { find_by_lines(points, large_map(), {}, scratch); }), 0);
  EXPECT_EQ(test::allocations_in([&] { match_lines(points, large_map(), truth, {}, scratch); }), 0);
}
#endif

}  // namespace
}  // namespace movis::localization
