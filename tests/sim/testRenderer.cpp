// The renderer against an independent ray tracer: the same scenes in both, and the same measurements of ball and goals
// taken from both pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "movis/core/angle.h"
#include "movis/grab/dataset_source.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "support/shared_data.h"
#include "support/traced_set.h"

namespace movis {
namespace {

// Ours less the ray tracer's, degrees.
struct Differences {
  std::vector<double> values;

  void add(double radians) { values.push_back(degrees(radians)); }
  double mean() const {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
  }
  double sigma() const {
    double sum = 0.0;
    for (const double value : values) sum += (value - mean()) * (value - mean());
    return values.size() < 2 ? 0.0 : std::sqrt(sum / static_cast<double>(values.size() - 1));
  }
  // The magnitude that this share of them does not exceed.
  double within(double share) const {
    if (values.empty()) return 0.0;
    std::vector<double> sizes;
    for (const double value : values) sizes.push_back(std::abs(value));
    std::sort(sizes.begin(), sizes.end());
    return sizes[static_cast<std::size_t>(std::ceil(share * static_cast<double>(sizes.size()))) - 1];
  }
  void print(const char* what) const {
    if (values.empty()) return;
    const auto beyond = std::count_if(values.begin(), values.end(), [](double value) { return std::abs(value) > 0.1; });
    std::printf("  %-24s n %3zu  mean %+.4f°  sigma %.4f°  median %.4f°  largest %.4f°  beyond 0.1°: %td\n", what,
                values.size(), mean(), sigma(), within(0.5), within(1.0), beyond);
  }
};

struct ObjectDifferences {
  Differences azimuth, elevation, edges;
  double most_sigmas = 0.0;  // of azimuth differences beyond 0.1°, the largest in units of what both bearings state
};

// A bearing is clean where both pictures say so.
struct Comparison {
  ObjectDifferences ball, flagged_ball, goals, flagged_goals;
  int missing = 0;  // seen in one of the two pictures only

  void add(const Bearing& theirs, const Bearing& ours) {
    const bool clean = theirs.clean() && ours.clean();
    const bool is_ball = theirs.object == ObjectClass::ball;
    ObjectDifferences& of = is_ball ? (clean ? ball : flagged_ball) : (clean ? goals : flagged_goals);
    const double azimuth = turn(theirs.azimuth, ours.azimuth);
    const double stated = std::sqrt(theirs.covariance(0, 0) + ours.covariance(0, 0));
    if (std::abs(azimuth) > radians(0.1)) of.most_sigmas = std::max(of.most_sigmas, std::abs(azimuth) / stated);
    of.azimuth.add(azimuth);
    of.elevation.add(ours.elevation - theirs.elevation);
    of.edges.add(turn(theirs.left, ours.left));
    of.edges.add(turn(theirs.right, ours.right));
  }
  void print() const {
    ball.azimuth.print("ball, azimuth");
    ball.elevation.print("ball, elevation");
    flagged_ball.azimuth.print("flagged ball, azimuth");
    flagged_ball.elevation.print("flagged ball, elevation");
    if (flagged_ball.most_sigmas > 0.0) {
      std::printf("  flagged ball, beyond 0.1°: at most %.1f of the stated sigmas\n", flagged_ball.most_sigmas);
    }
    goals.azimuth.print("goals, azimuth");
    goals.edges.print("goals, edges");
    flagged_goals.azimuth.print("flagged goals, azimuth");
    flagged_goals.edges.print("flagged goals, edges");
    std::printf("  seen in one picture only: %d\n", missing);
  }
};

// Without a field there are no goals: what looks like one is the detector's, not the scene's.
void compare(const std::vector<Bearing>& theirs, const std::vector<Bearing>& ours, bool has_goals, Comparison& result) {
  const auto counts = [&](const Bearing& b) { return has_goals || b.object == ObjectClass::ball; };
  const auto partner = [](const Bearing& of, const std::vector<Bearing>& in) {
    return std::find_if(in.begin(), in.end(),
                        [&](const Bearing& b) { return b.camera == of.camera && b.object == of.object; });
  };
  for (const Bearing& bearing : theirs) {
    if (!counts(bearing)) continue;
    const auto same = partner(bearing, ours);
    if (same == ours.end()) {
      ++result.missing;
    } else {
      result.add(bearing, *same);
    }
  }
  for (const Bearing& bearing : ours) {
    if (counts(bearing) && partner(bearing, theirs) == theirs.end()) ++result.missing;
  }
}

Comparison compare_set(const std::filesystem::path& folder) {
  test::TracedSet set(folder);
  pipeline::Pipeline pipeline(set.dataset().rig, set.field(), scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer("composed"));
  grab::DatasetSource source(set.dataset());
  Comparison comparison;
  source.open();
  grab::FrameSet ours;
  for (grab::FrameSet traced; source.acquire(traced);) {
    const std::vector<Bearing> theirs = step(pipeline, traced).bearings;
    set.render(traced.index, ours);
    compare(theirs, step(pipeline, ours).bearings, set.field().has_value(), comparison);
  }
  comparison.print();
  return comparison;
}

void expect_agreement(const ObjectDifferences& object, std::size_t fewest) {
  EXPECT_GE(object.azimuth.values.size(), fewest);
  EXPECT_LT(std::abs(object.azimuth.mean()), 0.01);
  EXPECT_LE(object.azimuth.sigma(), 0.03);
  EXPECT_LT(object.azimuth.within(1.0), 0.1);
}

// Elevations feel how the highlights of a ball differ: they lean its colour's centre up or down.
void expect_elevations(const ObjectDifferences& ball) {
  EXPECT_LT(std::abs(ball.elevation.mean()), 0.05);
  EXPECT_LE(ball.elevation.sigma(), 0.04);
}

// Of a ball or goal that is partly hidden, the detector decides for single pixels what belongs to it. Where the rest of
// the outline does not outvote them, the two pictures fall on different sides of that decision: most differences are as
// small as those of clean bearings, a few are large. In `near` these are balls whose mirror image in the next sensor
// unit touches them; its outline is then taken for the ball's, or not. A ball's stated covariance knows of it.
void expect_mostly_agreement(const ObjectDifferences& flagged) {
  if (flagged.azimuth.values.empty()) return;
  EXPECT_LT(flagged.azimuth.within(0.5), 0.04);
  EXPECT_LT(flagged.azimuth.within(0.75), 0.1);
}

void expect_agreement(const Comparison& comparison, std::size_t fewest_balls, std::size_t fewest_goals) {
  EXPECT_EQ(comparison.missing, 0);
  expect_agreement(comparison.ball, fewest_balls);
  expect_elevations(comparison.ball);
  if (fewest_goals > 0) expect_agreement(comparison.goals, fewest_goals);
  expect_mostly_agreement(comparison.flagged_ball);
  EXPECT_LT(comparison.flagged_ball.most_sigmas, 5.0);
  expect_mostly_agreement(comparison.flagged_goals);
}

TEST(RendererAgainstRayTracer, Open) {
  const auto folder = test::shared_data() / "pov" / "open";
  MOVIS_NEEDS_SHARED_DATA(folder);
  expect_agreement(compare_set(folder), 100, 0);
}

TEST(RendererAgainstRayTracer, Near) {
  const auto folder = test::shared_data() / "pov" / "near";
  MOVIS_NEEDS_SHARED_DATA(folder);
  expect_agreement(compare_set(folder), 20, 0);
}

TEST(RendererAgainstRayTracer, Field) {
  const auto folder = test::shared_data() / "pov" / "field";
  MOVIS_NEEDS_SHARED_DATA(folder);
  expect_agreement(compare_set(folder), 70, 130);
}

TEST(RendererAgainstRayTracer, FieldWithObstacles) {
  const auto folder = test::shared_data() / "pov" / "field-obstacles";
  MOVIS_NEEDS_SHARED_DATA(folder);
  expect_agreement(compare_set(folder), 20, 30);
}

}  // namespace
}  // namespace movis
