#include <gtest/gtest.h>

#include <cmath>

#include "line_field.h"
#include "movis/core/paths.h"
#include "movis/localization/line_map.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

Vector2d mirrored(const Vector2d& point, double x, double y) {
  return {x * point.x(), y * point.y()};
}

// Middles by hand: outer edge less half of 0.125. Side line 6 − 0.0625 = 5.9375, goal line 8.9375; penalty area side
// 3.25 − 0.0625 = 3.1875 and front 9 − 2.25 + 0.0625 = 6.8125; goal area side 1.6875 and front 8.3125; the arc's radius
// 0.75 about (6, 9), seen from the middle (6, 9) − (0.4, 0.3)·k at 0.5 k. In all four quarters.
TEST(LineMap, DistancesFromEveryKindOfLine) {
  const LineMap map(test::large_field());
  const struct {
    Vector2d point;
    double distance;
    Vector2d normal;  // of either sign
  } cases[] = {
      {{5.8, 3.0}, 0.1375, {1.0, 0.0}},                    // inside the side line
      {{6.3, 3.0}, 0.3625, {1.0, 0.0}},                    // outside of it
      {{4.5, 8.7}, 0.2375, {0.0, 1.0}},                    // before the goal line
      {{6.0 - 0.48, 9.0 - 0.64}, 0.05, {0.6, 0.8}},        // 0.8 from the corner
      {{4.0, 0.25}, 0.25, {0.0, 1.0}},                     // beside the middle line
      {{1.5, 2.0}, 0.5, {0.6, 0.8}},                       // outside the circle
      {{0.6, 0.8}, 0.8, {0.0, 1.0}},                       // inside it the middle line is nearer
      {{0.9, 1.2}, 0.5, {0.6, 0.8}},                       // and here the circle
      {{3.1, 7.5}, 0.0875, {1.0, 0.0}},                    // beside the penalty area's side
      {{2.0, 6.9}, 0.0875, {0.0, 1.0}},                    // its front
      {{1.8, 8.6}, 0.1125, {1.0, 0.0}},                    // beside the goal area's side
      {{0.5, 8.2}, 0.1125, {0.0, 1.0}},                    // its front
      {{3.1875 + 0.3, 6.8125 - 0.4}, 0.5, {0.6, -0.8}},    // outside the penalty area's corner
      {{5.9375 + 0.9, 8.9375 + 1.2}, 1.5, {0.6, 0.8}},     // outside the field's
      {{5.9375 + 30.0, 8.9375 + 40.0}, 50.0, {0.6, 0.8}},  // outside the lattice
  };
  for (const auto& expected : cases) {
    for (const double x : {1.0, -1.0}) {
      for (const double y : {1.0, -1.0}) {
        const Vector2d point = mirrored(expected.point, x, y);
        const LineMap::Offset offset = map.offset(point);
        EXPECT_NEAR(std::abs(offset.distance), expected.distance, 1e-12) << point.transpose();
        EXPECT_NEAR(std::abs(offset.normal.dot(mirrored(expected.normal, x, y))), 1.0, 1e-12) << point.transpose();
        if (point.norm() < 15.0) {
          EXPECT_NEAR(map.distance(point), expected.distance, 0.05) << point.transpose();
        }
      }
    }
  }
}

// Between the middles of white stripes that are 0.125 wide, a point is white exactly where it is 0.0625 or less from one.
// Corners that stick out are painted square, not round: there a white point is up to √2 × 0.0625 away.
TEST(LineMap, NearMeansWhite) {
  const Field field = test::large_field();
  const LineMap map(field);
  for (double x = -6.2; x < 6.2; x += 0.0317) {
    for (double y = -9.2; y < 9.2; y += 0.0411) {
      const double distance = std::abs(map.offset({x, y}).distance);
      const bool white = test::is_white(field, x, y);
      if (distance < 0.0624) {
        ASSERT_TRUE(white) << x << ' ' << y;
      }
      if (distance > 0.0885) {
        ASSERT_FALSE(white) << x << ' ' << y;
      }
    }
  }
}

// The normal is the distance's derivative, and the sign changes across a line but nowhere beside it.
TEST(LineMap, NormalIsTheDerivative) {
  const LineMap map(test::large_field());
  RandomStream random = make_stream(4, 0);
  std::uniform_real_distribution<double> x(-7.0, 7.0), y(-10.0, 10.0);
  constexpr double kStep = 1e-6;
  int kinks = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2d point(x(random), y(random));
    const LineMap::Offset offset = map.offset(point);
    EXPECT_NEAR(offset.normal.norm(), 1.0, 1e-12);
    for (const int axis : {0, 1}) {
      const Vector2d step = kStep * Vector2d::Unit(axis);
      const double change = map.offset(point + step).distance - map.offset(point - step).distance;
      if (std::abs(change / (2.0 * kStep) - offset.normal[axis]) > 1e-4) ++kinks;
    }
  }
  EXPECT_LE(kinks, 2);  // a step across the border between two lines: 2 µm of metres
}

TEST(LineMap, SignChangesAcrossTheMiddleLine) {
  const LineMap map(test::large_field());
  EXPECT_NEAR(map.offset({3.0, 0.01}).distance + map.offset({3.0, -0.01}).distance, 0.0, 1e-12);
  EXPECT_GT(map.offset({3.0, 0.01}).normal.dot(map.offset({3.0, -0.01}).normal), 0.999);
}

TEST(LineMap, FieldWithoutAreasAndArcs) {
  const Field field = read_field(data_file("fields/paper.yaml"));  // 3.5 m × 4 m, lines 0.05, circle 0.5
  const LineMap map(field);
  EXPECT_NEAR(std::abs(map.offset({1.7, 0.9}).distance), 0.025, 1e-12);
  EXPECT_NEAR(std::abs(map.offset({0.0, 1.9}).distance), 0.075, 1e-12);  // no area in between
  EXPECT_NEAR(std::abs(map.offset({0.36, 0.48}).distance), 0.1, 1e-12);
}

TEST(LineMap, FieldWithoutLines) {
  Field field = test::large_field();
  field.line = 0.0;
  const LineMap map(field);
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.offset({1.0, 1.0}).distance, LineMap::kFar);
  EXPECT_EQ(map.offset({1.0, 1.0}).normal, Vector2d::Zero().eval());
}

TEST(LineMap, NoNumberIsFarAway) {
  const LineMap map(test::large_field());
  EXPECT_EQ(map.offset({std::nan(""), 1.0}).distance, LineMap::kFar);
  EXPECT_TRUE(std::isfinite(map.distance({std::nan(""), 1.0})));
  EXPECT_TRUE(std::isfinite(map.distance({HUGE_VAL, -HUGE_VAL})));
}

}  // namespace
}  // namespace movis::localization
