#include <gtest/gtest.h>

#include <cmath>

#include "movis/core/angle.h"
#include "movis/omni/deviation.h"

namespace movis::omni {
namespace {

Camera camera() {
  Camera camera;
  camera.position = {-0.2, 0.1, 0.25};
  camera.yaw = 0.5;
  camera.tilt_x = 0.01;
  camera.model = Hyperboloid{0.028, 0.023, 0.0275, 660.0, 650.0, 319.5, 239.5};
  return camera;
}

TEST(Deviation, EveryNumberWhereItBelongs) {
  Deviation deviation;
  deviation << 0.001, 0.002, 0.003, 0.04, 0.05, 0.06, 0.01, 8.0, 9.0;
  const Camera built = deviated(camera(), deviation);
  EXPECT_NEAR((built.position - Eigen::Vector3d(-0.199, 0.102, 0.253)).norm(), 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(built.yaw, 0.54);
  EXPECT_DOUBLE_EQ(built.tilt_x, 0.06);
  EXPECT_DOUBLE_EQ(built.tilt_y, 0.06);
  const auto& mirror = std::get<Hyperboloid>(built.model);
  EXPECT_DOUBLE_EQ(mirror.fu, 666.6);
  EXPECT_DOUBLE_EQ(mirror.fv, 656.5);
  EXPECT_DOUBLE_EQ(mirror.u0, 327.5);
  EXPECT_DOUBLE_EQ(mirror.v0, 248.5);
  EXPECT_DOUBLE_EQ(mirror.a, 0.028);  // the mirror is as drawn
}

TEST(Deviation, OfAUnifiedSphereToo) {
  Camera sphere = camera();
  sphere.model = UnifiedSphere{0.9, 300.0, 310.0, 320.0, 240.0};
  Deviation deviation = Deviation::Zero();
  deviation[6] = -0.1;
  deviation[8] = 2.0;
  const auto built = std::get<UnifiedSphere>(deviated(sphere, deviation).model);
  EXPECT_DOUBLE_EQ(built.fu, 270.0);
  EXPECT_DOUBLE_EQ(built.fv, 279.0);
  EXPECT_DOUBLE_EQ(built.u0, 320.0);
  EXPECT_DOUBLE_EQ(built.v0, 242.0);
  EXPECT_DOUBLE_EQ(built.xi, 0.9);
}

TEST(Deviation, NothingDeviatesByNothing) {
  RandomStream random = make_stream(1, 1);
  const Rig rig = draw_rig({{camera()}}, Deviation::Zero(), random);
  EXPECT_EQ(rig.cameras[0].position, camera().position);
  EXPECT_EQ(rig.cameras[0].yaw, camera().yaw);
}

TEST(Deviation, SameStreamSameRig) {
  const Rig nominal{{camera(), camera()}};
  RandomStream one = make_stream(7, 1);
  RandomStream same = make_stream(7, 1);
  const Rig first = draw_rig(nominal, individual_differences(), one);
  const Rig second = draw_rig(nominal, individual_differences(), same);
  for (int k = 0; k < 2; ++k) EXPECT_EQ(first.cameras[k].position, second.cameras[k].position);
  EXPECT_NE(first.cameras[0].position, first.cameras[1].position);  // cameras differ from each other
}

// Of 4000 cameras the mean of each deviation is known to 1.6 % of its sigma and the sigma to 1.1 %: five of those.
TEST(Deviation, DrawsHaveTheirSigmas) {
  constexpr int kDraws = 4000;
  const Rig nominal{{camera()}};
  const Deviation sigma = individual_differences();
  RandomStream random = make_stream(3, 1);
  Deviation sum = Deviation::Zero();
  Deviation squares = Deviation::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Camera built = draw_rig(nominal, sigma, random).cameras[0];
    const auto& mirror = std::get<Hyperboloid>(built.model);
    Deviation deviation;
    deviation << built.position - camera().position, built.yaw - 0.5, built.tilt_x - 0.01, built.tilt_y,
        mirror.fu / 660.0 - 1.0, mirror.u0 - 319.5, mirror.v0 - 239.5;
    const Deviation in_sigmas = deviation.cwiseQuotient(sigma);
    sum += in_sigmas;
    squares += in_sigmas.cwiseAbs2();
  }
  EXPECT_LT((sum / kDraws).cwiseAbs().maxCoeff(), 0.08);
  EXPECT_LT(((squares / kDraws).cwiseSqrt() - Deviation::Ones()).cwiseAbs().maxCoeff(), 0.056);
}

// Those of the measurement experiment: 2 mm, 0.6°, 0.25°, 0.4 %, 1.5 px.
TEST(Deviation, IndividualDifferences) {
  const Deviation sigma = individual_differences();
  EXPECT_DOUBLE_EQ(sigma[2], 0.002);
  EXPECT_DOUBLE_EQ(degrees(sigma[3]), 0.6);
  EXPECT_DOUBLE_EQ(degrees(sigma[5]), 0.25);
  EXPECT_DOUBLE_EQ(sigma[6], 0.004);
  EXPECT_DOUBLE_EQ(sigma[7], 1.5);
}

}  // namespace
}  // namespace movis::omni
