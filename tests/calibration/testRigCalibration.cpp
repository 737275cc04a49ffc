// A rig's individual differences from balls at known places, without images.
#include <gtest/gtest.h>

#include "movis/calibration/rig_calibration.h"
#include "support/temporary_folder.h"
#include "synthetic_sightings.h"

namespace movis::calibration {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

constexpr int kYaw = 3;

void expect_deviations(const RigCalibration& result, const std::vector<omni::Deviation>& expected, double sigmas) {
  for (std::size_t k = 0; k < expected.size(); ++k) {
    for (int i = 0; i < omni::kDeviations; ++i) {
      EXPECT_NEAR(result.deviation[k][i], expected[k][i], sigmas * result.sigma[k][i])
          << "camera " << k << ", " << omni::kDeviationNames[i];
    }
  }
}

// Known answer. A camera that is turned by ψ about its upright axis, while it is believed not to be, finds every
// azimuth ψ too small and every elevation as it is: nothing else in the rig does that all around. The bearings are made
// of that, by no camera model.
TEST(RigCalibration, TurnedCamera) {
  const omni::Rig nominal = drawn_rig();
  const double turned = radians(0.8);
  Sightings sightings{nominal, {}};
  for (const Vector3d& ball : spiral(24)) {
    Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(sightings.frames.size());
    sighting.ball_in_robot = ball;
    for (int k = 0; k < 3; ++k) {
      const Vector3d offset = ball - nominal.cameras[k].position;
      Bearing bearing;
      bearing.camera = k;
      bearing.azimuth = std::atan2(offset.y(), offset.x()) - (k == 1 ? turned : 0.0);
      bearing.elevation = std::atan2(offset.z(), offset.head<2>().norm());
      bearing.covariance = variance(0.0) * Eigen::Matrix2d::Identity();
      sighting.bearings.push_back(bearing);
    }
    sightings.frames.push_back(sighting);
  }
  const RigCalibration result = calibrate_rig(nominal, sightings, without_floors());
  std::vector<omni::Deviation> expected(3, omni::Deviation::Zero());
  expected[1][kYaw] = turned;
  expect_deviations(result, expected, 0.1);
  EXPECT_NEAR(result.rig.cameras[1].yaw, nominal.cameras[1].yaw + turned, 1e-5);
  EXPECT_LT(result.sigma[1][kYaw], radians(0.01));
  EXPECT_TRUE(result.rejected.empty());
  EXPECT_EQ(result.balls, 24);
}

// Round trip: what the true rig sees, believed to be the nominal one.
TEST(RigCalibration, FindsEveryDeviation) {
  RandomStream random = make_stream(2, 1);
  const auto deviations = draw_deviations(3, random);
  const omni::Rig true_rig = deviated(drawn_rig(), deviations);
  const RigCalibration result = calibrate_rig(drawn_rig(), exact_sightings(true_rig), without_floors());
  expect_deviations(result, deviations, 0.5);  // exact data: what is left is the prior's pull
  EXPECT_LT(degrees(result.azimuth_rms), 0.001);
  EXPECT_LT(degrees(result.elevation_rms), 0.001);
}

// Seen through any rig the pixels are the same, and so is the result.
TEST(RigCalibration, BelievedRigDoesNotMatter) {
  RandomStream random = make_stream(3, 1);
  const auto deviations = draw_deviations(3, random);
  const omni::Rig true_rig = deviated(drawn_rig(), deviations);
  const Noise noise{0.01, 0.03, 0.0};
  RandomStream one = make_stream(3, 2);
  RandomStream same = make_stream(3, 2);
  const RigCalibration first =
      calibrate_rig(drawn_rig(), see_balls(true_rig, drawn_rig(), spiral(24), noise, 0.0, one), without_floors());
  const RigCalibration second =
      calibrate_rig(drawn_rig(), see_balls(true_rig, first.rig, spiral(24), noise, 0.0, same), without_floors());
  expect_deviations(second, first.deviation, 0.02);
}

// A bias of all balls' elevations looks much like a longer focal length of all cameras: the two are hardly told apart,
// the sigmas say so, and what the azimuths determine does not suffer.
TEST(RigCalibration, ElevationBiasStaysOutOfYaws) {
  RandomStream random = make_stream(4, 1);
  const auto deviations = draw_deviations(3, random);
  const double bias = radians(0.08);
  const RigCalibration result = calibrate_rig(
      drawn_rig(), see_balls(deviated(drawn_rig(), deviations), drawn_rig(), spiral(40), {}, bias, random),
      without_floors());
  EXPECT_NEAR(result.elevation_bias, bias, 3.0 * result.elevation_bias_sigma);
  EXPECT_GT(result.elevation_bias_sigma, radians(0.03));
  expect_deviations(result, deviations, 3.0);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(result.deviation[k][kYaw], deviations[k][kYaw], radians(0.005));
}

// The stated sigmas are those of the errors: over many rigs drawn from the prior, with noise as stated, the mean of the
// squared normalized errors is 1. Of 25 rigs with 27 correlated parameters it is known to some 8 %; as sigmas never
// shrink where residuals happen to be small, it lies a few per cent below.
TEST(RigCalibration, SigmasAreConsistent) {
  constexpr int kDraws = 25;
  const Noise noise{0.012, 0.04, 0.0};
  const RigOptions options = without_floors();
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random = make_stream(draw, 5);
    const auto deviations = draw_deviations(3, random);
    const double bias = normal(random, radians(options.elevation_bias_deg));
    const Sightings sightings =
        see_balls(deviated(drawn_rig(), deviations), drawn_rig(), spiral(16), noise, bias, random);
    sum += normalized_square(calibrate_rig(drawn_rig(), sightings, options), deviations);
  }
  EXPECT_GT(sum / kDraws, 0.75);
  EXPECT_LT(sum / kDraws, 1.25);
}

// Degenerate cases, by name.

TEST(RigCalibration, TooFewBalls) {
  expect_error([] { calibrate_rig(drawn_rig(), exact_sightings(drawn_rig(), 7)); }, {"7 of 7", "at least 8"});
  expect_error([] { calibrate_rig(drawn_rig(), {drawn_rig(), {}}); }, {"0 of 0", "at least 8"});
}

TEST(RigCalibration, BallAtOnePlace) {
  RandomStream random = make_stream(1, 1);
  const std::vector<Vector3d> balls(20, Vector3d(1.0, 1.0, 0.11));
  const Sightings sightings = see_balls(drawn_rig(), drawn_rig(), balls, {}, 0.0, random);
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"1 places"});
}

TEST(RigCalibration, BallsInOneDirection) {
  RandomStream random = make_stream(1, 1);
  std::vector<Vector3d> balls;
  for (int i = 0; i < 20; ++i) balls.emplace_back(0.2 * (i % 3), 0.8 + 0.16 * i, 0.11);
  const Sightings sightings = see_balls(drawn_rig(), drawn_rig(), balls, {}, 0.0, random);
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"one direction", "all around"});
}

TEST(RigCalibration, PlaceThatIsNoNumber) {
  Sightings sightings = exact_sightings(drawn_rig());
  sightings.frames[5].ball_in_robot->x() = std::nan("");
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"frame 5", "not finite"});
}

TEST(RigCalibration, RigsOfDifferentSize) {
  omni::Rig two = drawn_rig();
  two.cameras.pop_back();
  expect_error([&] { calibrate_rig(two, exact_sightings(drawn_rig())); }, {"3 cameras", "rig of 2"});
}

TEST(RigCalibration, BearingsWithoutPlacesDoNotCount) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  for (int i = 0; i < 25; ++i) sightings.frames[i].ball_in_robot.reset();
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"5 of 30"});
}

// Wrong places are named and do no harm.
TEST(RigCalibration, SwappedRowsAreNamed) {
  RandomStream random = make_stream(6, 1);
  const auto deviations = draw_deviations(3, random);
  Sightings sightings = exact_sightings(deviated(drawn_rig(), deviations), 30);
  std::swap(sightings.frames[4].ball_in_robot, sightings.frames[17].ball_in_robot);
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings);
  ASSERT_EQ(result.rejected.size(), 2U);
  EXPECT_EQ(result.rejected[0].frame, 4);
  EXPECT_EQ(result.rejected[1].frame, 17);
  EXPECT_EQ(result.rejected[0].camera, -1);
  EXPECT_EQ(result.balls, 28);
  expect_deviations(result, deviations, 3.0);
}

TEST(RigCalibration, MovedBallsAreNamedWithTheirPlaces) {
  RandomStream random = make_stream(7, 1);
  const auto deviations = draw_deviations(3, random);
  Sightings sightings = exact_sightings(deviated(drawn_rig(), deviations), 30);
  for (const int i : {2, 9, 20}) {  // 0.3 m farther away: no camera's azimuth changes much
    Vector3d& place = *sightings.frames[i].ball_in_robot;
    place.head<2>() *= 1.0 + 0.3 / place.head<2>().norm();
  }
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings);
  ASSERT_EQ(result.rejected.size(), 3U);
  for (const RejectedSighting& rejected : result.rejected) {
    EXPECT_NE(rejected.reason.find("0.30 m from its known place"), std::string::npos) << rejected.reason;
  }
  expect_deviations(result, deviations, 3.0);
}

TEST(RigCalibration, OneCamerasWrongBearingIsNamed) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  sightings.frames[11].bearings[1].azimuth += radians(1.0);
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings);
  ASSERT_EQ(result.rejected.size(), 1U);
  EXPECT_EQ(result.rejected[0].frame, 11);
  EXPECT_EQ(result.rejected[0].camera, 1);
  EXPECT_NE(result.rejected[0].reason.find("1.00° in azimuth"), std::string::npos) << result.rejected[0].reason;
}

TEST(RigCalibration, HalfOfThePlacesWrong) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  for (int i = 0; i < 14; ++i) std::swap(sightings.frames[i].ball_in_robot, sightings.frames[i + 1].ball_in_robot);
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"contradict each other in 15 of 30 frames"});
}

TEST(RigCalibration, PlacesOfAMirroredField) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  for (Sighting& sighting : sightings.frames) sighting.ball_in_robot->x() *= -1.0;
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"contradict"});
}

TEST(RigCalibration, OneCameraOfOtherInstants) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  for (std::size_t i = 0; i + 1 < sightings.frames.size(); ++i) {
    std::swap(sightings.frames[i].bearings[2], sightings.frames[i + 1].bearings[2]);
  }
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"camera M3 contradicts the others"});
}

TEST(RigCalibration, CamerasInAnotherOrder) {
  RandomStream random = make_stream(8, 1);
  Sightings sightings = exact_sightings(deviated(drawn_rig(), draw_deviations(3, random)), 30);
  for (Sighting& sighting : sightings.frames) {
    for (Bearing& bearing : sighting.bearings) {
      if (bearing.camera == 2) continue;
      // The same pixel in the other camera's column: the yaws of the two differ by 120°.
      const int other = 1 - bearing.camera;
      const auto& cameras = sightings.rig.cameras;
      bearing.azimuth = wrap_angle(bearing.azimuth - cameras[bearing.camera].yaw + cameras[other].yaw);
      bearing.camera = other;
    }
  }
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); },
               {"another order", "listed as M1 look like M2's", "listed as M2 look like M1's"});
}

TEST(RigCalibration, BlindCameraIsNotDetermined) {
  Sightings sightings = exact_sightings(drawn_rig(), 30);
  for (Sighting& sighting : sightings.frames) sighting.bearings.erase(sighting.bearings.begin() + 1);
  const RigCalibration result = calibrate_rig(drawn_rig(), sightings);
  for (int i = 0; i < omni::kDeviations; ++i) {
    EXPECT_FALSE(result.determined(1, i)) << omni::kDeviationNames[i];
    EXPECT_NEAR(result.sigma[1][i], result.prior[i], 1e-6 * result.prior[i]);
    EXPECT_DOUBLE_EQ(result.deviation[1][i], 0.0);
  }
  EXPECT_TRUE(result.determined(0, kYaw));
}

TEST(RigCalibration, DifferencesBeyondBelief) {
  std::vector<omni::Deviation> deviations(3, omni::Deviation::Zero());
  deviations[2][kYaw] = radians(7.0);  // sigma 0.6°
  const Sightings sightings = exact_sightings(deviated(drawn_rig(), deviations), 30);
  expect_error([&] { calibrate_rig(drawn_rig(), sightings); }, {"yaw of camera M3", "12 times"});
  RigOptions loose;
  loose.prior[kYaw] = radians(5.0);
  EXPECT_NEAR(calibrate_rig(drawn_rig(), sightings, loose).deviation[2][kYaw], radians(7.0), radians(0.02));
}

TEST(RigOptionsFile, ReadsStrictly) {
  const TemporaryFolder folder;
  const RigOptions options = read_rig_options(YamlMap::read(folder.write(
      "a.yaml",
      "prior: {position: 0.01, yaw_deg: 3}\nazimuth_floor_deg: 0.02\nball_radius: 0.1\nplace_sigma: 0.004\n")));
  EXPECT_DOUBLE_EQ(options.prior[2], 0.01);
  EXPECT_NEAR(options.prior[kYaw], radians(3.0), 1e-15);
  EXPECT_DOUBLE_EQ(options.prior[6], omni::individual_differences()[6]);
  EXPECT_DOUBLE_EQ(options.azimuth_floor_deg, 0.02);
  EXPECT_DOUBLE_EQ(options.ball_radius, 0.1);
  EXPECT_DOUBLE_EQ(options.place_sigma, 0.004);
  expect_error([&] { read_rig_options(YamlMap::read(folder.write("b.yaml", "prior: {yaw: 3}\n"))); },
               {"b.yaml:1", "'yaw'", "yaw_deg"});
  expect_error([&] { read_rig_options(YamlMap::read(folder.write("c.yaml", "edge_floor_deg: -1\n"))); },
               {"edge_floor_deg", "range"});
}

}  // namespace
}  // namespace movis::calibration
