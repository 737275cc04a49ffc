// A rig's individual differences from goals and balls at unknown places, without images.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "movis/calibration/rig_calibration.h"
#include "support/temporary_folder.h"
#include "synthetic_sightings.h"

namespace movis::calibration {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace)

constexpr int kYaw = 3;

Field paper_field() {
  return read_field(data_file("fields/paper.yaml"));
}

// Poses all over the paper's field, in every heading, and a ball around the robot in each.
Sightings on_field(const omni::Rig& true_rig, int frames, const Noise& noise, double elevation_bias,
                   RandomStream& random) {
  const Field field = paper_field();
  const omni::Rig nominal = drawn_rig();
  Observer observer(true_rig, nominal, noise, elevation_bias, random);
  Sightings sightings{nominal, {}};
  for (const Vector3d& ball : spiral(frames)) {
    const auto i = static_cast<double>(sightings.frames.size());
    const Pose2 world_from_robot{1.4 * std::sin(1.7 * i), 1.5 * std::sin(2.9 * i + 1.0), wrap_angle(2.1 * i)};
    Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(sightings.frames.size());
    observer.see_ball(ball, sighting);
    observer.see_goals(world_from_robot, field, sighting);
    sightings.frames.push_back(std::move(sighting));
  }
  return sightings;
}

Sightings exact_on_field(const omni::Rig& true_rig, int frames = 16) {
  RandomStream random = make_stream(1, 1);
  return on_field(true_rig, frames, {}, 0.0, random);
}

// Known answer. Turns of the three cameras about their upright axes that add up to nothing turn the rig as a whole
// nowhere; they are found as they are (for the bearings that they make see RigCalibration.TurnedCamera).
TEST(RigSelfCalibration, TurnedCameras) {
  std::vector<omni::Deviation> deviations(3, omni::Deviation::Zero());
  deviations[0][kYaw] = radians(0.7);
  deviations[1][kYaw] = radians(-0.4);
  deviations[2][kYaw] = radians(-0.3);
  const RigCalibration result = self_calibrate_rig(drawn_rig(), exact_on_field(deviated(drawn_rig(), deviations)),
                                                   paper_field(), without_floors());
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(degrees(result.deviation[k][kYaw] - deviations[k][kYaw]), 0.0, 0.01);
  EXPECT_EQ(result.balls, 16);
  EXPECT_EQ(result.goals, 16);
  EXPECT_TRUE(result.rejected.empty());
}

// A rig that is turned and shifted as a whole on its robot sees what the nominal one would see from another pose: there
// is nothing to calibrate, and nothing is. Only the priors know how the rig is turned: by θ all three yaws turn and all
// three viewpoints, L from the middle, move by L θ, so that θ has the information 3/σ_yaw² + 3 L²/σ_position².
TEST(RigSelfCalibration, PlanarGaugeStaysAsDrawn) {
  const Pose2 moved{0.003, -0.002, radians(0.5)};
  omni::Rig true_rig = drawn_rig();
  for (omni::Camera& camera : true_rig.cameras) {
    camera.position.head<2>() = moved * Vector2d(camera.position.head<2>());
    camera.yaw += moved.beta;
  }
  const RigCalibration result =
      self_calibrate_rig(drawn_rig(), exact_on_field(true_rig), paper_field(), without_floors());
  constexpr double kL = 0.2;
  const double gauge_sigma =
      1.0 / std::sqrt(3.0 * (std::pow(result.prior[kYaw], -2) + std::pow(kL / result.prior[0], 2)));
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(result.deviation[k].cwiseQuotient(result.prior).cwiseAbs().maxCoeff(), 0.02) << k;
    EXPECT_NEAR(result.sigma[k][kYaw], gauge_sigma, 0.02 * gauge_sigma);
  }
}

// Round trip: the rig that is found sees the true one's world, but for the planar gauge: so compare what three cameras
// see of each other. Distances between viewpoints, heights and differences of yaws do not know the gauge.
TEST(RigSelfCalibration, FindsTheRigButForItsGauge) {
  RandomStream random = make_stream(2, 1);
  const omni::Rig true_rig = deviated(drawn_rig(), draw_deviations(3, random));
  const RigCalibration result =
      self_calibrate_rig(drawn_rig(), exact_on_field(true_rig, 30), paper_field(), without_floors());
  for (int k = 0; k < 3; ++k) {
    const omni::Camera& found = result.rig.cameras[k];
    const omni::Camera& next_found = result.rig.cameras[(k + 1) % 3];
    const omni::Camera& truth = true_rig.cameras[k];
    const omni::Camera& next_truth = true_rig.cameras[(k + 1) % 3];
    EXPECT_NEAR((found.position - next_found.position).head<2>().norm(),
                (truth.position - next_truth.position).head<2>().norm(), 3e-4);
    EXPECT_NEAR(degrees(turn(next_found.yaw, found.yaw)), degrees(turn(next_truth.yaw, truth.yaw)), 0.02);
    EXPECT_NEAR(degrees(found.tilt_x), degrees(truth.tilt_x), 0.02);
    EXPECT_NEAR(degrees(found.tilt_y), degrees(truth.tilt_y), 0.02);
  }
}

// As in RigCalibration.SigmasAreConsistent; the gauge is part of the prior. Few draws, as each is a bundle adjustment:
// of 6 × 27 correlated numbers the mean is known to some 15 %.
TEST(RigSelfCalibration, SigmasAreConsistent) {
  constexpr int kDraws = 6;
  const RigOptions options = without_floors();
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    RandomStream random = make_stream(draw, 3);
    const auto deviations = draw_deviations(3, random);
    const double bias = normal(random, radians(options.elevation_bias_deg));
    const Sightings sightings = on_field(deviated(drawn_rig(), deviations), 12, {0.012, 0.04, 0.03}, bias, random);
    sum += normalized_square(self_calibrate_rig(drawn_rig(), sightings, paper_field(), options), deviations);
  }
  EXPECT_GT(sum / kDraws, 0.5);
  EXPECT_LT(sum / kDraws, 1.5);
}

// Degenerate cases, by name.

TEST(RigSelfCalibration, TooFewFrames) {
  expect_error([] { self_calibrate_rig(drawn_rig(), exact_on_field(drawn_rig(), 7), paper_field()); },
               {"of 7 frames 7 show the ball and 7 a goal", "at least 8"});
}

TEST(RigSelfCalibration, NoBall) {
  Sightings sightings = exact_on_field(drawn_rig());
  for (Sighting& sighting : sightings.frames)
    sighting.bearings.erase(sighting.bearings.begin(), sighting.bearings.begin() + 3);
  expect_error([&] { self_calibrate_rig(drawn_rig(), sightings, paper_field()); }, {"0 show the ball", "16 a goal"});
}

TEST(RigSelfCalibration, NoGoals) {
  Sightings sightings = exact_on_field(drawn_rig());
  for (Sighting& sighting : sightings.frames) sighting.bearings.resize(3);
  expect_error([&] { self_calibrate_rig(drawn_rig(), sightings, paper_field()); }, {"16 show the ball", "0 a goal"});
}

TEST(RigSelfCalibration, CutGoalsDoNotCount) {
  Sightings sightings = exact_on_field(drawn_rig());
  for (Sighting& sighting : sightings.frames) {
    for (std::size_t i = 3; i < sighting.bearings.size(); ++i) sighting.bearings[i].flags = kCutByObject;
  }
  expect_error([&] { self_calibrate_rig(drawn_rig(), sightings, paper_field()); }, {"0 a goal"});
}

// Frames without a goal say what three cameras see of one ball; frames without a ball what they see of the goals.
TEST(RigSelfCalibration, FramesOfEitherKindHelp) {
  RandomStream random = make_stream(4, 1);
  Sightings sightings = exact_on_field(deviated(drawn_rig(), draw_deviations(3, random)), 24);
  for (int i = 0; i < 8; ++i) sightings.frames[i].bearings.resize(3);
  for (int i = 8; i < 16; ++i) {
    auto& bearings = sightings.frames[i].bearings;
    bearings.erase(bearings.begin(), bearings.begin() + 3);
  }
  const RigCalibration result = self_calibrate_rig(drawn_rig(), sightings, paper_field());
  EXPECT_EQ(result.balls, 16);
  EXPECT_EQ(result.goals, 16);
  EXPECT_TRUE(result.rejected.empty());
}

TEST(RigSelfCalibration, WhiteGoals) {
  Field field = paper_field();
  field.goals = Field::Goals::white;
  expect_error([&] { self_calibrate_rig(drawn_rig(), exact_on_field(drawn_rig()), field); }, {"white"});
}

TEST(RigSelfCalibration, AnotherField) {
  Field wider = paper_field();
  wider.Fw += 0.1;
  expect_error([&] { self_calibrate_rig(drawn_rig(), exact_on_field(drawn_rig(), 9), wider); }, {"goals' edges", "Fw"});
}

TEST(RigSelfCalibration, OneCameraOfOtherInstants) {
  Sightings sightings = exact_on_field(drawn_rig(), 12);
  for (std::size_t i = 0; i + 1 < sightings.frames.size(); ++i) {
    for (const std::size_t bearing : {2, 5, 8}) {  // ball, yellow and blue goal as the third camera sees them
      std::swap(sightings.frames[i].bearings[bearing], sightings.frames[i + 1].bearings[bearing]);
    }
  }
  expect_error([&] { self_calibrate_rig(drawn_rig(), sightings, paper_field()); },
               {"camera M3 contradicts the others"});
}

TEST(RigSelfCalibration, WrongEdgeIsNamed) {
  Sightings sightings = exact_on_field(drawn_rig(), 20);
  sightings.frames[6].bearings[4].left += radians(2.0);  // yellow goal, second camera
  const RigCalibration result = self_calibrate_rig(drawn_rig(), sightings, paper_field());
  ASSERT_EQ(result.rejected.size(), 1U);
  EXPECT_EQ(result.rejected[0].frame, 6);
  EXPECT_EQ(result.rejected[0].camera, 1);
  EXPECT_NE(result.rejected[0].reason.find("left edge"), std::string::npos) << result.rejected[0].reason;
}

TEST(RigSelfCalibration, CamerasInAnotherOrder) {
  Sightings sightings = exact_on_field(drawn_rig());
  for (Sighting& sighting : sightings.frames) {
    for (Bearing& bearing : sighting.bearings) {
      if (bearing.camera == 2) continue;
      const int other = 1 - bearing.camera;  // the same pixel there: the yaws differ
      const double turned = sightings.rig.cameras[other].yaw - sightings.rig.cameras[bearing.camera].yaw;
      for (double* azimuth : {&bearing.azimuth, &bearing.left, &bearing.right})
        *azimuth = wrap_angle(*azimuth + turned);
      bearing.camera = other;
    }
  }
  expect_error([&] { self_calibrate_rig(drawn_rig(), sightings, paper_field()); }, {"another order"});
}

}  // namespace
}  // namespace movis::calibration
