// What fit_correction makes of data that contradict themselves, or that cannot carry a correction.
#include <gtest/gtest.h>

#include <algorithm>

#include "known_balls.h"
#include "support/temporary_folder.h"

namespace movis::calibration {
namespace {

// The frames that fit_correction left out, and the correction as good as without them.
void expect_rejected(const Sightings& sightings, const omni::Rig& built, const std::vector<std::int64_t>& frames) {
  const CorrectionFit fit = fit_correction(sightings);
  std::vector<std::int64_t> rejected;
  for (const RejectedSighting& sighting : fit.rejected) {
    EXPECT_EQ(sighting.camera, -1);
    rejected.push_back(sighting.frame);
  }
  std::sort(rejected.begin(), rejected.end());
  EXPECT_EQ(rejected, frames);
  const Left left = left_of(fit.correction, see_many(built, 60, 200));
  EXPECT_LT(left.azimuth_rms, 1.5 * radians(0.01));
  EXPECT_LT(left.elevation_rms, 1.5 * radians(0.03));
}

TEST(CorrectionBadData, SwappedRows) {
  const omni::Rig built = built_rig(1);
  Sightings sightings = see_many(built, 40, 1);
  std::swap(sightings.frames[4].ball_in_robot, sightings.frames[30].ball_in_robot);
  std::swap(sightings.frames[11].ball_in_robot, sightings.frames[12].ball_in_robot);
  expect_rejected(
      sightings, built,
      {sightings.frames[4].frame, sightings.frames[11].frame, sightings.frames[12].frame, sightings.frames[30].frame});
}

// By 0.3 m towards the robot or away from it, where bearings show it least, in every fourth frame.
TEST(CorrectionBadData, MovedBalls) {
  const omni::Rig built = built_rig(2);
  Sightings sightings = see_many(built, 40, 2);
  std::vector<std::int64_t> moved;
  for (std::size_t i = 0; i < sightings.frames.size(); i += 4) {
    Vector3d& ball = *sightings.frames[i].ball_in_robot;
    ball.head<2>() *= 1.0 + (i % 8 == 0 ? 0.3 : -0.3) / ball.head<2>().norm();
    moved.push_back(sightings.frames[i].frame);
  }
  expect_rejected(sightings, built, moved);
}

TEST(CorrectionBadData, OneBadBearing) {
  Sightings sightings = see_many(built_rig(3), 40, 3);
  sightings.frames[7].bearings[2].azimuth += radians(1.0);
  const CorrectionFit fit = fit_correction(sightings);
  ASSERT_EQ(fit.rejected.size(), 1U);
  EXPECT_EQ(fit.rejected[0].frame, sightings.frames[7].frame);
  EXPECT_EQ(fit.rejected[0].camera, 2);
}

TEST(CorrectionBadData, BearingsThatAreCutDoNotCount) {
  Sightings sightings = see_many(built_rig(3), 40, 3);
  const auto before = fit_correction(sightings).correction;
  Sighting cut = sightings.frames[0];
  for (Bearing& bearing : cut.bearings) {
    bearing.azimuth += radians(1.0);
    bearing.flags = kCutByBody;
  }
  sightings.frames.push_back(cut);
  Sighting other = sightings.frames[1];
  for (Bearing& bearing : other.bearings) bearing.object = ObjectClass::yellow_goal;
  sightings.frames.push_back(other);
  const CorrectionFit after = fit_correction(sightings);
  EXPECT_TRUE(after.rejected.empty());
  // Folds are drawn anew over the frames, so that another order may be as good; both corrections must agree.
  Bearing one = sightings.frames[5].bearings[0];
  std::vector<Bearing> a{one}, b{one};
  triangulation::correct(before, a);
  triangulation::correct(after.correction, b);
  EXPECT_NEAR(a[0].azimuth, b[0].azimuth, radians(0.01));
}

TEST(CorrectionBadData, MoreThanAThirdContradict) {
  Sightings sightings = see_many(built_rig(4), 40, 4);
  for (std::size_t i = 0; i < 15; ++i) sightings.frames[i].ball_in_robot->head<2>() *= -1.0;
  test::expect_error([&] { fit_correction(sightings); }, {"15 of 40 frames", "more than a third", "101 102"});
}

TEST(CorrectionBadData, RowsShiftedByOne) {
  Sightings sightings = see_many(built_rig(4), 40, 4);
  for (std::size_t i = 0; i + 1 < 40; ++i) sightings.frames[i].ball_in_robot = sightings.frames[i + 1].ball_in_robot;
  test::expect_error([&] { fit_correction(sightings); }, {"of 40 frames", "more than a third", "row of the truth"});
}

TEST(CorrectionBadData, OneCameraContradicts) {
  Sightings sightings = see_many(built_rig(5), 40, 5);
  for (std::size_t i = 0; i < 40; ++i)
    sightings.frames[i].bearings[1].azimuth += radians(i % 5 < 2 ? 1.0 + 0.2 * static_cast<int>(i % 7) : 0.0);
  test::expect_error([&] { fit_correction(sightings); }, {"M2 contradicts", "16 of 40", "was it moved?"});
}

TEST(CorrectionBadData, CamerasInAnotherOrder) {
  omni::Rig built = built_rig(6);
  Sightings sightings = see_many(built, 40, 6);
  RandomStream random = make_stream(6, 3);
  std::swap(built.cameras[0], built.cameras[2]);
  for (Sighting& sighting : sightings.frames) {
    sighting = see(built, sightings.rig, *sighting.ball_in_robot, {}, random);
  }
  test::expect_error([&] { fit_correction(sightings); }, {"the images of M1 look like those of M3", "frames.csv"});
}

TEST(CorrectionBadData, TooFewPlaces) {
  test::expect_error([&] { fit_correction(see_many(built_rig(1), 11, 1)); }, {"M1 has 11 balls", "it needs 12"});
}

TEST(CorrectionBadData, TwelvePlacesAreEnough) {
  const omni::Rig built = built_rig(1);
  const CorrectionFit fit = fit_correction(see_many(built, 12, 1));
  EXPECT_LT(left_of(fit.correction, see_many(built, 60, 300)).azimuth_rms, radians(0.06));
}

TEST(CorrectionBadData, NoKnownPlaces) {
  Sightings sightings = see_many(built_rig(1), 40, 1);
  for (Sighting& sighting : sightings.frames) sighting.ball_in_robot.reset();
  test::expect_error([&] { fit_correction(sightings); }, {"M1 has 0 balls at known places"});
}

TEST(CorrectionBadData, AllInOneDirection) {
  const omni::Rig built = built_rig(1), nominal = nominal_rig();
  RandomStream random = make_stream(1, 4);
  Sightings sightings{nominal, {}};
  for (int i = 0; i < 40; ++i) {
    sightings.frames.push_back(see(built, nominal, place(1.0 + 0.07 * i, 0.3 + 0.02 * i), {}, random));
  }
  test::expect_error([&] { fit_correction(sightings); }, {"M1 sees no ball in", "all directions"});
}

TEST(CorrectionBadData, AllAtOneDistance) {
  const omni::Rig built = built_rig(1), nominal = nominal_rig();
  RandomStream random = make_stream(1, 5);
  Sightings sightings{nominal, {}};
  for (int i = 0; i < 40; ++i) sightings.frames.push_back(see(built, nominal, place(2.5, 0.157 * i), {}, random));
  test::expect_error([&] { fit_correction(sightings); }, {"M1 sees all balls at nearly one distance", "near and far"});
}

TEST(CorrectionBadData, BearingOfNoCamera) {
  Sightings sightings = see_many(built_rig(1), 40, 1);
  sightings.frames[3].bearings[0].camera = 3;
  test::expect_error([&] { fit_correction(sightings); }, {"camera number 3", "3 cameras"});
}

// Each of these stays consistent in itself, so that functions as free as the correction's would follow it.
TEST(CorrectionBadData, PlacesThatNoIndividualDifferenceExplains) {
  const Sightings good = see_many(built_rig(1), 40, 1);
  const auto expect_refused = [&](const char* what, auto change) {
    Sightings sightings = good;
    for (Sighting& sighting : sightings.frames) change(*sighting.ball_in_robot);
    SCOPED_TRACE(what);
    test::expect_error([&] { fit_correction(sightings); }, {"sigmas", "ball_z", "metres"});
  };
  expect_refused("a tenth too far", [](Vector3d& ball) { ball.head<2>() *= 1.1; });
  expect_refused("height 0", [](Vector3d& ball) { ball.z() = 0.0; });
  expect_refused("height negative", [](Vector3d& ball) { ball.z() = -kBall; });
}

TEST(CorrectionBadData, AnotherRig) {
  Sightings sightings = see_many(built_rig(1), 40, 1);
  for (omni::Camera& camera : sightings.rig.cameras) camera.position.z() *= 2.0;
  test::expect_error([&] { fit_correction(sightings); }, {"M1", "sigmas", "rig"});
}

// 0.3° stated as 0.01°: with the floor of 0.02° that is 0.3/√(0.01² + 0.02²) = 13 times.
TEST(CorrectionBadData, BearingsFarWorseThanTheySay) {
  constexpr Noise kWild{radians(0.3), radians(0.03), radians(0.01), radians(0.03)};
  test::expect_error([&] { fit_correction(see_many(built_rig(1), 40, 1, kWild)); }, {"leaves", "azimuth", "times"});
}

TEST(KnownPlaces, RefusesWhatNoBallIs) {
  std::map<std::int64_t, grab::Truth> truth;
  truth[7].ball_in_field = {1.0, 2.0, 0.11};
  EXPECT_EQ(known_places(truth, "truth.csv").size(), 1U);
  for (const double height : {0.0, -0.11}) {
    truth[7].ball_in_field.z() = height;
    test::expect_error([&] { known_places(truth, "truth.csv"); }, {"truth.csv", "frame 7", "ball_z"});
  }
  truth[7].ball_in_field = {100.0, 200.0, 0.11};  // centimetres
  test::expect_error([&] { known_places(truth, "truth.csv"); }, {"truth.csv", "frame 7", "224 m", "metres"});
}

}  // namespace
}  // namespace movis::calibration
