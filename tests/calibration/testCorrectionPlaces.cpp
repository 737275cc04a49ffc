// Known places are written down with a tape's error: what fit_correction makes of it, on bearings by plain projection.
#include <gtest/gtest.h>

#include "known_balls.h"

namespace movis::calibration {
namespace {

// Known answer. Balls stand evenly all around the first camera's viewpoint, 1 m and 3 m away, and all near ones are
// written down turned about it by α. Its bearings are right. On each ring every term but the constant is orthogonal to
// the constant; so that is the weighted mean of α and 0,
//   c = α w_1/(w_1 + w_3),   1/w_d = σ² + (σ_place/d)²
TEST(CorrectionPlaces, NearPlacesWeighLess) {
  const omni::Rig rig = nominal_rig();
  const Vector3d viewpoint = rig.cameras[0].position;
  constexpr double kPlace = 0.005, kTurned = 0.5 * kPlace, kAround = 24;
  RandomStream random = make_stream(1, 1);
  const Noise exact{0.0, 0.0, radians(0.01), radians(0.03)};
  Sightings sightings{rig, {}};
  for (const double distance : {1.0, 3.0}) {
    for (int i = 0; i < kAround; ++i) {
      const auto at = [&](double azimuth) {
        return Vector3d(viewpoint.x() + distance * std::cos(azimuth), viewpoint.y() + distance * std::sin(azimuth),
                        kBall);
      };
      const double azimuth = 2.0 * kPi * i / kAround;
      sightings.frames.push_back(see(rig, rig, at(azimuth), exact, random));
      if (distance == 1.0) sightings.frames.back().ball_in_robot = at(azimuth + kTurned);
    }
  }
  const auto weight = [&](double distance) {
    return 1.0 / (std::pow(exact.stated_azimuth, 2) + std::pow(kPlace / distance, 2));
  };
  const double expected = kTurned * weight(1.0) / (weight(1.0) + weight(3.0));  // a tenth of α
  const CorrectionFit fit = fit_correction(sightings, {kPlace});
  EXPECT_TRUE(fit.rejected.empty());
  EXPECT_NEAR(fit.correction.cameras[0].azimuth[0], expected, 0.05 * expected);
}

struct Taped {
  Left mean;
  std::size_t rejected = 0;
};

// Over rigs that are corrected by 40 balls whose places err by 5 mm; judged by balls at exact places.
Taped fit_taped(double place_sigma) {
  constexpr double kTape = 0.005;
  constexpr int kDraws = 12;
  Taped result;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const omni::Rig built = built_rig(seed);
    Sightings sightings = see_many(built, 40, seed);
    add_slips(sightings, kTape, seed);
    const CorrectionFit fit = fit_correction(sightings, {place_sigma});
    const Left left = left_of(fit.correction, see_many(built, 60, 100 + seed));
    result.rejected += fit.rejected.size();
    result.mean.azimuth_rms += left.azimuth_rms / kDraws;
    result.mean.elevation_rms += left.elevation_rms / kDraws;
    result.mean.azimuth_normalized += left.azimuth_normalized / kDraws;
    result.mean.elevation_normalized += left.elevation_normalized / kDraws;
  }
  return result;
}

// A tape that is as exact as it is said to be: no mark is left out, bearings are better than where places are taken as
// exact, and their covariances are honest. What one rig's tape did to its correction all its bearings share: of 36
// cameras the mean is known to some 25 %.
TEST(CorrectionPlaces, HonestCovariances) {
  const Taped told = fit_taped(0.005);
  const Taped not_told = fit_taped(0.0);
  EXPECT_EQ(told.rejected, 0U);
  EXPECT_LT(told.mean.azimuth_rms, not_told.mean.azimuth_rms);
  EXPECT_LT(told.mean.elevation_rms, not_told.mean.elevation_rms);
  EXPECT_GT(told.mean.azimuth_normalized, 0.5);
  EXPECT_LT(told.mean.azimuth_normalized, 1.5);
  EXPECT_GT(told.mean.elevation_normalized, 0.5);
  EXPECT_LT(told.mean.elevation_normalized, 1.5);
}

TEST(CorrectionPlaces, WrongPlacesAreNamedWithARoughTape) {
  Sightings sightings = see_many(built_rig(2), 40, 2);
  add_slips(sightings, 0.005, 2);
  std::swap(sightings.frames[4].ball_in_robot, sightings.frames[30].ball_in_robot);
  Vector3d& moved = *sightings.frames[12].ball_in_robot;
  moved.head<2>() *= 1.0 + 0.3 / moved.head<2>().norm();
  const CorrectionFit fit = fit_correction(sightings, {0.005});
  ASSERT_EQ(fit.rejected.size(), 3U);
  EXPECT_EQ(fit.rejected[0].frame, sightings.frames[4].frame);
  EXPECT_EQ(fit.rejected[1].frame, sightings.frames[12].frame);
  EXPECT_EQ(fit.rejected[2].frame, sightings.frames[30].frame);
}

// Whether a mark is wrong is a matter of the tape: 2 cm beside it is three sigmas of 7 mm and far beyond those of 1 mm.
TEST(CorrectionPlaces, MovedBallIsJudgedByTheTape) {
  Sightings sightings = see_many(built_rig(3), 40, 3);
  Vector3d& place = *sightings.frames[6].ball_in_robot;
  const double turned = 0.02 / place.head<2>().norm();
  place.head<2>() += turned * Eigen::Vector2d(-place.y(), place.x());
  EXPECT_TRUE(fit_correction(sightings, {0.007}).rejected.empty());
  const CorrectionFit strict = fit_correction(sightings, {0.001});
  ASSERT_EQ(strict.rejected.size(), 1U);
  EXPECT_EQ(strict.rejected[0].frame, sightings.frames[6].frame);
}

}  // namespace
}  // namespace movis::calibration
