// The paper's four steps (§2.4) on rendered images of rigs with individual differences: the object in the robot frame
// (1), the pose (2), the pose after the error correction (3), the object's absolute position with both corrected (4).
// By default one draw of a rig; MOVIS_DRAWS=10 in the environment makes it the evaluation. It prints a table.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

#include "calibration/rendered_balls.h"
#include "movis/calibration/correction_calibration.h"
#include "movis/localization/object_position.h"
#include "movis/pipeline/pipeline.h"

namespace movis::test {
namespace {

struct Errors {
  double in_robot = 0.0, pose = 0.0, heading = 0.0, in_field = 0.0;  // mean magnitudes, metres and radians
  double largest_in_field = 0.0;
  int measured = 0, frames = 0;

  void add(const Errors& other) {  // sums, not means
    in_robot += other.in_robot;
    pose += other.pose;
    heading += other.heading;
    in_field += other.in_field;
    largest_in_field = std::max(largest_in_field, other.largest_in_field);
    measured += other.measured;
    frames += other.frames;
  }
};

constexpr std::array<const char*, 2> kLocalizers{"composed", "nls"};
using ByLocalizer = std::array<Errors, kLocalizers.size()>;

void add(ByLocalizer& sums, const ByLocalizer& others) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i].add(others[i]);
}

// Sums over the frames in which ball and pose were measured. The images are scanned once for all localizers.
ByLocalizer track(const RenderedSet& set, const omni::Rig& believed, const Field& field,
                  const triangulation::Correction& correction) {
  pipeline::Pipeline pipeline(believed, field, scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer(kLocalizers[0]));
  pipeline.correction = correction;
  ByLocalizer errors;
  for (std::size_t i = 0; i < set.images().size(); ++i) {
    const pipeline::Estimate& estimate = step(pipeline, set.images()[i]);
    const sim::State& truth = set.states()[i];
    for (std::size_t l = 0; l < kLocalizers.size(); ++l) {
      ++errors[l].frames;
      const Fix fix = localization::find_localizer(kLocalizers[l])
                          .fix({believed, estimate.bearings, estimate.goals, estimate.lines}, *pipeline.map,
                               pipeline.options.localization);
      const localization::ObjectPosition ball = localization::object_position(fix, estimate.ball_in_robot);
      if (ball.status != localization::ObjectStatus::ok) continue;
      const double in_field = (ball.in_field - truth.ball_in_field.head<2>()).norm();
      errors[l].add({(estimate.ball_in_robot.point.head<2>() - ball_in_robot(truth).head<2>()).norm(),
                     (fix.world_from_robot.translation() - truth.world_from_robot.translation()).norm(),
                     std::abs(turn(truth.world_from_robot.beta, fix.world_from_robot.beta)), in_field, in_field, 1, 0});
    }
  }
  return errors;
}

void print(const char* what, const Errors& sum) {
  const double n = std::max(1, sum.measured);
  std::printf(
      "  %-22s ball in robot %6.2f cm   pose %6.2f cm %7.3f°   ball in field %6.2f cm, at most %6.2f   %d of %d\n",
      what, 100.0 * sum.in_robot / n, 100.0 * sum.pose / n, degrees(sum.heading / n), 100.0 * sum.in_field / n,
      100.0 * sum.largest_in_field, sum.measured, sum.frames);
}

TEST(MeasurementSteps, CorrectionBringsTheAbsolutePosition) {
  const char* asked = std::getenv("MOVIS_DRAWS");
  const int draws = asked != nullptr ? std::max(1, std::atoi(asked)) : 1;
  const int places = asked != nullptr ? 40 : 24, tests = asked != nullptr ? 30 : 8;
  const omni::Rig nominal = nominal_rig();
  const Field field = read_field(data_file("fields/paper.yaml"));
  ByLocalizer nominals, correcteds, knowns;
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(draws); ++seed) {
    RandomStream random = make_stream(seed, 0);
    const omni::Rig built = omni::draw_rig(nominal, omni::individual_differences(), random);
    const RenderedSet balls(built, {}, balls_around(places, random), 2 * seed);
    const RenderedSet set(built, field, states_on_field(field, tests, random), 2 * seed + 1);
    const triangulation::Correction correction = calibration::fit_correction(balls.sightings(nominal, true)).correction;
    add(nominals, track(set, nominal, field, {}));
    add(correcteds, track(set, nominal, field, correction));
    add(knowns, track(set, built, field, {}));
  }
  for (std::size_t l = 0; l < kLocalizers.size(); ++l) {
    const Errors &without = nominals[l], &with = correcteds[l];
    std::printf("%s, %d draws\n", kLocalizers[l], draws);
    print("nominal", without);
    print("corrected", with);
    print("the true rig", knowns[l]);
    EXPECT_GT(without.in_field, 0.1 * without.measured) << kLocalizers[l];  // there is something to correct
    EXPECT_LT(with.in_field, 0.04 * with.measured) << kLocalizers[l];
    EXPECT_LT(with.pose, without.pose * with.measured / without.measured) << kLocalizers[l];
    EXPECT_GE(with.measured, without.measured) << kLocalizers[l];
  }
}

}  // namespace
}  // namespace movis::test
