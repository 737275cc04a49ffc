// The bodies that the renderer draws; its own header, as nobody else needs it.
#include <gtest/gtest.h>

#include <random>

#include "movis/core/random.h"
#include "prop.h"

namespace movis::sim {
namespace {

Prop ball() {
  Prop prop;
  prop.shape = Prop::Shape::ball;
  prop.centre = {2.0F, 0.0F, 0.5F};
  prop.radius = 0.5F;
  return prop;
}

Prop box() {
  Prop prop;
  prop.shape = Prop::Shape::box;
  prop.low = {1.0F, -0.5F, 0.0F};
  prop.high = {1.2F, 0.5F, 0.6F};
  prop.centre = 0.5F * (prop.low + prop.high);
  return prop;
}

Prop cylinder() {
  Prop prop;
  prop.shape = Prop::Shape::cylinder;
  prop.centre = {0.0F, 3.0F, 0.4F};
  prop.radius = 0.25F;
  prop.height = 0.8F;
  prop.band_bottom = 0.3F;
  prop.band_top = 0.5F;
  return prop;
}

Ray ray_to(const Eigen::Vector3f& origin, const Eigen::Vector3f& through) {
  return {origin, (through - origin).normalized()};
}

TEST(Intersect, BallStraightAhead) {
  Hit hit{};
  ASSERT_TRUE(intersect(ball(), ray_to({0.0F, 0.0F, 0.5F}, {2.0F, 0.0F, 0.5F}), hit));
  EXPECT_FLOAT_EQ(hit.distance, 1.5F);
  EXPECT_TRUE(hit.normal.isApprox(Eigen::Vector3f(-1.0F, 0.0F, 0.0F)));
}

TEST(Intersect, BallBehindOrBesideTheRay) {
  Hit hit{};
  EXPECT_FALSE(intersect(ball(), ray_to({0.0F, 0.0F, 0.5F}, {-1.0F, 0.0F, 0.5F}), hit));
  EXPECT_FALSE(intersect(ball(), ray_to({0.0F, 0.0F, 0.5F}, {2.0F, 0.52F, 0.5F}), hit));
  EXPECT_FALSE(intersect(ball(), ray_to({2.0F, 0.0F, 0.5F}, {3.0F, 0.0F, 0.5F}), hit));  // from inside
}

TEST(Intersect, BoxFromItsFrontItsSideAndAbove) {
  Hit hit{};
  ASSERT_TRUE(intersect(box(), ray_to({0.0F, 0.0F, 0.3F}, {1.0F, 0.0F, 0.3F}), hit));
  EXPECT_FLOAT_EQ(hit.distance, 1.0F);
  EXPECT_EQ(hit.normal, Eigen::Vector3f(-1.0F, 0.0F, 0.0F));
  ASSERT_TRUE(intersect(box(), ray_to({1.1F, 2.0F, 0.3F}, {1.1F, 0.0F, 0.3F}), hit));
  EXPECT_FLOAT_EQ(hit.distance, 1.5F);
  EXPECT_EQ(hit.normal, Eigen::Vector3f(0.0F, 1.0F, 0.0F));
  ASSERT_TRUE(intersect(box(), ray_to({1.1F, 0.0F, 1.6F}, {1.1F, 0.0F, 0.0F}), hit));
  EXPECT_FLOAT_EQ(hit.distance, 1.0F);
  EXPECT_EQ(hit.normal, Eigen::Vector3f(0.0F, 0.0F, 1.0F));
}

TEST(Intersect, CylinderSideBandAndTop) {
  Hit hit{};
  ASSERT_TRUE(intersect(cylinder(), ray_to({0.0F, 0.0F, 0.1F}, {0.0F, 3.0F, 0.1F}), hit));
  EXPECT_NEAR(hit.distance, 2.75F, 1e-5F);
  const int side = hit.face;
  ASSERT_TRUE(intersect(cylinder(), ray_to({0.0F, 0.0F, 0.4F}, {0.0F, 3.0F, 0.4F}), hit));
  EXPECT_NE(hit.face, side);  // the band
  ASSERT_TRUE(intersect(cylinder(), ray_to({0.0F, 3.0F, 2.0F}, {0.0F, 3.0F, 0.0F}), hit));
  EXPECT_NEAR(hit.distance, 1.2F, 1e-5F);
  EXPECT_EQ(hit.normal, Eigen::Vector3f(0.0F, 0.0F, 1.0F));
  EXPECT_FALSE(intersect(cylinder(), ray_to({0.0F, 0.0F, 0.9F}, {0.0F, 3.0F, 0.9F}), hit));  // over it
}

// Nothing that can be hit is ever left out.
TEST(BoundsOf, HoldEveryDirectionThatHits) {
  RandomStream random = make_stream(1, 1);
  std::uniform_real_distribution<float> place(-4.0F, 4.0F);
  std::normal_distribution<float> spread(0.0F, 0.4F);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    for (const Prop& prop : {ball(), box(), cylinder()}) {
      const Eigen::Vector3f eye(place(random), place(random), 0.25F);
      const Eigen::Vector3f towards = prop.centre + Eigen::Vector3f(spread(random), spread(random), spread(random));
      const Ray ray = ray_to(eye, towards);
      Hit hit{};
      if (!intersect(prop, ray, hit)) continue;
      ++hits;
      const float elevation = std::asin(ray.direction.z());
      const Bounds direction{std::atan2(ray.direction.y(), ray.direction.x()), 1e-4F, elevation - 1e-4F,
                             elevation + 1e-4F};
      EXPECT_TRUE(bounds_of(prop, eye).meets(direction))
          << "eye " << eye.transpose() << " ray " << ray.direction.transpose();
    }
  }
  EXPECT_GT(hits, 10000);
}

TEST(Bounds, AcrossTheCut) {
  const Bounds left{3.1F, 0.05F, -0.1F, 0.1F};
  const Bounds right{-3.1F, 0.05F, -0.1F, 0.1F};
  EXPECT_TRUE(left.meets(right));  // 0.083 apart, across ±π
  const Bounds ahead{0.0F, 1.0F, -0.1F, 0.1F};
  EXPECT_FALSE(left.meets(ahead));
  const Bounds above{3.1F, 0.05F, 0.2F, 0.3F};
  EXPECT_FALSE(left.meets(above));
}

// Tiles around the point straight below have every azimuth.
TEST(Bounds, AroundThePole) {
  Bounds tile{0.0F, 0.0F, -1.5F, -1.5F};
  for (const float azimuth : {0.0F, 1.5F, 3.0F, -1.5F}) {
    tile.include(Eigen::Vector3f(0.05F * std::cos(azimuth), 0.05F * std::sin(azimuth), -0.99875F));
  }
  EXPECT_TRUE(tile.meets({2.2F, 0.01F, -1.56F, -1.55F}));
}

}  // namespace
}  // namespace movis::sim
