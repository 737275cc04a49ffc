// The error correction fitted to balls at known places, on bearings by plain projection.
#include <gtest/gtest.h>

#include <algorithm>

#include "known_balls.h"

namespace movis::calibration {
namespace {

// Every camera is turned by 0.01 about the vertical and nothing else: it sees everything at 0.01 too little, so that
// one coefficient of 0.01 is all there is to find.
TEST(CorrectionFit, YawAlone) {
  omni::Rig built = nominal_rig();
  for (omni::Camera& camera : built.cameras) camera.yaw += 0.01;
  const CorrectionFit fit = fit_correction(see_many(built, 40, 1));
  ASSERT_EQ(fit.correction.cameras.size(), 3U);
  EXPECT_TRUE(fit.rejected.empty());
  for (int i = 0; i < 3; ++i) {
    const triangulation::CameraCorrection& camera = fit.correction.cameras[i];
    EXPECT_EQ(camera.camera, built.cameras[i].name);
    // 0.01° a bearing over 40 of them, five standard errors.
    EXPECT_NEAR(camera.azimuth[0], 0.01, 5.0 * radians(0.01) / std::sqrt(40.0));
    EXPECT_NEAR(camera.elevation[0], 0.0, 5.0 * radians(0.03) / std::sqrt(40.0));
    EXPECT_NEAR(fit.azimuth_rms_before[i], 0.01, radians(0.01));
    EXPECT_EQ(camera.position, nominal_rig().cameras[i].position);
  }
}

// With noise alone the smallest order wins nearly always: a larger one would have to be better by more than chance.
TEST(CorrectionFit, NothingToCorrectIsLeftAlone) {
  int constants = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const auto& camera : fit_correction(see_many(nominal_rig(), 40, seed)).correction.cameras) {
      constants += (camera.azimuth.size() == 1 ? 1 : 0) + (camera.elevation.size() == 1 ? 1 : 0);
      all += 2;
    }
  }
  EXPECT_GE(constants, all * 3 / 4);
}

// Without noise what is left is what the functions cannot follow, hardly anything (correction.h).
TEST(CorrectionFit, RoundTripThroughCameras) {
  constexpr Noise kTiny{radians(1e-4), radians(1e-4), radians(1e-4), radians(1e-4)};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const omni::Rig built = built_rig(seed);
    const CorrectionFit fit = fit_correction(see_many(built, 80, seed, kTiny));
    EXPECT_TRUE(fit.rejected.empty());
    const Left left = left_of(fit.correction, see_many(built, 100, 50 + seed, kTiny));
    EXPECT_LT(left.azimuth_rms, radians(0.004)) << seed;
    EXPECT_LT(left.elevation_rms, radians(0.008)) << seed;
  }
}

// Where the detector is as good as it says, corrected bearings are hardly worse, cross-validation says how much, and
// their covariances are honest.
TEST(CorrectionFit, HonestCovariances) {
  Left mean;
  double predicted_azimuth = 0.0, predicted_elevation = 0.0;
  constexpr int kDraws = 12;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const omni::Rig built = built_rig(seed);
    const CorrectionFit fit = fit_correction(see_many(built, 40, seed));
    const Left left = left_of(fit.correction, see_many(built, 60, 100 + seed));
    mean.azimuth_rms += left.azimuth_rms / kDraws;
    mean.elevation_rms += left.elevation_rms / kDraws;
    mean.azimuth_normalized += left.azimuth_normalized / kDraws;
    mean.elevation_normalized += left.elevation_normalized / kDraws;
    for (int i = 0; i < 3; ++i) {
      predicted_azimuth += fit.azimuth_rms[i] / (3 * kDraws);
      predicted_elevation += fit.elevation_rms[i] / (3 * kDraws);
    }
  }
  EXPECT_LT(mean.azimuth_rms, 1.25 * radians(0.01));
  EXPECT_LT(mean.elevation_rms, 1.25 * radians(0.03));
  EXPECT_NEAR(predicted_azimuth / mean.azimuth_rms, 1.0, 0.15);
  EXPECT_NEAR(predicted_elevation / mean.elevation_rms, 1.0, 0.15);
  EXPECT_NEAR(mean.azimuth_normalized, 1.0, 0.2);
  EXPECT_NEAR(mean.elevation_normalized, 1.0, 0.2);
}

// Nearer than any ball that it was fitted to, a correction is rough, and says so: its sigmas are of the right size.
TEST(CorrectionFit, RoughNearerThanItWasFittedTo) {
  double normalized = 0.0, count = 0.0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const omni::Rig built = built_rig(seed), nominal = nominal_rig();
    const triangulation::Correction correction = fit_correction(see_many(built, 40, seed)).correction;
    RandomStream random = make_stream(seed, 6);
    for (int i = 0; i < 24; ++i) {
      const Sighting sighting = see(built, nominal, place(0.36, 0.26 * i), {}, random);
      std::vector<Bearing> bearings = sighting.bearings;
      triangulation::correct(correction, bearings);
      for (const Bearing& bearing : bearings) {
        const double measured = sighting.bearings[bearing.camera].elevation;
        if (measured > correction.cameras[bearing.camera].min_elevation) continue;
        const Vector3d offset = *sighting.ball_in_robot - nominal.cameras[bearing.camera].position;
        const double azimuth = turn(std::atan2(offset.y(), offset.x()), bearing.azimuth);
        normalized += azimuth * azimuth / bearing.covariance(0, 0);
        count += 1.0;
      }
    }
  }
  normalized /= count;
  EXPECT_GT(normalized, 0.3);
  EXPECT_LT(normalized, 3.0);
}

// A detector that is three times worse than it says: what is left beyond its covariances is added to them.
TEST(CorrectionFit, MakesUpForBoldCovariances) {
  constexpr Noise kBold{radians(0.03), radians(0.09), radians(0.01), radians(0.03)};
  Left mean;
  constexpr int kDraws = 12;
  for (std::uint64_t seed = 1; seed <= kDraws; ++seed) {
    const omni::Rig built = built_rig(seed);
    const CorrectionFit fit = fit_correction(see_many(built, 40, seed, kBold));
    const Left left = left_of(fit.correction, see_many(built, 60, 100 + seed, kBold));
    mean.azimuth_normalized += left.azimuth_normalized / kDraws;
    mean.elevation_normalized += left.elevation_normalized / kDraws;
  }
  EXPECT_NEAR(mean.azimuth_normalized, 1.0, 0.2);
  EXPECT_NEAR(mean.elevation_normalized, 1.0, 0.2);
}

TEST(CorrectionFit, SameInputSameCorrection) {
  const Sightings sightings = see_many(built_rig(1), 40, 1);
  const auto first = fit_correction(sightings).correction, second = fit_correction(sightings).correction;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(first.cameras[i].azimuth, second.cameras[i].azimuth);
    EXPECT_EQ(first.cameras[i].elevation, second.cameras[i].elevation);
  }
}

TEST(CorrectionFit, KeepsTheElevationsItWasFittedTo) {
  const Sightings sightings = see_many(built_rig(1), 40, 1);
  const CorrectionFit fit = fit_correction(sightings);
  double lowest = 1.0, highest = -1.0;
  for (const Sighting& sighting : sightings.frames) {
    lowest = std::min(lowest, sighting.bearings[1].elevation);
    highest = std::max(highest, sighting.bearings[1].elevation);
  }
  EXPECT_EQ(fit.correction.cameras[1].min_elevation, lowest);
  EXPECT_EQ(fit.correction.cameras[1].max_elevation, highest);
}

}  // namespace
}  // namespace movis::calibration
