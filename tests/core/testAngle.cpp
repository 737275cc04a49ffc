#include <gtest/gtest.h>

#include "movis/core/angle.h"

namespace movis {
namespace {

TEST(Angle, WrapsIntoHalfOpenInterval) {
  EXPECT_DOUBLE_EQ(wrap_angle(0.0), 0.0);
  EXPECT_DOUBLE_EQ(wrap_angle(kPi), kPi);
  EXPECT_DOUBLE_EQ(wrap_angle(-kPi), kPi);  // (−π, π]
  EXPECT_NEAR(wrap_angle(7.0 * kPi / 2.0), -kPi / 2.0, 1e-12);
  EXPECT_NEAR(wrap_angle(radians(-725.0)), radians(-5.0), 1e-12);
}

TEST(Angle, TurnCrossesTheCut) {
  EXPECT_NEAR(turn(radians(179.0), radians(-179.0)), radians(2.0), 1e-12);
  EXPECT_NEAR(turn(radians(-179.0), radians(179.0)), radians(-2.0), 1e-12);
}

TEST(Angle, DegreesAndRadians) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(degrees(kPi / 2.0), 90.0);
}

}  // namespace
}  // namespace movis
