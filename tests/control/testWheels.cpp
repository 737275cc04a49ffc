#include <gtest/gtest.h>

#include "movis/control/wheels.h"
#include "movis/core/angle.h"
#include "movis/core/random.h"
#include "support/temporary_folder.h"

namespace movis::control {
namespace {

OmniWheels wheels_at(std::initializer_list<double> azimuths_deg) {
  OmniWheels wheels{{}, 0.2, 0.05, 100.0};
  for (const double azimuth_deg : azimuths_deg) wheels.azimuths.push_back(radians(azimuth_deg));
  return wheels;
}

// By hand: wheels at 90°, 210° and 330° drive along (−1, 0), (1/2, −√3/2) and (1/2, √3/2). At 1 m/s along one of these
// a wheel of radius 0.05 m turns at 20 rad/s; at 1 rad/s of the robot each drives 0.2 m/s, which is 4 rad/s.
TEST(Wheels, KnownRatesOfThree) {
  const OmniWheels wheels = wheels_at({90.0, 210.0, 330.0});
  const double h = 10.0 * std::sqrt(3.0);
  EXPECT_LT((wheel_rates(wheels, {1.0, 0.0, 0.0}) - Eigen::Vector3d(-20.0, 10.0, 10.0)).norm(), 1e-12);
  EXPECT_LT((wheel_rates(wheels, {0.0, 1.0, 0.0}) - Eigen::Vector3d(0.0, -h, h)).norm(), 1e-12);
  EXPECT_LT((wheel_rates(wheels, {0.0, 0.0, 1.0}) - Eigen::Vector3d(4.0, 4.0, 4.0)).norm(), 1e-12);
}

TEST(Wheels, RoundTrip) {
  RandomStream random = make_stream(1, 0);
  std::uniform_real_distribution<double> uniform(-3.0, 3.0);
  for (const OmniWheels& wheels :
       {wheels_at({90.0, 210.0, 330.0}), wheels_at({45.0, 135.0, 225.0, 315.0}), wheels_at({30.0, 150.0, 225.0, 315.0}),
        wheels_at({0.0, 72.0, 144.0, 216.0, 288.0})}) {
    for (int draw = 0; draw < 50; ++draw) {
      const double vx = uniform(random), vy = uniform(random), omega = uniform(random);
      const Twist2 twist = twist_of(wheels, wheel_rates(wheels, {vx, vy, omega}));
      EXPECT_NEAR(twist.vx, vx, 1e-12);
      EXPECT_NEAR(twist.vy, vy, 1e-12);
      EXPECT_NEAR(twist.omega, omega, 1e-12);
    }
  }
}

// By hand: four wheels at 45°, 135°, 225°, 315° drive along (−1, 1), (−1, −1), (1, −1), (1, 1), over √2. Rates of
// (1, −1, 1, −1) drive in no direction: their sums along x and y and about z are all 0. They are slip, and nothing
// else.
TEST(Wheels, SlipOfTheFourthWheelDrivesNowhere) {
  const OmniWheels wheels = wheels_at({45.0, 135.0, 225.0, 315.0});
  const Eigen::VectorXd slip = Eigen::Vector4d(5.0, -5.0, 5.0, -5.0);
  const Twist2 twist = twist_of(wheels, wheel_rates(wheels, {0.5, -1.0, 2.0}) + slip);
  EXPECT_NEAR(twist.vx, 0.5, 1e-12);
  EXPECT_NEAR(twist.vy, -1.0, 1e-12);
  EXPECT_NEAR(twist.omega, 2.0, 1e-12);
}

TEST(Wheels, NotAsManyRatesAsWheels) {
  test::expect_error(
      [] {
        twist_of(wheels_at({90.0, 210.0, 330.0}), Eigen::Vector4d::Zero());
      },
      {"4 wheel rates", "3 wheels"});
}

}  // namespace
}  // namespace movis::control
