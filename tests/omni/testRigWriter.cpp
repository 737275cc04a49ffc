#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iterator>

#include "movis/core/angle.h"
#include "movis/core/random.h"
#include "movis/omni/deviation.h"
#include "movis/omni/rig.h"
#include "support/temporary_folder.h"

namespace movis::omni {
namespace {

using test::expect_error;
using test::TemporaryFolder;

Camera mirror_camera(const std::string& name) {
  Camera camera;
  camera.name = name;
  camera.position = {-0.1 / 3.0, 0.2 / 7.0, 0.25};
  camera.yaw = -kPi / 7.0;
  camera.tilt_x = 0.1 / 9.0;
  camera.tilt_y = -0.02 / 3.0;
  camera.width = 640;
  camera.height = 480;
  camera.model = Hyperboloid{0.028095, 0.0234125, 0.0275, 2000.0 / 3.0, 661.0 / 7.0, 319.5 + 1e-13, -0.1 / 3.0};
  return camera;
}

Camera sphere_camera(const std::string& name) {
  Camera camera = mirror_camera(name);
  UnifiedSphere sphere{1.0 / 1.1, 300.0 / 7.0, 310.0, 320.1, 240.2};
  sphere.k1 = -0.1 / 3.0;
  sphere.k2 = 1e-17;
  sphere.p1 = -1e-4 / 3.0;
  sphere.p2 = 2e-5;
  sphere.skew = 1e-3 / 7.0;
  sphere.max_elevation = radians(44.0) / 1.01;
  camera.model = sphere;
  camera.format = PixelFormat::bayer_grbg8;
  return camera;
}

void expect_same(const Camera& read, const Camera& written) {
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.position, written.position);
  // radians() of no number of degrees may be the last bit of an angle.
  EXPECT_DOUBLE_EQ(read.yaw, written.yaw);
  EXPECT_DOUBLE_EQ(read.tilt_x, written.tilt_x);
  EXPECT_DOUBLE_EQ(read.tilt_y, written.tilt_y);
  EXPECT_EQ(read.width, written.width);
  EXPECT_EQ(read.height, written.height);
  EXPECT_EQ(read.format, written.format);
  EXPECT_EQ(read.mask, written.mask);
  ASSERT_EQ(read.model.index(), written.model.index());
  if (const auto* mirror = std::get_if<Hyperboloid>(&written.model)) {
    const auto& other = std::get<Hyperboloid>(read.model);
    EXPECT_EQ(other.a, mirror->a);
    EXPECT_EQ(other.b, mirror->b);
    EXPECT_EQ(other.rim_radius, mirror->rim_radius);
    EXPECT_EQ(other.fu, mirror->fu);
    EXPECT_EQ(other.fv, mirror->fv);
    EXPECT_EQ(other.u0, mirror->u0);
    EXPECT_EQ(other.v0, mirror->v0);
  } else {
    const auto& sphere = std::get<UnifiedSphere>(written.model);
    const auto& other = std::get<UnifiedSphere>(read.model);
    EXPECT_EQ(other.xi, sphere.xi);
    EXPECT_EQ(other.fu, sphere.fu);
    EXPECT_EQ(other.fv, sphere.fv);
    EXPECT_EQ(other.u0, sphere.u0);
    EXPECT_EQ(other.v0, sphere.v0);
    EXPECT_EQ(other.k1, sphere.k1);
    EXPECT_EQ(other.k2, sphere.k2);
    EXPECT_EQ(other.p1, sphere.p1);
    EXPECT_EQ(other.p2, sphere.p2);
    EXPECT_EQ(other.skew, sphere.skew);
    EXPECT_DOUBLE_EQ(other.max_elevation, sphere.max_elevation);
  }
}

void expect_round_trip(const Rig& rig, const std::filesystem::path& file) {
  write_rig(rig, file);
  const Rig read = read_rig(file);
  ASSERT_EQ(read.cameras.size(), rig.cameras.size());
  for (std::size_t k = 0; k < rig.cameras.size(); ++k) expect_same(read.cameras[k], rig.cameras[k]);
}

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(RigWriter, EveryModelRoundTrip) {
  const TemporaryFolder folder;
  expect_round_trip({{mirror_camera("M1"), sphere_camera("M2")}}, folder.path() / "rig.yaml");
}

TEST(RigWriter, DrawnRigsRoundTrip) {
  const TemporaryFolder folder;
  RandomStream random = make_stream(1, 1);
  for (int i = 0; i < 50; ++i) {
    const Rig nominal{{mirror_camera("M1"), mirror_camera("M2"), sphere_camera("M3")}};
    expect_round_trip(draw_rig(nominal, individual_differences(), random), folder.path() / "rig.yaml");
  }
}

// What came from a file, in degrees, comes back to the last bit, and as a person wrote it.
TEST(RigWriter, DegreesOfAFileStayThemselves) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rig.yaml";
  for (const double yaw_deg : {-30.0, -150.0, 90.0, 0.1, 12.345678901234567, 179.9, 1e-9}) {
    Camera camera = mirror_camera("M1");
    camera.yaw = radians(yaw_deg);
    write_rig({{camera}}, file);
    EXPECT_EQ(read_rig(file).cameras[0].yaw, camera.yaw) << yaw_deg;
    EXPECT_NE(content(file).find(fmt::format("yaw_deg: {}\n", yaw_deg)), std::string::npos) << content(file);
  }
}

TEST(RigWriter, ZeroHasNoSign) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rig.yaml";
  for (const double zero : {0.0, -0.0}) {
    Camera camera = mirror_camera("M1");
    camera.yaw = camera.tilt_x = camera.tilt_y = zero;
    write_rig({{camera}}, file);
    EXPECT_NE(content(file).find("yaw_deg: 0\n  tilt_deg: [0, 0]\n"), std::string::npos) << content(file);
  }
}

TEST(RigWriter, UncommonNames) {
  const TemporaryFolder folder;
  for (const char* name : {"null", "front: left", "#1", "- x", "a\"b\\c", "007", "kamera süd", "~", " two "}) {
    expect_round_trip({{mirror_camera(name)}}, folder.path() / "rig.yaml");
  }
}

TEST(RigWriter, Masks) {
  const TemporaryFolder folder;
  Camera camera = mirror_camera("M1");
  camera.mask = folder.path() / "masks" / "m 1.png";
  const auto file = folder.path() / "rig.yaml";
  expect_round_trip({{camera}}, file);
  EXPECT_NE(content(file).find("mask: \"masks/m 1.png\"\n"), std::string::npos) << content(file);
  camera.mask = "/somewhere/else/mask.png";
  expect_round_trip({{camera}}, file);
}

TEST(RigWriter, CommentsHeadTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "rig.yaml";
  write_rig({{mirror_camera("M1")}}, file, {"one: 1", "", "two"});
  EXPECT_EQ(content(file).rfind("# one: 1\n#\n# two\ncameras:\n", 0), 0U) << content(file);
  EXPECT_EQ(read_rig(file).cameras.size(), 1U);
}

TEST(RigWriter, FolderThatIsAbsent) {
  const TemporaryFolder folder;
  expect_error([&] { write_rig({{mirror_camera("M1")}}, folder.path() / "absent" / "rig.yaml"); },
               {"absent", "does not exist"});
}

}  // namespace
}  // namespace movis::omni
