// Known places are written down with a tape's error: what calibrate_rig makes of it. Without images.
#include <gtest/gtest.h>

#include "movis/calibration/rig_calibration.h"
#include "synthetic_sightings.h"

namespace movis::calibration {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

constexpr int kYaw = 3;

RigOptions taped(double place_sigma) {
  RigOptions options = without_floors();
  options.place_sigma = place_sigma;
  return options;
}

void add_slips(Sightings& sightings, double sigma, RandomStream& random) {
  for (Sighting& sighting : sightings.frames) {
    sighting.ball_in_robot->x() += normal(random, sigma);
    sighting.ball_in_robot->y() += normal(random, sigma);
  }
}

// Known answer. All n places are written down t too far right. A rig that stands s further right sees the same where
// all balls do, so that bearings, here far more exact than anything else, do not tell how t is shared; the priors do:
// (t − s)² n/σ_place² against 3 s²/σ_position² for three cameras. Hence
//   s = t w_place/(w_place + w_position),   w_place = n/σ_place²,  w_position = 3/σ_position²
// with the sigma 1/√(w_place + w_position). Balls come in opposite pairs: no turn of the rig then takes a part of it.
TEST(RigPlaces, CommonShiftIsSharedByWeights) {
  std::vector<Vector3d> balls = spiral(12);
  for (int i = 0; i < 12; ++i) balls.emplace_back(-balls[i].x(), -balls[i].y(), balls[i].z());
  RandomStream random = make_stream(1, 1);
  Sightings sightings = see_balls(drawn_rig(), drawn_rig(), balls, {}, 0.0, random);
  constexpr double kShift = 0.004, kPlace = 0.005;
  for (Sighting& sighting : sightings.frames) {
    sighting.ball_in_robot->x() += kShift;
    for (Bearing& bearing : sighting.bearings) bearing.covariance *= 0.01;  // 0.0002°
  }
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings, taped(kPlace));
  const double of_place = 24.0 / (kPlace * kPlace), of_position = 3.0 / (result.prior[0] * result.prior[0]);
  const double shift = kShift * of_place / (of_place + of_position);  // 2.2 mm
  const double sigma = 1.0 / std::sqrt(of_place + of_position);       // 0.8 mm
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(result.deviation[k][0], shift, 0.02 * shift) << k;
    EXPECT_NEAR(result.deviation[k][1], 0.0, 0.02 * shift) << k;
    EXPECT_NEAR(result.sigma[k][0], sigma, 0.05 * sigma) << k;
  }
  EXPECT_NEAR(result.place_rms, (kShift - shift) / std::sqrt(2.0), 0.02 * kShift);  // of x; y is right
  EXPECT_TRUE(result.rejected.empty());
}

// As in RigCalibration.SigmasAreConsistent, with a tape that is as exact as it is said to be.
TEST(RigPlaces, SigmasAreConsistent) {
  constexpr int kDraws = 16;
  const RigOptions options = taped(0.005);
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random = make_stream(draw, 6);
    const auto deviations = draw_deviations(3, random);
    const double bias = normal(random, radians(options.elevation_bias_deg));
    Sightings sightings =
        see_balls(deviated(drawn_rig(), deviations), drawn_rig(), spiral(20), {0.012, 0.04, 0.0}, bias, random);
    add_slips(sightings, options.place_sigma, random);
    const RigCalibration result = calibrate_rig(drawn_rig(), sightings, options);
    EXPECT_TRUE(result.rejected.empty());
    sum += normalized_square(result, deviations);
  }
  EXPECT_GT(sum / kDraws, 0.7);
  EXPECT_LT(sum / kDraws, 1.3);
}

// Independent errors average out: of four times as many marks yaws come out twice as exact. Over 24 cameras the ratio
// is known to some 20 %.
TEST(RigPlaces, MoreMarksAreBetter) {
  const RigOptions options = taped(0.005);
  const auto yaw_square = [&](int marks) {
    double sum = 0.0;
    for (int draw = 0; draw < 8; ++draw) {
      RandomStream random = make_stream(draw, 7);
      const auto deviations = draw_deviations(3, random);
      Sightings sightings =
          see_balls(deviated(drawn_rig(), deviations), drawn_rig(), spiral(marks), {0.012, 0.04, 0.0}, 0.0, random);
      add_slips(sightings, options.place_sigma, random);
      const RigCalibration result = calibrate_rig(drawn_rig(), sightings, options);
      for (int k = 0; k < 3; ++k) sum += std::pow(result.deviation[k][kYaw] - deviations[k][kYaw], 2);
    }
    return sum;
  };
  EXPECT_LT(std::sqrt(yaw_square(48) / yaw_square(12)), 0.8);
}

// A ball need not lie on the floor: its written height counts.
TEST(RigPlaces, BallsOnStands) {
  RandomStream random = make_stream(5, 1);
  const auto deviations = draw_deviations(3, random);
  std::vector<Vector3d> balls = spiral(24);
  for (std::size_t i = 0; i < balls.size(); i += 2) balls[i].z() = 0.2;
  const RigCalibration result = calibrate_rig(
      drawn_rig(), see_balls(deviated(drawn_rig(), deviations), drawn_rig(), balls, {}, 0.0, random), taped(0.001));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(result.deviation[k][kYaw], deviations[k][kYaw], radians(0.02));
    EXPECT_NEAR(result.deviation[k][2], deviations[k][2], 0.0005);  // its height
  }
  EXPECT_TRUE(result.rejected.empty());
}

// Whether a mark is wrong is a matter of the tape: 15 mm are three sigmas of 5 mm and far beyond those of 1 mm.
TEST(RigPlaces, MovedBallIsJudgedByTheTape) {
  RandomStream random = make_stream(6, 1);
  Sightings sightings = exact_sightings(deviated(drawn_rig(), draw_deviations(3, random)), 30);
  Vector3d& place = *sightings.frames[8].ball_in_robot;
  place.head<2>() *= 1.0 - 0.015 / place.head<2>().norm();
  EXPECT_TRUE(calibrate_rig(drawn_rig(), sightings, taped(0.005)).rejected.empty());
  const RigCalibration strict = calibrate_rig(drawn_rig(), sightings, taped(0.001));
  ASSERT_EQ(strict.rejected.size(), 1U);
  EXPECT_EQ(strict.rejected[0].frame, 8);
  EXPECT_EQ(strict.rejected[0].camera, -1);
}

TEST(RigPlaces, SmallContradictionsAreToldInMillimetres) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  sightings.frames[5].ball_in_robot->x() += 0.008;
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings, taped(0.0005));
  ASSERT_EQ(result.rejected.size(), 1U);
  EXPECT_EQ(result.rejected[0].frame, 5);
  EXPECT_NE(result.rejected[0].reason.find("8.0 mm from its known place"), std::string::npos)
      << result.rejected[0].reason;
}

TEST(RigPlaces, SwappedRowsAreNamedWithARoughTape) {
  RandomStream random = make_stream(8, 1);
  Sightings sightings = exact_sightings(deviated(drawn_rig(), draw_deviations(3, random)), 30);
  add_slips(sightings, 0.005, random);
  std::swap(sightings.frames[4].ball_in_robot, sightings.frames[17].ball_in_robot);
  Vector3d& moved = *sightings.frames[9].ball_in_robot;
  moved.head<2>() *= 1.0 + 0.3 / moved.head<2>().norm();
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings, taped(0.005));
  ASSERT_EQ(result.rejected.size(), 3U);
  EXPECT_EQ(result.rejected[0].frame, 4);
  EXPECT_EQ(result.rejected[1].frame, 9);
  EXPECT_EQ(result.rejected[2].frame, 17);
}

}  // namespace
}  // namespace movis::calibration
