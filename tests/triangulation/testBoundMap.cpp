// The bound all over the floor.
#include <gtest/gtest.h>

#include "movis/core/error.h"
#include "movis/triangulation/bound_map.h"
#include "movis_rig.h"
#include "support/temporary_folder.h"

namespace movis::triangulation {
namespace {

using test::expect_error;

TEST(BoundMap, CoversTheSquareRowByRow) {
  BoundMapOptions options;
  options.half_width = 1.1;
  options.step = 0.5;
  const auto cells = bound_map(paper_rig(), options);
  ASSERT_EQ(cells.size(), 25U);
  EXPECT_EQ(cells[0].place, Vector2d(-1.0, -1.0));
  EXPECT_EQ(cells[1].place, Vector2d(-0.5, -1.0));
  EXPECT_EQ(cells[24].place, Vector2d(1.0, 1.0));
  EXPECT_EQ(cells[0].cameras, 3);
  EXPECT_EQ(cells[12].floor.status, BoundStatus::unobservable);  // the robot's own place
}

TEST(BoundMap, TellsOfEveryRow) {
  BoundMapOptions options;
  options.half_width = 1.1;
  options.step = 0.5;
  EXPECT_EQ(bound_map_rows(options), 5);
  int rows = 0;
  bound_map(paper_rig(), options, [&] { ++rows; });
  EXPECT_EQ(rows, 5);
  rows = 0;
  const auto stop_at_the_second = [&] {
    if (++rows == 2) throw Error("stopped");
  };
  expect_error([&] { bound_map(paper_rig(), options, stop_at_the_second); }, {"stopped"});
  EXPECT_EQ(rows, 2);
}

// The triangle looks the same from 120° on.
TEST(BoundMap, HasTheRigsSymmetry) {
  for (const double distance : {0.7, 2.0, 4.0}) {
    const auto ring = bound_ring(paper_rig(), distance, 36, {});
    for (std::size_t i = 0; i < 12; ++i) {
      for (const std::size_t turned : {i + 12, i + 24}) {
        EXPECT_NEAR(ring[turned].free.sigma.distance / ring[i].free.sigma.distance, 1.0, 1e-6);
        EXPECT_NEAR(ring[turned].floor.sigma.direction / ring[i].floor.sigma.direction, 1.0, 1e-6);
      }
    }
  }
}

TEST(BoundMap, KnowledgeNeverHarms) {
  BoundMapOptions with_diameter;
  with_diameter.diameter = true;
  for (const double distance : {0.7, 2.0, 4.0}) {
    const BoundCell plain = bound_at(paper_rig(), {0.0, distance}, {});
    const BoundCell more = bound_at(paper_rig(), {0.0, distance}, with_diameter);
    EXPECT_LT(plain.floor.sigma.distance, plain.free.sigma.distance);
    EXPECT_LT(more.floor.sigma.distance, plain.floor.sigma.distance);
    EXPECT_LT(more.free.sigma.distance, plain.free.sigma.distance);
  }
}

TEST(BoundMap, OneCamera) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0)};
  const BoundCell cell = bound_at(rig, {0.0, 2.0}, {});
  EXPECT_EQ(cell.cameras, 1);
  EXPECT_EQ(cell.floor.status, BoundStatus::ok);
  EXPECT_EQ(cell.free.status, BoundStatus::unobservable);
}

TEST(BoundMap, NobodyLooks) {
  omni::Rig rig;
  rig.cameras = {camera_at({0.0, 0.0}, 0.0)};
  BoundMapOptions options;
  options.height = 3.0;  // above the mirror's rim
  const BoundCell cell = bound_at(rig, {0.0, 1.0}, options);
  EXPECT_EQ(cell.cameras, 0);
  EXPECT_EQ(cell.floor.status, BoundStatus::not_seen);
}

TEST(BoundMap, OptionsWithoutSense) {
  const auto map = [](auto change) {
    BoundMapOptions options;
    change(options);
    bound_map(paper_rig(), options);
  };
  expect_error([&] { map([](auto& o) { o.step = 0.0; }); }, {"step is 0 m"});
  expect_error([&] { map([](auto& o) { o.step = 5.0; }); }, {"step is 5 m", "half width, 4 m"});
  expect_error([&] { map([](auto& o) { o.step = 0.001; }); }, {"0.001 m", "coarser"});
  expect_error([&] { map([](auto& o) { o.half_width = -1.0; }); }, {"half width is -1 m"});
  expect_error([&] { map([](auto& o) { o.height = -5.0; }); }, {"height", "-5 m"});
  expect_error([&] { map([](auto& o) { o.picture.noise = 0.0; }); }, {"noise is 0", "above 0"});
  expect_error([&] { map([](auto& o) { o.picture.contrast = 0.0; }); }, {"contrast is 0"});
  expect_error([&] { map([](auto& o) { o.picture.blur_px = -0.1; }); }, {"blur is -0.1"});
  expect_error([&] { map([](auto& o) { o.ball_radius = 0.0; }); }, {"radius is 0 m"});
  expect_error([&] { map([](auto& o) { o.floor_sigma = -1.0; }); }, {"floor's sigma is -1 m"});
}

}  // namespace
}  // namespace movis::triangulation
