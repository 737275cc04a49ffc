#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "movis/sim/renderer.h"
#include "support/shared_data.h"

// The renderer against an independent ray tracer: the same scenes in both, the same measurements of ball and goals taken from
// both pictures.
namespace movis {
namespace {

namespace fs = std::filesystem;

// The look of the surfaces, and a camera without blur and noise, as the ray tracer's.
sim::Look clean_look() {
  sim::Look look = sim::read_look(data_file("looks/hall.yaml"));
  look.sensor = {};
  return look;
}

// The robot in the ray tracer's scenes.
control::RobotModel traced_robot() {
  control::RobotModel robot;
  robot.radius = 0.24;
  robot.height = 0.11;
  return robot;
}

struct Differences {
  std::vector<double> values;  // radians
  void add(double value) { values.push_back(value); }
  double mean() const {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
  }
  double sigma() const {
    double sum = 0.0;
    for (const double value : values) sum += (value - mean()) * (value - mean());
    return std::sqrt(sum / static_cast<double>(values.size() - 1));
  }
  double largest() const {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }
};

struct Comparison {
  Differences ball_azimuth, ball_elevation, goal_azimuth, goal_edges;
  int missing = 0;  // seen in one of the two pictures only
};

void compare(const std::vector<Bearing>& ours, const std::vector<Bearing>& traced, Comparison& result) {
  for (const Bearing& theirs : traced) {
    const auto same = [&](const Bearing& b) { return b.camera == theirs.camera && b.object == theirs.object; };
    const auto found = std::find_if(ours.begin(), ours.end(), same);
    if (found == ours.end()) {
      ++result.missing;
      continue;
    }
    const double off = turn(theirs.azimuth, found->azimuth);
    if (std::abs(off)>radians(0.08) || (theirs.object!=ObjectClass::ball && std::abs(turn(theirs.left, found->left))>radians(0.08))|| (theirs.object!=ObjectClass::ball && std::abs(turn(theirs.right, found->right))>radians(0.08)))
      printf("   cam %d %s off %.3f el %.3f flags %d/%d left %.3f right %.3f\n", theirs.camera, name(theirs.object), degrees(off), degrees(found->elevation-theirs.elevation), theirs.flags, found->flags, degrees(turn(theirs.left, found->left)), degrees(turn(theirs.right, found->right)));
    if (theirs.object == ObjectClass::ball) {
      result.ball_azimuth.add(off);
      result.ball_elevation.add(found->elevation - theirs.elevation);
    } else {
      result.goal_azimuth.add(off);
      result.goal_edges.add(turn(theirs.left, found->left));
      result.goal_edges.add(turn(theirs.right, found->right));
    }
  }
  for (const Bearing& b : ours) {
    const auto same = [&](const Bearing& t) { return b.camera == t.camera && b.object == t.object; };
    result.missing += std::none_of(traced.begin(), traced.end(), same) ? 1 : 0;
  }
}

Comparison compare_set(const fs::path& folder) {
  grab::DatasetSource source(grab::read_dataset(folder));
  const auto truth = grab::read_truth(folder / "truth.csv");
  const grab::Dataset& dataset = source.dataset();
  sim::Arena arena;
  if (dataset.field_file) arena.field = read_field(*dataset.field_file);
  pipeline::Pipeline pipeline(dataset.rig, arena.field, scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer("composed"));
  sim::Renderer renderer(dataset.rig, arena, traced_robot(), clean_look());
  Comparison comparison;
  source.open();
  grab::FrameSet ours;
  for (grab::FrameSet traced; source.acquire(traced);) {
    const std::vector<Bearing> theirs = step(pipeline, traced).bearings;
    const grab::Truth& t = truth.at(traced.index);
    renderer.render({0.0, t.world_from_robot, t.ball_in_field}, 1, ours);
    if (const char* out = getenv("OUT")) for (size_t i=0;i<3;++i) { cv::Mat both; cv::hconcat(traced.memory[i], ours.memory[i], both); cv::imwrite(std::string(out)+"/"+folder.filename().string()+std::to_string(traced.index)+"_"+std::to_string(i)+".png", both);}
    printf("frame %ld\n", (long)traced.index);
    compare(step(pipeline, ours).bearings, theirs, comparison);
  }
  return comparison;
}

void report(const char* what, const Differences& d) {
  if (d.values.size() < 2) return;
  std::printf("  %-16s n %3zu  mean %+.4f°  sigma %.4f°  largest %.4f°\n", what, d.values.size(), degrees(d.mean()),
              degrees(d.sigma()), degrees(d.largest()));
}

void expect_agreement(const std::string& set) {
  const fs::path folder = test::shared_data() / "pov" / set;
  MOVIS_NEEDS_SHARED_DATA(folder);
  const Comparison comparison = compare_set(folder);
  std::printf("%s: %d missing\n", set.c_str(), comparison.missing);
  report("ball azimuth", comparison.ball_azimuth);
  report("ball elevation", comparison.ball_elevation);
  report("goal azimuth", comparison.goal_azimuth);
  report("goal edges", comparison.goal_edges);
}

TEST(RendererAgainstRayTracer, Open) {
  expect_agreement("open");
}
TEST(RendererAgainstRayTracer, Near) {
  expect_agreement("near");
}
TEST(RendererAgainstRayTracer, Field) {
  expect_agreement("field");
}

}  // namespace
}  // namespace movis
