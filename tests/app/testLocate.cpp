// `movis locate` as a user runs it: on pixels of known poses, on real robots' pixels, and on files that are wrong. What
// the files may hold is tested on their reader, as each run of the program costs more than the reading.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "line_pixels.h"
#include "localization/line_field.h"
#include "movis/core/paths.h"
#include "movis/omni/rig.h"
#include "support/nubot.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRig =
    "cameras:\n- name: omni\n  position: [0, 0, 0.8]\n  yaw_deg: 0\n  tilt_deg: [0, 0]\n"
    "  image: {width: 640, height: 480}\n  model: radial\n"
    "  radial: {a: 1.6, b: 0.007, u0: 320, v0: 240, max_radius_px: 218}\n";

class Locate : public testing::Test {
 protected:
  test::ProgramRun locate(const fs::path& points, const std::string& more = "", const std::string& field = "") const {
    return test::run_program(fmt::format("{} locate --points {} --rig {} --field {} {}", MOVIS_PROGRAM, points.string(),
                                         (folder_.path() / "rig.yaml").string(),
                                         field.empty() ? data_file("fields/msl-18x12.yaml").string() : field, more));
  }

  static std::map<std::string, std::string> values(const test::ProgramRun& run) {
    std::map<std::string, std::string> result;
    std::istringstream stream(run.output);
    for (std::string name, value; stream >> name >> value;) result[name] = value;
    return result;
  }

  void expect_failure(const std::string& points, int exit_code, std::initializer_list<const char*> parts,
                      const std::string& more = "") const {
    const test::ProgramRun run = locate(folder_.write("points.txt", points), more);
    EXPECT_EQ(run.exit_code, exit_code) << run.output;
    for (const char* part : parts) EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
  }

  omni::Camera camera() const { return omni::read_rig(rig_).cameras[0]; }

  void expect_bad(const std::string& points, std::initializer_list<const char*> parts) const {
    const fs::path file = folder_.write("points.txt", points);
    test::expect_error([&] { app::read_line_pixels(file, camera()); }, parts);
  }

  // Every third white pixel of a picture taken from there.
  fs::path picture_from(const Pose2& truth) const {
    const Field field = test::large_field();
    const omni::Camera camera = this->camera();
    std::string text = "# column row\n";
    for (int v = 0; v < 480; v += 3) {
      for (int u = 0; u < 640; u += 3) {
        const auto ray = unproject(camera, Eigen::Vector2d(u, v));
        if (!ray) continue;
        const Eigen::Vector2d in_world = truth * Eigen::Vector2d(0.8 / -ray->z() * ray->head<2>());
        if (test::is_white(field, in_world.x(), in_world.y())) text += fmt::format("{}\t{}  # white\r\n", u, v);
      }
    }
    return folder_.write("picture.txt", text);
  }

  const test::TemporaryFolder folder_;
  const fs::path rig_ = folder_.write("rig.yaml", kRig);
};

TEST_F(Locate, FindsThePoseOfAPicture) {
  const test::ProgramRun run = locate(picture_from({-1.5, -3.0, radians(40.0)}));
  ASSERT_EQ(run.exit_code, 0) << run.output;
  auto found = values(run);
  ASSERT_EQ(found["status"], "ok") << run.output;
  EXPECT_NEAR(std::stod(found["x"]), -1.5, 0.03);
  EXPECT_NEAR(std::stod(found["y"]), -3.0, 0.03);
  EXPECT_NEAR(std::stod(found["beta_deg"]), 40.0, 0.5);
  EXPECT_LT(std::stod(found["median_m"]), 0.05);
  EXPECT_GT(std::stod(found["within_15cm"]), 0.95);
  EXPECT_EQ(found["symmetric"], "true");
}

TEST_F(Locate, GuessPicksTheHalf) {
  const fs::path picture = picture_from({-1.5, -3.0, radians(40.0)});
  auto near = values(locate(picture, "--guess -1.3,-3.2,45"));
  EXPECT_NEAR(std::stod(near["y"]), -3.0, 0.03);
  auto turned = values(locate(picture, "--guess 1.3,3.2,-135"));
  EXPECT_NEAR(std::stod(turned["y"]), 3.0, 0.03);
  EXPECT_NEAR(std::stod(turned["beta_deg"]), -140.0, 0.5);
}

TEST_F(Locate, GuessFarOutsideOfTheField) {
  const test::ProgramRun run = locate(picture_from({-1.5, -3.0, radians(40.0)}), "--guess 5000,5000,0");
  auto found = values(run);
  EXPECT_EQ(found["status"], "bad_fit") << run.output;
  EXPECT_EQ(found.count("median_m"), 0U) << run.output;
}

TEST_F(Locate, ByteOrderMark) {
  const auto pixels = app::read_line_pixels(folder_.write("points.txt",
                                                          "\xEF\xBB\xBF"
                                                          "100 200\n"),
                                            camera());
  ASSERT_EQ(pixels.size(), 1U);
  EXPECT_EQ(pixels[0], Eigen::Vector2d(100.0, 200.0));
}

// A camera's centre 5 px off bends the lines it sees: a pose from them would be some 30 cm off.
TEST_F(Locate, RealRobotWithItsCentreOff) {
  MOVIS_NEEDS_SHARED_DATA(test::nubot_folder(1));
  for (const double off : {-5.0, 5.0}) {
    omni::Rig rig = omni::read_rig(folder_.write("rig.yaml", test::nubot_rig(1)));
    std::get<omni::Radial>(rig.cameras[0].model).u0 += off;
    omni::write_rig(rig, rig_);
    const test::ProgramRun run = locate(test::nubot_folder(1) / "whites.txt");
    EXPECT_EQ(values(run)["status"], "bad_fit") << run.output;
  }
}

TEST_F(Locate, AnotherFieldIsABadFit) {
  const test::ProgramRun run = locate(picture_from({-1.5, -3.0, 0.7}), "", data_file("fields/msl-12x8.yaml").string());
  EXPECT_EQ(run.exit_code, 0) << run.output;
  auto found = values(run);
  EXPECT_EQ(found["status"], "bad_fit") << run.output;
  EXPECT_EQ(found.count("x"), 0U);
  EXPECT_EQ(found.count("median_m"), 1U);
}

TEST_F(Locate, FewPixelsAreNoLandmark) {
  const test::ProgramRun run = locate(folder_.write("points.txt", "400 240\n410.5 240\n"));
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(values(run)["status"], "no_landmark") << run.output;
}

// The picture's corner lies beyond max_radius_px.
TEST_F(Locate, PixelsWithoutARayAreCounted) {
  const fs::path picture = picture_from({-1.5, -3.0, 0.7});
  auto without = values(locate(picture));
  std::ofstream(picture, std::ios::app) << "0 0\n639 479\n";
  auto with = values(locate(picture));
  EXPECT_EQ(with["points"], without["points"]);
  EXPECT_EQ(std::stoi(with["left_out"]), std::stoi(without["left_out"]) + 2);
}

TEST_F(Locate, BadPointsAreNamed) {
  expect_failure("100 200\ncolumn row\n", 1, {"points.txt:2", "column row", "two numbers"});
  expect_bad("", {"points.txt", "has no pixels"});
  expect_bad("# nothing\n\n", {"points.txt", "has no pixels"});
  expect_bad("100\n", {"points.txt:1", "two numbers"});
  expect_bad("100 200 3\n", {"points.txt:1", "two numbers"});
  expect_bad("100,200\n", {"points.txt:1", "two numbers"});
  expect_bad("100 nan\n", {"points.txt:1", "outside"});
  expect_bad("\n640 200\n", {"points.txt:2", "640", "outside the 640 × 480 image"});
  expect_bad("100 -1\n", {"points.txt:1", "outside"});
  test::expect_error([&] { app::read_line_pixels(folder_.path() / "absent.txt", camera()); }, {"absent.txt", "exists"});
}

TEST_F(Locate, WrongArguments) {
  EXPECT_EQ(test::run_program(std::string(MOVIS_PROGRAM) + " locate").exit_code, 2);
  expect_failure("100 200\n", 2, {"guess"}, "--guess 1,2");
  expect_failure("100 200\n", 2, {"guess"}, "--guess 1,2,east");
  expect_failure("100 200\n", 2, {"guess"}, "--guess 1,nan,3");
  expect_failure("100 200\n", 1, {"rig.yaml", "no camera 'M7'", "omni"}, "--camera M7");
}

TEST_F(Locate, SeveralCamerasNeedAChoice) {
  std::string second = std::string(kRig).substr(std::string("cameras:\n").size());
  second.replace(second.find("omni"), 4, "rear");
  folder_.write("rig.yaml", kRig + second);
  const omni::Rig rig = omni::read_rig(rig_);
  test::expect_error([&] { app::choose_camera(rig, std::nullopt, rig_); }, {"rig.yaml", "--camera", "omni, rear"});
  const fs::path picture = picture_from({-1.5, -3.0, 0.7});
  EXPECT_EQ(values(locate(picture, "--camera rear"))["status"], "ok");
}

// What a fitted pose leaves is about 4.0 cm in the median (the data's README); poses known to about a decimetre, and
// only to a half turn and a mirror image, as the pictures' handedness is not told.
TEST_F(Locate, RealRobots) {
  MOVIS_NEEDS_SHARED_DATA(test::nubot_folder(1));
  const double expected[][2] = {{1.30, 4.12}, {0.63, 4.38}};
  for (const int robot : {1, 2}) {
    folder_.write("rig.yaml", test::nubot_rig(robot));
    const test::ProgramRun run = locate(test::nubot_folder(robot) / "whites.txt");
    auto found = values(run);
    ASSERT_EQ(found["status"], "ok") << run.output;
    EXPECT_LE(std::stod(found["median_m"]), 0.040);
    EXPECT_GT(std::stod(found["within_15cm"]), 0.93);
    EXPECT_NEAR(std::abs(std::stod(found["x"])), expected[robot - 1][0], 0.1);
    EXPECT_NEAR(std::abs(std::stod(found["y"])), expected[robot - 1][1], 0.1);
  }
}

// Its calibration file is another robot's.
TEST_F(Locate, RealRobotWithAWrongCalibration) {
  MOVIS_NEEDS_SHARED_DATA(test::nubot_folder(3));
  folder_.write("rig.yaml", test::nubot_rig(3));
  const test::ProgramRun run = locate(test::nubot_folder(3) / "whites.txt");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(values(run)["status"], "bad_fit") << run.output;
}

}  // namespace
}  // namespace movis
