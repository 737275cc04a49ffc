// Known answers of the radial model, its files, and what deviations do to it. The suite over all models is in
// testCameraModel.
#include <gtest/gtest.h>

#include <cmath>

#include "movis/core/angle.h"
#include "movis/omni/deviation.h"
#include "movis/omni/rig.h"
#include "support/temporary_folder.h"

namespace movis::omni {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// b ρ = π/4 at ρ = 100, where tan = 1: a pixel 100 from the centre sees the floor a = 1.5 m away; at ρ = 200/3, where
// b ρ = π/6, a/√3.
Camera camera() {
  Camera result;
  result.name = "M1";
  result.position = {0.1, -0.2, 0.75};
  result.width = 500;
  result.height = 480;
  result.model = Radial{1.5, kPi / 400.0, 0.75, 250.0, 240.0};
  return result;
}

Vector2d on_floor(const Camera& seen_by, const Vector2d& pixel) {
  const auto ray = unproject(seen_by, pixel);
  if (!ray) return Vector2d::Constant(std::nan(""));
  return seen_by.position.head<2>() - seen_by.position.z() / ray->z() * ray->head<2>();
}

TEST(Radial, PixelsSeeTheFloorAtTheirDistance) {
  EXPECT_LT((on_floor(camera(), {350.0, 240.0}) - Vector2d(1.6, -0.2)).norm(), 1e-12);
  EXPECT_LT((on_floor(camera(), {250.0, 140.0}) - Vector2d(0.1, -1.7)).norm(), 1e-12);
  EXPECT_LT((on_floor(camera(), {250.0 - 200.0 / 3.0, 240.0}) - Vector2d(0.1 - 1.5 / std::sqrt(3.0), -0.2)).norm(),
            1e-12);
  EXPECT_LT((on_floor(camera(), {250.0, 240.0}) - Vector2d(0.1, -0.2)).norm(), 1e-12);
}

// tan φ = 1.5/0.75 = 2 at ρ = 100, whatever the ray's length.
TEST(Radial, ProjectsByTheAngleFromStraightDown) {
  const auto pixel = project(camera().model, Vector3d(0.0, 6.0, -3.0));
  ASSERT_TRUE(pixel);
  EXPECT_LT((*pixel - Vector2d(250.0, 340.0)).norm(), 1e-12);
}

// At the axis ρ = atan(h/a · x/−z)/b → (h/a)/(b |z|) x = 0.5/(π/400 · 2) x = 100/π x for z = −2.
TEST(Radial, JacobianStraightDown) {
  const auto projection = project_with_jacobian(camera().model, {0.0, 0.0, -2.0});
  ASSERT_TRUE(projection);
  EXPECT_EQ(projection->pixel, Vector2d(250.0, 240.0));
  PixelJacobian expected;
  expected << 100.0 / kPi, 0.0, 0.0, 0.0, 100.0 / kPi, 0.0;
  EXPECT_LT((projection->pixel_by_ray - expected).norm(), 1e-12);
}

TEST(Radial, NothingAtOrAboveTheHorizonNorBeyondItsRadius) {
  const CameraModel model = camera().model;
  EXPECT_FALSE(project(model, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(project(model, {1.0, 0.0, 0.1}));
  EXPECT_FALSE(project(model, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(project(model, {std::nan(""), 0.0, -1.0}));
  EXPECT_FALSE(project(model, {HUGE_VAL, 0.0, -1.0}));
  EXPECT_TRUE(unproject(model, {449.0, 240.0}));  // b ρ = π/2 at 200 pixels
  EXPECT_FALSE(unproject(model, {450.0, 240.0}));
  EXPECT_FALSE(unproject(model, {std::nan(""), 240.0}));
  Radial limited = std::get<Radial>(model);
  limited.max_radius_px = 99.0;
  EXPECT_FALSE(unproject(CameraModel(limited), {350.0, 240.0}));
  EXPECT_FALSE(project(CameraModel(limited), {0.0, 6.0, -3.0}));
  EXPECT_TRUE(project(CameraModel(limited), {0.0, 5.0, -3.0}));
}

// Raised by a third, the same pixel sees the floor a third farther: a belongs to the height.
TEST(Radial, MovedCameraKeepsItsMirror) {
  Deviation deviation = Deviation::Zero();
  deviation[2] = 0.25;
  const Camera moved = deviated(camera(), deviation);
  EXPECT_LT((on_floor(moved, {350.0, 240.0}) - Vector2d(2.1, -0.2)).norm(), 1e-12);
}

// A focal length 10 % longer enlarges the picture by 10 %, about a principal point that moves on its own.
TEST(Radial, LongerFocalLengthEnlargesThePicture) {
  Deviation deviation = Deviation::Zero();
  deviation[6] = 0.1;
  deviation[7] = 2.0;
  deviation[8] = -1.0;
  const Camera longer = deviated(camera(), deviation);
  EXPECT_LT((on_floor(longer, {362.0, 239.0}) - Vector2d(1.6, -0.2)).norm(), 1e-12);
}

TEST(Radial, WritesWhatItReads) {
  const test::TemporaryFolder folder;
  Camera limited = camera();
  limited.name = "M2";
  std::get<Radial>(limited.model).max_radius_px = 197.3;
  write_rig({{camera(), limited}}, folder.path() / "rig.yaml");
  const Rig read = read_rig(folder.path() / "rig.yaml");
  ASSERT_EQ(read.cameras.size(), 2U);
  const Radial& first = std::get<Radial>(read.cameras[0].model);
  EXPECT_EQ(first.a, 1.5);
  EXPECT_EQ(first.b, kPi / 400.0);
  EXPECT_EQ(first.u0, 250.0);
  EXPECT_EQ(first.v0, 240.0);
  EXPECT_EQ(first.height, 0.75);
  EXPECT_TRUE(std::isinf(first.max_radius_px));
  EXPECT_EQ(std::get<Radial>(read.cameras[1].model).max_radius_px, 197.3);
}

// The file's a is for the height that stands in it: the same rays, in any case.
TEST(Radial, WritesAMovedCamera) {
  const test::TemporaryFolder folder;
  Deviation deviation = Deviation::Zero();
  deviation[2] = 0.25;
  write_rig({{deviated(camera(), deviation)}}, folder.path() / "rig.yaml");
  const Camera read = read_rig(folder.path() / "rig.yaml").cameras[0];
  EXPECT_DOUBLE_EQ(std::get<Radial>(read.model).a, 2.0);
  EXPECT_LT((on_floor(read, {350.0, 240.0}) - Vector2d(2.1, -0.2)).norm(), 1e-12);
}

TEST(Radial, BadFilesAreNamed) {
  const test::TemporaryFolder folder;
  const auto expect_named = [&](const std::string& model, const char* z, std::initializer_list<const char*> parts) {
    const auto file = folder.write("rig.yaml", std::string("cameras:\n- name: M1\n  position: [0, 0, ") + z +
                                                   "]\n  yaw_deg: 0\n  tilt_deg: [0, 0]\n"
                                                   "  image: {width: 500, height: 480}\n" +
                                                   model);
    test::expect_error([&] { read_rig(file); }, parts);
  };
  const std::string good = "  model: radial\n  radial: {a: 1.5, b: 0.007, u0: 250, v0: 240}\n";
  expect_named(good, "0", {"rig.yaml", "position", "above it"});
  expect_named(good, "0.009", {"rig.yaml", "position", "above it"});
  expect_named(good + "  pinhole: {fu: 1, fv: 1, u0: 0, v0: 0}\n", "1", {"pinhole", "beside `model: radial`"});
  expect_named("  model: unified\n  radial: {a: 1.5, b: 0.007, u0: 250, v0: 240}\n", "1", {"radial", "beside"});
  expect_named("  model: radial\n", "1", {"radial"});
  expect_named("  model: radial\n  radial: {a: 1.5, u0: 250, v0: 240}\n", "1", {"b"});
  expect_named("  model: radial\n  radial: {a: -1.5, b: 0.007, u0: 250, v0: 240}\n", "1", {"a"});
  expect_named("  model: radial\n  radial: {a: 1.5, b: 0.007, u0: 250, v0: 240, max_radius: 9}\n", "1", {"max_radius"});
}

}  // namespace
}  // namespace movis::omni
