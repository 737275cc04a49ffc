#include <gtest/gtest.h>

#include <cmath>

#include "localization/line_field.h"
#include "movis/calibration/curve_calibration.h"
#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "support/nubot.h"
#include "support/temporary_folder.h"

namespace movis::calibration {
namespace {

using Pixels = std::vector<Eigen::Vector2d>;

omni::Camera camera() {
  omni::Camera result;
  result.name = "omni";
  result.position = {0.0, 0.0, 0.8};
  result.width = 640;
  result.height = 480;
  result.model = omni::Radial{1.6, 0.007, 0.8, 320.0, 240.0, 218.0};
  return result;
}

const localization::FieldMap& map() {
  static const localization::FieldMap result(test::large_field());
  return result;
}

// Every third pixel that sees white from there.
Pixels picture(const omni::Camera& taken_by, const Pose2& truth) {
  Pixels pixels;
  for (int v = 0; v < 480; v += 3) {
    for (int u = 0; u < 640; u += 3) {
      const auto ray = unproject(taken_by, Eigen::Vector2d(u, v));
      if (!ray) continue;
      const Eigen::Vector2d in_world = truth * Eigen::Vector2d(0.8 / -ray->z() * ray->head<2>());
      if (test::is_white(map().field, in_world.x(), in_world.y())) pixels.emplace_back(u, v);
    }
  }
  return pixels;
}

// A drawing 4 % off in a, 2 % in b and some pixels beside the centre shows the lines bent; what took the picture is
// found again, as far as single pixels tell: the floor it sees is right to 3 cm within 4 m.
TEST(CurveCalibration, FindsWhatTookThePicture) {
  const Pose2 truth{-1.5, -4.0, 0.7};
  const Pixels pixels = picture(camera(), truth);
  omni::Camera drawing = camera();
  drawing.model = omni::Radial{1.6 * 1.04, 0.007 * 0.98, 0.8, 323.0, 238.0, 218.0};
  const CurveCalibration result = calibrate_curve(pixels, drawing, map());
  EXPECT_LT(result.after.median, 0.04);
  EXPECT_GT(result.before.median, 1.3 * result.after.median);
  EXPECT_NEAR(result.world_from_robot.x, truth.x, 0.04);
  EXPECT_NEAR(result.world_from_robot.y, truth.y, 0.04);
  const auto& model = std::get<omni::Radial>(result.camera.model);
  EXPECT_NEAR(model.u0, 320.0, 0.7);
  EXPECT_NEAR(model.v0, 240.0, 0.7);
  for (const double radius : {60.0, 100.0, 140.0, 170.0}) {  // to 4 m
    EXPECT_NEAR(model.a * std::tan(model.b * radius), 1.6 * std::tan(0.007 * radius), 0.03) << radius;
  }
}

TEST(CurveCalibration, AnotherFieldHasNoCurve) {
  const localization::FieldMap small(read_field(data_file("fields/paper.yaml")));
  const Pixels pixels = picture(camera(), {-1.5, -4.0, 0.7});
  test::expect_error([&] { calibrate_curve(pixels, camera(), small); }, {"no curve", "omni", "field"});
}

// A start 4 px beside the centre, which the pixels tell, of a camera whose centre is known to 0.5 px: 8 of its σ.
TEST(CurveCalibration, ChangesBeyondThePriorAreRefused) {
  const Pixels pixels = picture(camera(), {-1.5, -4.0, 0.7});
  omni::Camera start = camera();
  std::get<omni::Radial>(start.model).u0 += 4.0;
  EXPECT_NO_THROW(calibrate_curve(pixels, start, map()));
  CurveOptions options;
  options.sigma_centre_px = 0.5;
  test::expect_error([&] { calibrate_curve(pixels, start, map(), options); },
                     {"omni", "u0 changed by -", "more than 3 times the 0.5 px", "field"});
}

// A start of the right place whose lines keep bent: a tilt is nothing that the curve can undo.
TEST(CurveCalibration, TiltedCameraIsRefused) {
  omni::Camera tilted = camera();
  tilted.tilt_x = radians(4.0);
  const Pixels pixels = picture(tilted, {-1.5, -4.0, 0.7});
  test::expect_error([&] { calibrate_curve(pixels, camera(), map()); }, {"omni", "field"});
}

// A real robot's pixels on a field that is larger than its own.
TEST(CurveCalibration, RealRobotOnAnotherField) {
  MOVIS_NEEDS_SHARED_DATA(test::nubot_folder(1));
  const test::TemporaryFolder folder;
  const omni::Camera start = omni::read_rig(folder.write("rig.yaml", test::nubot_rig(1))).cameras[0];
  const localization::FieldMap large(read_field(data_file("fields/msl-22x14.yaml")));
  Pixels pixels;
  std::ifstream stream(test::nubot_folder(1) / "whites.txt");
  for (double u = 0.0, v = 0.0; stream >> u >> v;) pixels.emplace_back(u, v);
  test::expect_error([&] { calibrate_curve(pixels, start, large); }, {"omni", "field"});
}

TEST(CurveCalibration, TooFewPixels) {
  test::expect_error(
      [&] {
        calibrate_curve({{400.0, 240.0}}, camera(), map());
      },
      {"no curve", "no_landmark", "give more"});
  test::expect_error([&] { calibrate_curve({}, camera(), map()); }, {"no curve", "no_landmark", "give more"});
}

TEST(CurveCalibration, OnlyRadialCamerasHaveACurve) {
  omni::Camera other = camera();
  other.model = omni::UnifiedSphere{};
  test::expect_error([&] { calibrate_curve({{400.0, 240.0}}, other, map()); }, {"omni", "unified", "radial"});
}

// Fitted to one half of a real robot's pixels, the curve brings the other half nearer to the lines as well.
TEST(CurveCalibration, RealRobotHeldOut) {
  MOVIS_NEEDS_SHARED_DATA(test::nubot_folder(1));
  const test::TemporaryFolder folder;
  const omni::Camera start = omni::read_rig(folder.write("rig.yaml", test::nubot_rig(1))).cameras[0];
  const localization::FieldMap field(read_field(data_file("fields/msl-18x12.yaml")));
  Pixels used, held_out;
  std::ifstream stream(test::nubot_folder(1) / "whites.txt");
  int count = 0;
  for (double u = 0.0, v = 0.0; stream >> u >> v; ++count) (count % 2 == 0 ? used : held_out).emplace_back(u, v);
  const CurveCalibration result = calibrate_curve(used, start, field);
  const double before = median_distance(held_out, start, result.before.fix.world_from_robot, field);
  const double after = median_distance(held_out, result.camera, result.world_from_robot, field);
  EXPECT_LT(before, 0.040);
  EXPECT_LT(after, 0.035) << before;  // 3.1 cm is what filled lines leave by their width alone
}

}  // namespace
}  // namespace movis::calibration
