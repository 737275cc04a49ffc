// `movis bound` as a user runs it: its file, its exit codes, and what it says about bad input.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "movis/core/csv.h"
#include "movis/core/paths.h"
#include "support/chromium.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

namespace fs = std::filesystem;

class Bound : public testing::Test {
 protected:
  test::ProgramRun bound(const std::string& more = "") const {
    return test::run_program(std::string(MOVIS_PROGRAM) + " bound --rig " + rig_.string() + " --out " + out_.string() +
                             " " + more);
  }

  // Every part in the message, and no file left behind.
  void expect_failure(std::initializer_list<const char*> parts, const std::string& more, int exit_code) const {
    const test::ProgramRun run = bound(more);
    EXPECT_EQ(run.exit_code, exit_code) << run.output;
    for (const char* part : parts) EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
    EXPECT_FALSE(fs::exists(out_));
  }

  // The first camera of the shipped rig alone.
  void leave_one_camera() {
    std::ifstream file(rig_);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    rig_ = folder_.write("one.yaml", text.substr(0, text.find("- name: M2")));
  }

  const test::TemporaryFolder folder_;
  fs::path rig_ = data_file("rigs/movis.yaml");
  const fs::path out_ = folder_.path() / "map.csv";
};

TEST_F(Bound, WritesOneRowAPlace) {
  const test::ProgramRun run = bound("--half-width 2 --step 0.5");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("3 cameras, the ball is seen at 81 of 81 places"), std::string::npos) << run.output;
  const CsvTable table = CsvTable::read(out_);
  ASSERT_EQ(table.rows(), 81U);
  std::string header;
  for (const std::string& column : table.header()) header += (header.empty() ? "" : ",") + column;
  EXPECT_EQ(header,
            "x,y,cameras,floor_status,floor_distance_sigma,floor_direction_sigma_deg,floor_position_sigma,free_status,"
            "free_distance_sigma,free_direction_sigma_deg,free_position_sigma");
  EXPECT_EQ(table.text(0, table.column("floor_status")), "ok");
  EXPECT_EQ(table.text(40, table.column("floor_status")), "unobservable");  // the robot's own place
  EXPECT_EQ(table.text(40, table.column("floor_distance_sigma")), "");      // numbers are written only with ok
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (row == 40) continue;
    const double x = table.number(row, table.column("x"));
    const double y = table.number(row, table.column("y"));
    const double distance = table.number(row, table.column("free_distance_sigma"));
    const double direction = table.number(row, table.column("free_direction_sigma_deg")) * 3.14159265 / 180.0;
    EXPECT_NEAR(table.number(row, table.column("free_position_sigma")),
                std::hypot(distance, std::hypot(x, y) * direction), 1e-5 * distance);
    EXPECT_LT(table.number(row, table.column("floor_distance_sigma")), distance);
  }
}

TEST_F(Bound, NoiseAndContrastScaleIt) {
  const auto first = [&](const std::string& more) {
    EXPECT_EQ(bound("--half-width 2 --step 1 " + more).exit_code, 0);
    const CsvTable table = CsvTable::read(out_);
    return table.number(0, table.column("floor_distance_sigma"));
  };
  const double sigma = first("--contrast 100 --noise 2");
  EXPECT_NEAR(first("--contrast 100 --noise 4") / sigma, 2.0, 1e-4);
  EXPECT_NEAR(first("--contrast 50 --noise 2") / sigma, 2.0, 1e-4);
  EXPECT_LT(first("--contrast 100 --noise 2 --diameter"), sigma);
}

TEST_F(Bound, OneCamera) {
  leave_one_camera();
  const test::ProgramRun run = bound("--half-width 2 --step 1");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("1 camera,"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("0 of 72"), std::string::npos) << run.output;
  const CsvTable table = CsvTable::read(out_);
  EXPECT_EQ(table.text(0, table.column("floor_status")), "ok");
  EXPECT_EQ(table.text(0, table.column("free_status")), "unobservable");
  EXPECT_EQ(table.text(0, table.column("free_position_sigma")), "");
}

TEST_F(Bound, BallAboveEveryMirror) {
  const test::ProgramRun run =
      bound("--half-width 1 --step 1 --height 3 --page " + (folder_.path() / "p.html").string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("seen at 0 of 9 places"), std::string::npos) << run.output;
  EXPECT_EQ(CsvTable::read(out_).text(0, 3), "not_seen");
}

TEST_F(Bound, PageOpensInABrowserWithoutErrors) {
  const auto page = folder_.path() / "bound.html";
  const test::ProgramRun run = bound("--free --page " + page.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const test::ChromiumRun browser = test::open_in_chromium(page, folder_.path());
  EXPECT_TRUE(browser.messages.empty()) << browser.messages.front();
  for (const char* part : {"data:image/png", "How to read it", "M3", "72 of 72", R"(id="free" aria-pressed="true")"}) {
    EXPECT_NE(browser.dom.find(part), std::string::npos) << part;
  }
}

TEST_F(Bound, WrongArguments) {
  expect_failure({"--noise", "0"}, "--noise 0", 2);
  expect_failure({"--contrast", "-5"}, "--contrast -5", 2);
  expect_failure({"--step", "0"}, "--step 0", 2);
  expect_failure({"--blur", "-1"}, "--blur -1", 2);
  expect_failure({"step is 5 m", "half width, 4 m"}, "--step 5", 2);
  expect_failure({"step of 0.001 m", "coarser"}, "--step 0.001", 2);
  expect_failure({"--page", "coarser"}, "--step 0.01 --page " + (folder_.path() / "p.html").string(), 2);
  expect_failure({"--noise", "nan is no number"}, "--noise nan", 2);
  for (const char* height : {"-5", "1e300", "nan"}) {
    expect_failure({"--height", height}, std::string("--height ") + height, 2);
  }
}

// A map of a million places takes minutes.
TEST_F(Bound, InterruptedLeavesNothingBehind) {
  const test::ProgramRun run =
      test::run_program("timeout --signal=INT --kill-after=20 --preserve-status 0.5 " + std::string(MOVIS_PROGRAM) +
                        " bound --rig " + rig_.string() + " --out " + out_.string() + " --half-width 100 --step 0.2");
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_NE(run.output.find("interrupted"), std::string::npos) << run.output;
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

// No page stands without its table.
TEST_F(Bound, TableThatCannotBeWritten) {
  const test::ProgramRun run =
      test::run_program(std::string(MOVIS_PROGRAM) + " bound --rig " + rig_.string() +
                        " --out /dev/full --half-width 1 --step 1 --page " + (folder_.path() / "p.html").string());
  EXPECT_EQ(run.exit_code, 1) << run.output;
  EXPECT_NE(run.output.find("/dev/full: writing failed"), std::string::npos) << run.output;
  EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(Bound, PlacesThatCannotBeWritten) {
  expect_failure({"does not exist"}, "--page " + (folder_.path() / "absent/p.html").string(), 1);
  expect_failure({"--page", "name another file"}, "--page " + out_.string(), 1);
  fs::copy(rig_, folder_.path() / "rig.yaml");
  rig_ = folder_.path() / "rig.yaml";
  expect_failure({"--page", "is the input file"}, "--page " + rig_.string(), 1);
}

TEST_F(Bound, RigThatCannotBeRead) {
  rig_ = folder_.path() / "absent.yaml";
  expect_failure({"absent.yaml"}, "", 1);
  rig_ = folder_.write("rig.yaml", "cameras: []\n");
  expect_failure({"rig.yaml", "cameras"}, "", 1);
}

}  // namespace
}  // namespace movis
