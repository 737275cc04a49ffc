// Rigs as they might be built, calibrated on rendered images with sensor noise, and then measuring balls at other
// places. MOVIS_CALIBRATION_DRAWS sets the number of rigs that are drawn; all are printed.
#include <gtest/gtest.h>

#include <cstdlib>

#include "movis/calibration/rig_calibration.h"
#include "rendered_balls.h"

namespace movis {
namespace {

using test::RenderedSet;

struct Extent {
  int rigs = 1, frames = 24, others = 12;
};

Extent extent() {
  const char* chosen = std::getenv("MOVIS_CALIBRATION_DRAWS");
  return chosen != nullptr ? Extent{std::max(1, std::atoi(chosen)), 40, 30} : Extent{};
}

struct Case {
  omni::Rig true_rig;
  RandomStream random;
};

Case draw_case(int seed) {
  RandomStream random = make_stream(seed, 1);
  omni::Rig rig = omni::draw_rig(test::nominal_rig(), omni::individual_differences(), random);
  return {std::move(rig), random};
}

// Where the balls stood is known: on other frames, over 8 m × 8 m, the calibrated rig measures distances hardly worse
// than the true one.
TEST(RigImages, KnownPlaces) {
  const auto [rigs, frames, other_frames] = extent();
  double with_truth = 0.0, calibrated = 0.0, with_nominal = 0.0;
  for (int seed = 1; seed <= rigs; ++seed) {
    Case drawn = draw_case(seed);
    const omni::Rig nominal = test::nominal_rig();
    const RenderedSet set(drawn.true_rig, std::nullopt, test::balls_around(frames, drawn.random), seed);
    const RenderedSet others(drawn.true_rig, std::nullopt, test::balls_around(other_frames, drawn.random), 500 + seed);
    const omni::Rig first = calibration::calibrate_rig(nominal, set.sightings(nominal, true)).rig;
    const auto result = calibration::calibrate_rig(nominal, set.sightings(first, true));
    const auto errors =
        std::array{measure(drawn.true_rig, others), measure(result.rig, others), measure(nominal, others)};
    std::printf("rig %2d: true %.2f cm, calibrated %.2f cm, nominal %.0f cm\n", seed, 100.0 * distance_error(errors[0]),
                100.0 * distance_error(errors[1]), 100.0 * distance_error(errors[2]));
    with_truth += distance_error(errors[0]) / rigs;
    calibrated += distance_error(errors[1]) / rigs;
    with_nominal += distance_error(errors[2]) / rigs;
    EXPECT_EQ(errors[1].missed, 0);
  }
  std::printf("mean of %d: true %.2f cm, calibrated %.2f cm, nominal %.0f cm\n", rigs, 100.0 * with_truth,
              100.0 * calibrated, 100.0 * with_nominal);
  EXPECT_LE(calibrated, 1.5 * with_truth);
  EXPECT_GT(with_nominal, 10.0 * calibrated);  // there was something to calibrate
}

// Nothing is known but the field; the robot stands at random poses, the ball lies at random places on it. Judged modulo
// the rig's planar gauge.
TEST(RigImages, SelfCalibration) {
  const auto [rigs, frames, other_frames] = extent();
  const Field field = read_field(data_file("fields/paper.yaml"));
  double with_truth = 0.0, calibrated = 0.0;
  for (int seed = 1; seed <= rigs; ++seed) {
    Case drawn = draw_case(seed);
    const omni::Rig nominal = test::nominal_rig();
    const RenderedSet set(drawn.true_rig, field, test::states_on_field(field, frames, drawn.random), seed);
    const RenderedSet others(drawn.true_rig, std::nullopt, test::balls_around(other_frames, drawn.random), 500 + seed);
    const omni::Rig first = calibration::self_calibrate_rig(nominal, set.sightings(nominal, false), field).rig;
    const auto result = calibration::self_calibrate_rig(nominal, set.sightings(first, false), field);
    const double best = distance_error(without_gauge(measure(drawn.true_rig, others)));
    const double error = distance_error(without_gauge(measure(result.rig, others)));
    std::printf("rig %2d: true %.2f cm, self-calibrated %.2f cm\n", seed, 100.0 * best, 100.0 * error);
    with_truth += best / rigs;
    calibrated += error / rigs;
  }
  std::printf("mean of %d: true %.2f cm, self-calibrated %.2f cm\n", rigs, 100.0 * with_truth, 100.0 * calibrated);
  EXPECT_LE(calibrated, 0.06);
}

}  // namespace
}  // namespace movis
