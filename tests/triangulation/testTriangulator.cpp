#include <gtest/gtest.h>

#include "movis/triangulation/triangulator.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

TEST(Triangulator, EveryNameIsFound) {
  const auto names = triangulator_names();
  ASSERT_EQ(names.size(), 2U);
  EXPECT_EQ(names[0], "pairs");
  EXPECT_EQ(names[1], "joint");
  for (const auto name : names) {
    EXPECT_NE(find_triangulator(name).ball, nullptr);
    EXPECT_NE(find_triangulator(name).goal, nullptr);
  }
  EXPECT_NO_THROW(find_triangulator(kDefaultTriangulator));
}

TEST(Triangulator, UnknownName) {
  test::expect_error([] { find_triangulator("joints"); }, {"'joints'", "did you mean 'joint'", "pairs"});
  test::expect_error([] { find_triangulator(""); }, {"pairs", "joint"});
}

// M3's azimuth is off: straight ahead M1 and M2 alone are the pair, but all three are the joint estimate.
TEST(Triangulator, EachIsWhatItIsCalled) {
  const omni::Rig rig = paper_rig();
  const Vector3d point(0.0, 2.0, kBall);
  auto bearings = exact_bearings(rig, point);
  bearings[2].azimuth += 1e-3;
  EXPECT_LT((find_triangulator("pairs").ball(rig, bearings, {}).point - point).norm(), 1e-9);
  EXPECT_GT((find_triangulator("joint").ball(rig, bearings, {}).point - point).norm(), 1e-5);
}

TEST(Triangulator, OptionsReachIt) {
  const omni::Rig rig = paper_rig();
  const auto bearings = exact_bearings(rig, {0.0, 2.0, kBall});
  Options options;
  options.pairs.min_parallax_deg = 89.0;
  options.joint.floor = false;
  EXPECT_EQ(find_triangulator("pairs").ball(rig, bearings, options).status, PointStatus::parallel_rays);
  EXPECT_FALSE(find_triangulator("joint").ball(rig, bearings, options).on_floor);
}

// Cameras above each other have no parallax in azimuth; cameras in one place have none at all.
TEST(Triangulator, RequiresParallax) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0), camera_at({0.0, 0.0}, 0.0)};
  test::expect_error([&] { find_triangulator("joint").require(rig); }, {"at least 0.01 m apart", "position"});
  rig.cameras[1].position.z() += 0.2;
  EXPECT_NO_THROW(find_triangulator("joint").require(rig));
  test::expect_error([&] { find_triangulator("pairs").require(rig); }, {"floor plane", "position", "jointly"});
  for (const auto name : triangulator_names()) {
    EXPECT_NO_THROW(find_triangulator(name).require(paper_rig())) << name;
    rig.cameras.resize(1);
    test::expect_error([&] { find_triangulator(name).require(rig); }, {"two or more cameras", "1"});
  }
}

TEST(TriangulationOptions, AreReadStrictly) {
  const test::TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    return read_options(YamlMap::read(folder.write("options.yaml", text)));
  };
  const Options options = read("pairs: {min_parallax_deg: 1.5}\njoint: {floor_sigma: 0.01}\n");
  EXPECT_DOUBLE_EQ(options.pairs.min_parallax_deg, 1.5);
  EXPECT_DOUBLE_EQ(options.joint.floor_sigma, 0.01);
  EXPECT_DOUBLE_EQ(read("{}\n").joint.ball_radius, JointOptions{}.ball_radius);
  test::expect_error([&] { read("min_parallax_deg: 1\n"); }, {"options.yaml:1", "min_parallax_deg", "pairs, joint"});
  test::expect_error([&] { read("joint: {floors: 1}\n"); }, {"options.yaml:1", "floors", "floor"});
}

}  // namespace
}  // namespace movis::triangulation
