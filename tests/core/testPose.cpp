#include <gtest/gtest.h>

#include "movis/core/pose.h"

namespace movis {
namespace {

// A robot at (1, 2) whose x axis points along the field's Y: its forward axis points along −X, so a ball one metre
// ahead lies at (0, 2) and a ball one metre to its right at (1, 3).
TEST(Pose, MapsRobotToField) {
  const Pose2 world_from_robot{1.0, 2.0, kPi / 2.0};
  EXPECT_TRUE((world_from_robot * Eigen::Vector2d(0.0, 1.0)).isApprox(Eigen::Vector2d(0.0, 2.0)));
  EXPECT_TRUE((world_from_robot * Eigen::Vector2d(1.0, 0.0)).isApprox(Eigen::Vector2d(1.0, 3.0)));
}

TEST(Pose, InverseUndoes) {
  const Pose2 a_from_b{0.3, -1.2, 2.9};
  const Pose2 identity = a_from_b * inverse(a_from_b);
  EXPECT_NEAR(identity.x, 0.0, 1e-12);
  EXPECT_NEAR(identity.y, 0.0, 1e-12);
  EXPECT_NEAR(identity.beta, 0.0, 1e-12);
}

TEST(Pose, CompositionActsLikeTheOneAfterTheOther) {
  const Pose2 a_from_b{0.3, -1.2, 2.9};
  const Pose2 b_from_c{-2.0, 0.7, 1.1};
  const Eigen::Vector2d point_in_c(0.4, 0.9);
  EXPECT_TRUE(((a_from_b * b_from_c) * point_in_c).isApprox(a_from_b * (b_from_c * point_in_c), 1e-12));
  EXPECT_LE(std::abs((a_from_b * b_from_c).beta), kPi);
}

}  // namespace
}  // namespace movis
