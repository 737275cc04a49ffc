#include <gtest/gtest.h>

#include <cstring>

#include "eye.h"
#include "movis/core/error.h"
#include "movis/scan/scanner.h"
#include "support/temporary_folder.h"

namespace movis::scan {
namespace {

using test::expect_error;

// M1 at the origin and another camera's sensor unit, 0.35 m away at the azimuth 60°.
omni::Rig rig_of_two() {
  omni::Rig rig;
  rig.cameras = {hyperboloid_camera(), hyperboloid_camera()};
  rig.cameras[1].name = "M2";
  rig.cameras[1].position.head<2>() = floor_point(rig.cameras[0], radians(60.0), 0.35);
  return rig;
}

std::vector<Bearing> scan_once(Scanner& scanner, const ImageView& image) {
  std::vector<Bearing> bearings;
  scanner.scan(image, 0.0, bearings);
  return bearings;
}

void expect_same(const Bearing& a, const Bearing& b) {
  EXPECT_EQ(a.object, b.object);
  EXPECT_EQ(a.azimuth, b.azimuth);
  EXPECT_EQ(a.elevation, b.elevation);
  EXPECT_EQ(a.left, b.left);
  EXPECT_EQ(a.right, b.right);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.weight, b.weight);
  EXPECT_EQ(a.flags, b.flags);
}

// Another channel order: what 0, 1, 2 and perhaps 3 of a pixel are of B, G, R.
std::vector<std::uint8_t> reordered(const Picture& picture, int channels) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
    for (int c = 0; c < 3; ++c) bytes.push_back(picture.bytes[i + 2 - c]);
    if (channels == 4) bytes.push_back(77);
  }
  return bytes;
}

Wall goal_face(const omni::Camera& camera, double azimuth, double range, double half_width, const Light3& colour) {
  const Vector2d middle = floor_point(camera, azimuth, range);
  const Vector2d to_left(-std::sin(azimuth), std::cos(azimuth));
  return {middle - half_width * to_left, middle + half_width * to_left, 0.0, 0.45, colour};
}

TEST(Scanner, BearingsSayWhoSawWhatAndWhen) {
  const omni::Rig rig = rig_of_two();
  Scanner scanner(rig, 1, scene_colours(), {});
  const omni::Camera& camera = rig.cameras[1];
  const Picture picture = OmniRenderer(camera).render(
      {{ball_at(camera, 0.3, 1.2)},
       {goal_face(camera, 2.0, 2.0, 0.5, kBlue), goal_face(camera, -2.0, 2.0, 0.5, kYellow)}});
  std::vector<Bearing> bearings(1);
  scanner.scan(picture.view, 12.5, bearings);
  ASSERT_EQ(bearings.size(), 4U);  // appended
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(bearings[i].camera, 1);
    EXPECT_EQ(bearings[i].time_s, 12.5);
    EXPECT_GT(bearings[i].weight, 0.0);
  }
  EXPECT_EQ(bearings[1].object, ObjectClass::ball);
  EXPECT_NEAR(bearings[1].azimuth, 0.3, radians(0.1));
  EXPECT_EQ(bearings[2].object, ObjectClass::yellow_goal);
  EXPECT_NEAR(bearings[2].azimuth, -2.0, radians(0.1));
  EXPECT_EQ(bearings[3].object, ObjectClass::blue_goal);
  EXPECT_NEAR(bearings[3].azimuth, 2.0, radians(0.1));
}

TEST(Scanner, NothingThereNoBearing) {
  Eye eye(hyperboloid_camera());
  EXPECT_TRUE(eye.scan(eye.render({})).empty());
  const auto goal_only = eye.scan(eye.render({{}, {goal_face(eye.camera(), 1.0, 2.0, 0.5, kYellow)}}));
  ASSERT_EQ(goal_only.size(), 1U);
  EXPECT_EQ(goal_only[0].object, ObjectClass::yellow_goal);
}

TEST(Scanner, OfTwoBallsTheLarger) {
  Eye eye(hyperboloid_camera());
  for (const double azimuth : {-3.1, 0.0, 1.5}) {
    const Ball near = ball_at(eye.camera(), azimuth, 1.0);
    const Ball far = ball_at(eye.camera(), azimuth + 1.0, 1.6);
    for (const std::vector<Ball>& balls : {std::vector<Ball>{near, far}, {far, near}}) {
      const auto bearings = eye.scan(eye.render({balls, {}}));
      ASSERT_EQ(bearings.size(), 1U);
      EXPECT_NEAR(turn(azimuth, bearings[0].azimuth), 0.0, radians(0.02));
    }
  }
}

// The light fails and comes back: nothing is remembered from image to image.
TEST(Scanner, LostColour) {
  Eye eye(hyperboloid_camera());
  Ball ball = ball_at(eye.camera(), 0.5, 1.0);
  const Picture bright = eye.render({{ball}, {}});
  ball.colour = 0.02 * kOrange;  // below the class's brightness
  const Picture dark = eye.render({{ball}, {}});
  const auto before = eye.scan(bright);
  ASSERT_EQ(before.size(), 1U);
  EXPECT_TRUE(eye.scan(dark).empty());
  const auto after = eye.scan(bright);
  ASSERT_EQ(after.size(), 1U);
  expect_same(before[0], after[0]);
}

TEST(Scanner, EveryColourFormatAlike) {
  const omni::Camera camera = hyperboloid_camera();
  Scanner scanner({{camera}}, 0, scene_colours(), {});
  const Picture picture =
      OmniRenderer(camera).render({{ball_at(camera, 0.3, 1.2)}, {goal_face(camera, 2.0, 2.0, 0.5, kBlue)}});
  const auto expected = scan_once(scanner, picture.view);
  ASSERT_EQ(expected.size(), 2U);
  for (const PixelFormat format : {PixelFormat::rgb8, PixelFormat::rgba8}) {
    const auto bytes = reordered(picture, channels(format));
    const auto bearings = scan_once(scanner, {bytes.data(), 640, 480, 640 * channels(format), format});
    ASSERT_EQ(bearings.size(), 2U) << name(format);
    for (std::size_t i = 0; i < 2; ++i) expect_same(bearings[i], expected[i]);
  }
}

// The other unit of 0.03 m radius covers 60° ± asin(0.03/0.35); a ball at 1 m reaches asin(0.11/1) to its sides.
TEST(Scanner, BallNearASensorUnitIsFlagged) {
  const omni::Rig rig = rig_of_two();
  Scanner scanner(rig, 0, scene_colours(), {});
  const OmniRenderer renderer(rig.cameras[0]);
  const double touching = std::asin(0.03 / 0.35) + std::asin(0.11);
  for (const double side : {-1.0, 1.0}) {
    for (const double beyond_deg : {-10.0, -0.5, 0.5, 20.0}) {
      const double azimuth = radians(60.0) + side * (touching + radians(beyond_deg));
      const auto bearings = scan_once(scanner, renderer.render({{ball_at(rig.cameras[0], azimuth, 1.0)}, {}}).view);
      ASSERT_EQ(bearings.size(), 1U);
      EXPECT_EQ(bearings[0].flags, beyond_deg < 0.0 ? kNearSensor : 0) << side << " " << beyond_deg;
    }
  }
  Scanner alone({{rig.cameras[0]}}, 0, scene_colours(), {});
  const Picture picture = renderer.render({{ball_at(rig.cameras[0], radians(60.0), 1.0)}, {}});
  ASSERT_EQ(scan_once(alone, picture.view).size(), 1U);
  EXPECT_EQ(scan_once(alone, picture.view)[0].flags, 0);
}

// A sensor unit before the middle of a goal does no harm, before an edge it does.
TEST(Scanner, GoalsEdgeNearASensorUnitIsFlagged) {
  const omni::Rig rig = rig_of_two();
  Scanner scanner(rig, 0, scene_colours(), {});
  const OmniRenderer renderer(rig.cameras[0]);
  const double half_width = std::atan(0.5 / 2.0);
  const auto flags_at = [&](double azimuth) {
    const auto bearings =
        scan_once(scanner, renderer.render({{}, {goal_face(rig.cameras[0], azimuth, 2.0, 0.5, kYellow)}}).view);
    EXPECT_EQ(bearings.size(), 1U);
    return bearings.empty() ? -1 : static_cast<int>(bearings[0].flags);
  };
  EXPECT_EQ(flags_at(radians(60.0)), 0);
  EXPECT_EQ(flags_at(radians(60.0) + half_width), kNearSensor);
  EXPECT_EQ(flags_at(radians(60.0) - half_width), kNearSensor);
  EXPECT_EQ(flags_at(radians(110.0)), 0);
}

// Salt: every hundredth pixel has some colour, none of them the ball's.
TEST(Scanner, SaltOfOtherColours) {
  Eye eye(hyperboloid_camera());
  RandomStream stream = make_stream(1, 2);
  const auto salt = [&](Picture& picture) {
    const std::uint8_t colours[][3] = {{60, 200, 40}, {255, 255, 255}, {0, 0, 0}, {200, 60, 190}, {200, 190, 20}};
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
      if (stream() % 100 == 0) std::memcpy(picture.bytes.data() + i, colours[stream() % 5], 3);
    }
  };
  Picture empty = eye.render({});
  salt(empty);
  EXPECT_TRUE(eye.scan(empty).empty());
  for (int i = 0; i < 12; ++i) {
    const Ball ball = ball_at(eye.camera(), 0.5 * i, 1.0 + 0.2 * i);
    Picture picture = eye.render({{ball}, {}});
    salt(picture);
    const auto bearings = eye.scan(picture);
    ASSERT_EQ(bearings.size(), 1U);
    EXPECT_NEAR(turn(0.5 * i, bearings[0].azimuth), 0.0, radians(0.05)) << i;
    EXPECT_NEAR(bearings[0].elevation, elevation_from(eye.camera(), ball.centre), radians(0.1)) << i;
  }
}

// Salt of the ball's own colour, one pixel in five hundred: scattered over all azimuths it is noise to the histogram
// (§2.3), makes no ball and does not move one.
TEST(Scanner, SaltOfTheBallsColour) {
  Eye eye(hyperboloid_camera());
  RandomStream stream = make_stream(1, 3);
  const auto salt = [&](Picture& picture) {
    const std::uint8_t orange[3] = {20, 110, 230};
    for (std::size_t i = 0; i < picture.bytes.size(); i += 3) {
      if (stream() % 500 == 0) std::memcpy(picture.bytes.data() + i, orange, 3);
    }
  };
  int invented = 0;
  double azimuth_error = 0.0;
  double elevation_error = 0.0;
  for (int i = 0; i < 12; ++i) {
    Picture empty = eye.render({});
    salt(empty);
    invented += static_cast<int>(eye.scan(empty).size());
    const Ball ball = ball_at(eye.camera(), 0.5 * i, 1.0 + 0.2 * i);
    Picture picture = eye.render({{ball}, {}});
    salt(picture);
    const auto bearings = eye.scan(picture);
    ASSERT_EQ(bearings.size(), 1U);
    azimuth_error = std::max(azimuth_error, std::abs(turn(0.5 * i, bearings[0].azimuth)));
    elevation_error =
        std::max(elevation_error, std::abs(bearings[0].elevation - elevation_from(eye.camera(), ball.centre)));
  }
  EXPECT_EQ(invented, 0) << "balls in 12 pictures without one";
  EXPECT_LT(degrees(azimuth_error), 0.05);
  EXPECT_LT(degrees(elevation_error), 0.2);
}

// The histogram of the last scan is the paper's Fig. 4: the ball's pixels at the ball's azimuths.
TEST(Scanner, HistogramOfTheLastScan) {
  const omni::Camera camera = hyperboloid_camera();
  Scanner scanner({{camera}}, 0, scene_colours(), {});
  const auto bearings = scan_once(scanner, OmniRenderer(camera).render({{ball_at(camera, 0.7, 0.8)}, {}}).view);
  ASSERT_EQ(bearings.size(), 1U);
  const Histogram& histogram = scanner.histogram(ObjectClass::ball);
  const int bins = static_cast<int>(histogram.counts.size());
  ASSERT_EQ(bins, ScanOptions{}.bins);
  double pixels = 0.0;
  for (int bin = 0; bin < bins; ++bin) {
    const double azimuth = -kPi + (bin + 0.5) * 2.0 * kPi / bins;
    const bool beside = std::abs(azimuth - 0.7) > std::asin(0.11 / 0.8) + radians(1.0);
    EXPECT_TRUE(!beside || histogram.counts[bin] == 0) << bin;
    pixels += histogram.counts[bin];
  }
  EXPECT_NEAR(pixels, bearings[0].weight, 0.1 * bearings[0].weight);
  for (const std::uint32_t count : scanner.histogram(ObjectClass::yellow_goal).counts) EXPECT_EQ(count, 0U);
}

TEST(Scanner, ImageOfAnotherSizeIsAnError) {
  Scanner scanner({{hyperboloid_camera()}}, 0, scene_colours(), {});
  const std::vector<std::uint8_t> bytes(3 * 640 * 480);
  expect_error(
      [&] {
        scan_once(scanner, {bytes.data(), 639, 480, 1920, PixelFormat::bgr8});
      },
      {"'M1'", "639×480", "640×480"});
  expect_error(
      [&] {
        scan_once(scanner, {bytes.data(), 640, 479, 1920, PixelFormat::bgr8});
      },
      {"'M1'", "640×479", "640×480"});
}

TEST(Scanner, ImageOfAnotherFormatThanTheRigSaysIsAnError) {
  omni::Camera camera = hyperboloid_camera();
  camera.format = PixelFormat::rgb8;
  Scanner scanner({{camera}}, 0, scene_colours(), {});
  const std::vector<std::uint8_t> bytes(3 * 640 * 480);
  expect_error(
      [&] {
        scan_once(scanner, {bytes.data(), 640, 480, 1920, PixelFormat::bgr8});
      },
      {"'M1'", "BGR8", "RGB8"});
  EXPECT_NO_THROW(scan_once(scanner, {bytes.data(), 640, 480, 1920, PixelFormat::rgb8}));
}

// Where the rig does not insist on a format, any with colours will do.
TEST(Scanner, ImageWithoutColoursIsAnError) {
  Scanner scanner({{hyperboloid_camera()}}, 0, scene_colours(), {});
  const std::vector<std::uint8_t> bytes(640 * 480);
  for (const PixelFormat format : {PixelFormat::mono8, PixelFormat::bayer_rggb8}) {
    expect_error([&] { scan_once(scanner, {bytes.data(), 640, 480, 640, format}); }, {"'M1'", name(format), "convert"});
  }
}

TEST(Scanner, CameraThatTheRigHasNotThrows) {
  EXPECT_ANY_THROW(Scanner(rig_of_two(), 2, scene_colours(), {}));
  EXPECT_ANY_THROW(Scanner(rig_of_two(), -1, scene_colours(), {}));
}

}  // namespace
}  // namespace movis::scan
