#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "movis/core/angle.h"
#include "movis/omni/rig.h"
#include "support/temporary_folder.h"

namespace movis::omni {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::expect_error;
using test::TemporaryFolder;

std::string camera_text(const std::string& name) {
  return "- name: " + name +
         "\n  position: [-0.1732, 0.1, 0.25]\n  yaw_deg: 330\n  tilt_deg: [0.5, -1.0]\n"
         "  image: {width: 640, height: 480}\n  model: hyperboloid\n"
         "  hyperboloid: {a: 0.028095, b: 0.0234125, rim_radius: 0.0275}\n"
         "  pinhole: {fu: 660, fv: 660, u0: 319.5, v0: 239.5}\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(RigFile, ReadsACamera) {
  const TemporaryFolder folder;
  const Rig rig = read_rig(folder.write("rig.yaml", "cameras:\n" + camera_text("M1") + camera_text("M2")));
  ASSERT_EQ(rig.cameras.size(), 2U);
  EXPECT_EQ(rig.cameras[1].name, "M2");
  EXPECT_NEAR(rig.cameras[0].yaw, radians(-30.0), 1e-12);
  EXPECT_NEAR(rig.cameras[0].tilt_x, radians(0.5), 1e-12);
  EXPECT_NEAR(rig.cameras[0].tilt_y, radians(-1.0), 1e-12);
  EXPECT_DOUBLE_EQ(std::get<Hyperboloid>(rig.cameras[0].model).a, 0.028095);
}

TEST(RigFile, ErrorsNameFileLineAndKey) {
  const TemporaryFolder folder;
  const std::string good = "cameras:\n" + camera_text("M1");
  const auto reading = [&](const std::string& text) {
    return [&folder, text] { read_rig(folder.write("rig.yaml", text)); };
  };
  expect_error(reading(replaced(good, "a: 0.028095", "a: 0")), {"rig.yaml:8", "cameras[0].hyperboloid.a", "range"});
  expect_error(reading(replaced(good, "a: 0.028095", "a: -0.02")), {"rig.yaml:8", "hyperboloid.a", "range"});
  expect_error(reading(replaced(good, "a: 0.028095", "a: 28.095")), {"rig.yaml:8", "hyperboloid.a", "SI units"});
  expect_error(reading(replaced(good, "yaw_deg", "yaw")), {"rig.yaml:4", "'yaw'", "yaw_deg"});
  expect_error(reading(replaced(good, "yaw_deg: 330\n", "\n")), {"yaw_deg", "missing"});
  expect_error(reading(replaced(good, "hyperboloid\n", "spherical\n")), {"rig.yaml:7", "model", "one of: hyperboloid"});
  expect_error(reading(replaced(good, "[0.5, -1.0]", "[0.5]")), {"rig.yaml:5", "tilt_deg", "2 numbers"});
  expect_error(reading(replaced(good, "width: 640", "width: 640.5")), {"image.width", "whole number"});
  expect_error(reading(good + camera_text("M1")), {"rig.yaml:10", "name", "own"});
  expect_error(reading("cameras: []\n"), {"lists no camera"});
  expect_error(reading("cameras: 3\n"), {"rig.yaml:1", "cameras", "list"});
}

// A camera tilted by Rx(tilt_x) alone sees the robot's z axis along its own (0, sin, cos): z_c = R^T e_z.
TEST(Rig, TiltAndYawTurnRaysAsDesigned) {
  Camera camera;
  camera.tilt_x = radians(10.0);
  const Vector3d up_in_camera = camera.robot_from_camera().transpose() * Vector3d::UnitZ();
  EXPECT_TRUE(up_in_camera.isApprox(Vector3d(0.0, std::sin(radians(10.0)), std::cos(radians(10.0))), 1e-12));
  // yaw is applied last: camera x turns towards the robot's y.
  camera = Camera();
  camera.yaw = radians(90.0);
  EXPECT_TRUE((camera.robot_from_camera() * Vector3d::UnitX()).isApprox(Vector3d::UnitY(), 1e-12));
}

// Points of the robot frame onto pixels and back, with offset, yaw and tilt in both axes.
TEST(Rig, RoundTripWithTiltAndOffset) {
  const TemporaryFolder folder;
  const Rig rig = read_rig(folder.write("rig.yaml", "cameras:\n" + camera_text("M1")));
  const Camera& camera = rig.cameras[0];
  int seen = 0;
  for (double x = -4.0; x <= 4.0; x += 0.8) {
    for (double y = -4.0; y <= 4.0; y += 0.8) {
      const Vector3d point(x, y, 0.11);
      const auto pixel = project(camera, point);
      if (!pixel) continue;
      ++seen;
      const auto ray = unproject(camera, *pixel);
      ASSERT_TRUE(ray);
      EXPECT_LT((*ray - (point - camera.position).normalized()).norm(), 1e-10);
    }
  }
  EXPECT_GT(seen, 100);
}

// Image u grows along camera x and v along camera y: with yaw −30° a point at the robot azimuth −30° lies at v = v0,
// to the right of the centre.
TEST(Rig, ImageAxesFollowTheCameraFrame) {
  Camera camera;
  camera.yaw = radians(-30.0);
  camera.width = 640;
  camera.height = 480;
  camera.model = Hyperboloid{0.028095, 0.0234125, 0.0275, 660.0, 660.0, 319.5, 239.5};
  const auto pixel = project(camera, Vector3d(std::cos(radians(-30.0)), std::sin(radians(-30.0)), -0.2));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->y(), 239.5, 1e-9);
  EXPECT_GT(pixel->x(), 400.0);
}

}  // namespace
}  // namespace movis::omni
