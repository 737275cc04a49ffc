// `movis track` as a user runs it: its file, its exit codes, and what it says about bad input.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "movis/core/csv.h"
#include "movis/core/paths.h"
#include "movis/grab/truth.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A copy of the shipped data set `field` that a test may damage, and `movis track` on it.
class Track : public testing::Test {
 protected:
  Track() { fs::copy(data_file("images/field"), data_, fs::copy_options::recursive); }

  test::ProgramRun track(const std::string& more = "") const {
    return test::run_program(std::string(MOVIS_PROGRAM) + " track --data " + data_.string() + " --out " +
                             out_.string() + " " + more);
  }

  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read_text(data_ / file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(data_ / file, std::ios::binary) << text.replace(at, from.size(), to);
  }

  void truncate(const std::string& file) const { fs::resize_file(data_ / file, fs::file_size(data_ / file) / 2); }

  // Exit code 1, every part in the message, and no file left behind.
  void expect_failure(std::initializer_list<const char*> parts, const std::string& more = "", int exit_code = 1) const {
    const test::ProgramRun run = track(more);
    EXPECT_EQ(run.exit_code, exit_code) << run.output;
    for (const char* part : parts) EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
    for (const auto& entry : fs::directory_iterator(folder_.path())) EXPECT_EQ(entry.path(), data_);
  }

  const test::TemporaryFolder folder_;
  const fs::path data_ = folder_.path() / "set";
  const fs::path out_ = folder_.path() / "est.csv";
};

TEST_F(Track, WritesOneRowASet) {
  const test::ProgramRun run = track();
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("ball: 5 of 5 found"), std::string::npos) << run.output;
  const CsvTable table = CsvTable::read(out_);
  ASSERT_EQ(table.rows(), 5U);
  std::string header;
  for (const std::string& column : table.header()) header += (header.empty() ? "" : ",") + column;
  EXPECT_EQ(header,
            "frame,time_s,ball_status,ball_x_r,ball_y_r,ball_z_r,ball_cov_xx,ball_cov_xy,ball_cov_yy,pose_status,"
            "robot_x,robot_y,robot_beta,pose_cov_xx,pose_cov_xy,pose_cov_xb,pose_cov_yy,pose_cov_yb,pose_cov_bb,"
            "ball_x,ball_y,ball_vx,ball_vy,tick_us");
  EXPECT_EQ(table.integer(4, table.column("frame")), 26);
  EXPECT_EQ(table.text(0, table.column("ball_status")), "ok");
  EXPECT_NEAR(table.number(0, table.column("robot_x")), -1.039, 0.1);  // truth.csv
  EXPECT_NEAR(table.number(0, table.column("ball_x")), -1.428, 0.1);
}

TEST_F(Track, SameInputSameRows) {
  const auto rows_without_times = [&] {
    std::string rows;
    std::istringstream stream(read_text(out_));
    for (std::string line; std::getline(stream, line);) rows += line.substr(0, line.rfind(',')) + "\n";
    return rows;
  };
  ASSERT_EQ(track().exit_code, 0);
  const std::string first = rows_without_times();
  ASSERT_EQ(track().exit_code, 0);
  EXPECT_EQ(first, rows_without_times());
}

TEST_F(Track, LostImageTheOtherCamerasGoOn) {
  replace("frames.csv", "images/000000_M2.png", "");
  ASSERT_EQ(track().exit_code, 0);
  const CsvTable table = CsvTable::read(out_);
  EXPECT_EQ(table.text(0, table.column("ball_status")), "ok");
}

TEST_F(Track, AllImagesOfASetLost) {
  replace("frames.csv", "images/000000_M1.png,images/000000_M2.png,images/000000_M3.png", ",,");
  ASSERT_EQ(track().exit_code, 0);
  const CsvTable table = CsvTable::read(out_);
  ASSERT_EQ(table.rows(), 5U);
  EXPECT_EQ(table.text(0, table.column("ball_status")), "not_seen");
  EXPECT_EQ(table.text(0, table.column("pose_status")), "no_goal");
  for (const char* column : {"ball_x_r", "ball_cov_yy", "robot_x", "pose_cov_bb", "ball_x"}) {
    EXPECT_EQ(table.text(0, table.column(column)), "") << column;  // numbers are written only with ok
  }
}

TEST_F(Track, EveryLocalizer) {
  for (const char* localizer : {"method1", "method2", "composed"}) {
    EXPECT_EQ(track(std::string("--localizer ") + localizer).exit_code, 0) << localizer;
  }
}

TEST_F(Track, EveryTriangulation) {
  std::string rows[2];
  for (const int i : {0, 1}) {
    ASSERT_EQ(track(std::string("--triangulation ") + (i == 0 ? "pairs" : "joint")).exit_code, 0);
    rows[i] = read_text(out_);
    const CsvTable table = CsvTable::read(out_);
    EXPECT_EQ(table.text(0, table.column("ball_status")), "ok");
  }
  EXPECT_NE(rows[0], rows[1]);
  EXPECT_EQ(track("--triangulation triples").exit_code, 2);
}

TEST_F(Track, CutOffPng) {
  truncate("images/000004_M2.png");
  expect_failure({"frames.csv:3", "'M2'", "000004_M2.png", "cut off"});
}

TEST_F(Track, CutOffJpeg) {
  ASSERT_EQ(
      test::run_program("printf '\\377\\330\\377\\340aaaaaaaaaaaaaaaa' > " + (data_ / "images/000004_M2.png").string())
          .exit_code,
      0);
  expect_failure({"frames.csv:3", "'M2'", "000004_M2.png", "cut off"});
}

TEST_F(Track, MissingImage) {
  fs::remove(data_ / "images/000026_M3.png");
  expect_failure({"frames.csv:6", "'M3'", "000026_M3.png"});
}

TEST_F(Track, UnknownKey) {
  replace("rig.yaml", "yaw_deg", "yaw_degrees");
  expect_failure({"rig.yaml:", "yaw_degrees", "yaw_deg"});
}

TEST_F(Track, MissingKey) {
  replace("field.yaml", "Fw: 0.5\n", "");
  expect_failure({"field.yaml:", "'Fw'", "missing"});
}

TEST_F(Track, MirrorWithoutExtent) {
  replace("rig.yaml", "a: 0.028095", "a: 0");
  expect_failure({"rig.yaml:", "hyperboloid.a", "out of range"});
}

TEST_F(Track, ImageOfAnotherSize) {
  replace("rig.yaml", "width: 640", "width: 320");
  expect_failure({"frames.csv:2", "'M1'", "640", "320"});
}

TEST_F(Track, EmptyFramesTable) {
  std::ofstream(data_ / "frames.csv", std::ios::trunc).close();
  expect_failure({"frames.csv", "empty"});
  std::ofstream(data_ / "frames.csv") << "frame,time_s,M1,M2,M3\n";
  expect_failure({"frames.csv", "no"});
}

TEST_F(Track, NoDataSet) {
  fs::remove(data_ / "frames.csv");
  expect_failure({"is not a data set", "frames.csv"});
}

TEST_F(Track, OneCamera) {
  std::string rig = read_text(data_ / "rig.yaml");
  std::ofstream(data_ / "rig.yaml") << rig.substr(0, rig.find("- name: M2"));
  std::ofstream(data_ / "frames.csv") << "frame,time_s,M1\n0,0,images/000000_M1.png\n";
  expect_failure({"two or more cameras"});
}

TEST_F(Track, OutputFolderThatIsAbsent) {
  const test::ProgramRun run = test::run_program(std::string(MOVIS_PROGRAM) + " track --data " + data_.string() +
                                                 " --out " + (folder_.path() / "absent/est.csv").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("does not exist"), std::string::npos) << run.output;
}

TEST_F(Track, OutputOntoItsInput) {
  fs::copy(data_ / "images/000000_M2.png", data_ / "mask.png");
  replace("rig.yaml", "name: M2", "name: M2\n  mask: mask.png");
  for (const char* input : {"frames.csv", "rig.yaml", "images/000004_M2.png", "mask.png"}) {
    const std::string before = read_text(data_ / input);
    const test::ProgramRun run = test::run_program(std::string(MOVIS_PROGRAM) + " track --data " + data_.string() +
                                                   " --out " + (data_ / input).string());
    EXPECT_EQ(run.exit_code, 1) << input;
    EXPECT_NE(run.output.find("is the input file"), std::string::npos) << run.output;
    EXPECT_EQ(read_text(data_ / input), before);
  }
}

TEST_F(Track, OutputThatIsFull) {
  const test::ProgramRun run = test::run_program("{ " + std::string(MOVIS_PROGRAM) + " track --data " + data_.string() +
                                                 " --out " + out_.string() + " >/dev/full; }");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("standard output cannot be written"), std::string::npos) << run.output;
}

TEST_F(Track, InterruptedLeavesNothingBehind) {
  // A thousand rows of the same images, so that the signal comes in the middle.
  std::string rows = "frame,time_s,M1,M2,M3\n";
  for (int i = 0; i < 1000; ++i) {
    rows += std::to_string(i) + ",0,images/000000_M1.png,images/000000_M2.png,images/000000_M3.png\n";
  }
  std::ofstream(data_ / "frames.csv") << rows;
  const test::ProgramRun run =
      test::run_program("timeout --signal=INT --preserve-status 1 " + std::string(MOVIS_PROGRAM) + " track --data " +
                        data_.string() + " --out " + out_.string());
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_NE(run.output.find("interrupted"), std::string::npos) << run.output;
  for (const auto& entry : fs::directory_iterator(folder_.path())) EXPECT_EQ(entry.path(), data_);
}

TEST_F(Track, FieldOfAnotherSize) {
  replace("field.yaml", "Fd: 2.0", "Fd: 9.0");
  replace("field.yaml", "half_length: 2.0", "half_length: 9.0");
  ASSERT_EQ(track().exit_code, 0);
  const CsvTable table = CsvTable::read(out_);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_EQ(table.text(row, table.column("pose_status")), "bad_fit");
  }
  ASSERT_EQ(track("--localizer composed").exit_code, 0);
  EXPECT_EQ(CsvTable::read(out_).text(0, table.column("pose_status")), "contradiction");
}

TEST_F(Track, TruthOfAnotherRecording) {
  std::ofstream(data_ / "truth.csv") << "frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z,label\n"
                                     << "777,0,0,0,0,0,0,0,\n";
  expect_failure({"truth.csv", "another recording"});
}

// The paper's methods know goals by their colour; the lines tell the pose but for half a turn.
TEST_F(Track, WhiteGoals) {
  std::ofstream(data_ / "field.yaml", std::ios::app) << "goals: white\n";
  expect_failure({"goals are white"}, "--localizer composed");
  ASSERT_EQ(track().exit_code, 0);
  const CsvTable table = CsvTable::read(out_);
  const auto truth = grab::read_truth(data_ / "truth.csv");
  for (std::size_t row = 0; row < table.rows(); ++row) {
    ASSERT_EQ(table.text(row, table.column("pose_status")), "ok");
    const Eigen::Vector2d place(table.number(row, table.column("robot_x")), table.number(row, table.column("robot_y")));
    const Eigen::Vector2d true_place =
        truth.at(std::stoll(table.text(row, table.column("frame")))).world_from_robot.translation();
    EXPECT_LT(std::min((place - true_place).norm(), (place + true_place).norm()), 0.02);
  }
}

// Two black robots stand on the field in the first shipped set of images/field-obstacles.
TEST_F(Track, Obstacles) {
  const fs::path file = folder_.path() / "obstacles.csv";
  const test::ProgramRun run =
      test::run_program(std::string(MOVIS_PROGRAM) + " track --data " + data_file("images/field-obstacles").string() +
                        " --out " + out_.string() + " --obstacles " + file.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const CsvTable table = CsvTable::read(file);
  ASSERT_GE(table.rows(), 2U);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double distance = table.number(row, table.column("distance"));
    const double x = table.number(row, table.column("x_r"));
    const double y = table.number(row, table.column("y_r"));
    EXPECT_NEAR(std::hypot(x, y), distance, 1e-3);
    EXPECT_GT(table.number(row, table.column("width")), 0.1);
  }
}

// The shipped carpet shows about [50, 128, 70]: half of a typical colour of twice that; and of another carpet, or of none,
// no light is told.
TEST_F(Track, LightThatIsNotThatOfTheClasses) {
  EXPECT_EQ(track().output.find("light"), std::string::npos);
  const auto track_with = [&](const char* typical) {
    std::ofstream(data_ / "colours.yaml")
        << "ball: {hue_deg: [5, 38], chroma: [0.25, 1.0], brightness: [0.25, 1.0]}\n"
        << "field: {hue_deg: [90, 179], chroma: [0.10, 1.0], brightness: [0.10, 1.0]" << typical << "}\n";
    const test::ProgramRun run = track("--colours " + (data_ / "colours.yaml").string());
    EXPECT_EQ(run.exit_code, 0) << run.output;
    return run.output;
  };
  const std::string half = track_with(", typical: [100, 255, 140]");
  EXPECT_NE(half.find("\n  light by_carpet 15\n"), std::string::npos) << half;
  EXPECT_EQ(half.find("unknown light"), std::string::npos) << half;
  for (const char* typical : {", typical: [20, 200, 190]", ""}) {
    const std::string unknown = track_with(typical);
    EXPECT_NE(unknown.find("\n  light unknown 15\n  unknown light"), std::string::npos) << unknown;
  }
  replace("frames.csv", "images/000000_M2.png", "");
  EXPECT_NE(track_with("").find("light unknown 14\n"), std::string::npos) << "a lost image has no light";
}

// Goals of no colour that colours.yaml knows, on a field that is said to have coloured ones: which half is open.
TEST_F(Track, GoalsThatAreNotFound) {
  std::ofstream(data_ / "colours.yaml")
      << "ball: {hue_deg: [5, 38], chroma: [0.25, 1.0], brightness: [0.25, 1.0]}\n"
      << "field: {hue_deg: [90, 170], chroma: [0.10, 1.0], brightness: [0.10, 1.0]}\n";
  ASSERT_EQ(track("--colours " + (data_ / "colours.yaml").string()).exit_code, 0);
  const CsvTable table = CsvTable::read(out_);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    EXPECT_EQ(table.text(row, table.column("pose_status")), "ambiguous");
    EXPECT_FALSE(table.text(row, table.column("robot_x")).empty());
    EXPECT_TRUE(table.text(row, table.column("ball_x")).empty());
  }
}

TEST_F(Track, CamerasInOnePlace) {
  std::string rig = read_text(data_ / "rig.yaml");
  for (const char* position : {"- -0.173205081\n  - 0.1\n", "- 0.173205081\n  - 0.1\n", "- -0.0\n  - -0.2\n"}) {
    const auto at = rig.find(position);
    ASSERT_NE(at, std::string::npos);
    rig.replace(at, std::string(position).size(), "- 0.0\n  - 0.0\n");
  }
  std::ofstream(data_ / "rig.yaml") << rig;
  expect_failure({"position", "apart"});
}

TEST_F(Track, WrongArguments) {
  expect_failure({"--localizer", "guess"}, "--localizer guess", 2);
  expect_failure({"--speed"}, "--speed 3", 2);
  EXPECT_EQ(test::run_program(std::string(MOVIS_PROGRAM)).exit_code, 2);
  EXPECT_EQ(test::run_program(std::string(MOVIS_PROGRAM) + " --help").exit_code, 0);
}

}  // namespace
}  // namespace movis
