#include <gtest/gtest.h>
#include <visp3/visual_features/vpFeatureThetaU.h>
#include <visp3/visual_features/vpFeatureTranslation.h>

#include "movis/core/angle.h"
#include "movis/core/pose.h"
#include "movis/servo/planar_task.h"

namespace movis::servo {
namespace {

vpHomogeneousMatrix planar(double x, double y, double beta) {
  return {vpTranslationVector(x, y, 0.0), vpRotationMatrix(vpThetaUVector(0.0, 0.0, beta))};
}

// Translation and heading of an object in the robot frame, ViSP's first position-based scheme: cMo, and θu of cd_R_c.
struct ObjectTask {
  explicit ObjectTask(vpServo::vpServoIteractionMatrixType interaction) : task(interaction, vpAdaptiveGain(2.0)) {
    task.add(t, t_desired, vpFeatureTranslation::selectTx() | vpFeatureTranslation::selectTy());
    task.add(tu, tu_desired, vpFeatureThetaU::selectTUz());
  }
  Twist2 velocity(const vpHomogeneousMatrix& cMo, const vpHomogeneousMatrix& cdMo) {
    t.buildFrom(cMo);
    t_desired.buildFrom(cdMo);
    tu.buildFrom(cdMo * cMo.inverse());
    return task.velocity();
  }
  vpFeatureTranslation t{vpFeatureTranslation::cMo}, t_desired{vpFeatureTranslation::cMo};
  vpFeatureThetaU tu{vpFeatureThetaU::cdRc}, tu_desired{vpFeatureThetaU::cdRc};
  PlanarTask task;
};

// By hand. A resting point p moves in the robot frame as ṗx = −vx + ω py, ṗy = −vy − ω px, and θ, the heading from the
// desired robot to the robot, as θ̇ = ω. Asking for ė = −λ e, where the matrix is taken at (px, py):
//   ω = −λ θ,  vx = λ ex + ω py,  vy = λ ey − ω px.
void expect_law(const Twist2& v, double ex, double ey, double theta, double px, double py) {
  const double omega = -2.0 * theta;
  EXPECT_NEAR(v.omega, omega, 1e-9);
  EXPECT_NEAR(v.vx, 2.0 * ex + omega * py, 1e-9);
  EXPECT_NEAR(v.vy, 2.0 * ey - omega * px, 1e-9);
}

TEST(PlanarTask, KnownAnswer) {
  ObjectTask task(vpServo::CURRENT);
  const Twist2 v = task.velocity(planar(0.7, 1.9, radians(-25.0)), planar(0.0, 0.4, 0.0));
  expect_law(v, 0.7, 1.5, radians(25.0), 0.7, 1.9);
  EXPECT_NEAR(task.task.error(0), 0.7, 1e-12);
  EXPECT_NEAR(task.task.error(1), 1.5, 1e-12);
  EXPECT_NEAR(task.task.error(2), radians(25.0), 1e-12);
}

// With the matrix at s*, a changed s* must change the matrix too.
TEST(PlanarTask, FollowsADesiredFeatureThatChanges) {
  ObjectTask task(vpServo::DESIRED);
  const vpHomogeneousMatrix cMo = planar(0.7, 1.9, radians(-25.0));
  expect_law(task.velocity(cMo, planar(0.0, 0.4, 0.0)), 0.7, 1.5, radians(25.0), 0.0, 0.4);
  expect_law(task.velocity(cMo, planar(0.5, 1.0, 0.0)), 0.2, 0.9, radians(25.0), 0.5, 1.0);
}

// Two tasks alive at once share nothing, and a dead one leaves nothing behind: its features die with their owner.
TEST(PlanarTask, ManyTasksComeAndGo) {
  ObjectTask kept(vpServo::CURRENT);
  const vpHomogeneousMatrix cMo = planar(0.3, 0.8, radians(10.0));
  const vpHomogeneousMatrix cdMo = planar(0.0, 0.36, 0.0);
  const Twist2 first = kept.velocity(cMo, cdMo);
  for (int i = 0; i < 1000; ++i) {
    ObjectTask other(i % 2 == 0 ? vpServo::CURRENT : vpServo::DESIRED);
    other.velocity(planar(0.01 * i, -1.0, 0.5), cdMo);
    const Twist2 again = kept.velocity(cMo, cdMo);
    ASSERT_EQ(again.vx, first.vx);
    ASSERT_EQ(again.vy, first.vy);
    ASSERT_EQ(again.omega, first.omega);
  }
}

}  // namespace
}  // namespace movis::servo
