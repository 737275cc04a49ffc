// `movis calibrate correction` as a user runs it, on ray-traced images, and its file in `movis track`.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "support/program.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

namespace fs = std::filesystem;

std::string read_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A copy of the set `open`, whose tables a test may damage; its images are linked.
class CalibrateCorrection : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path open = test::shared_data() / "pov" / "open";
    MOVIS_NEEDS_SHARED_DATA(open);
    fs::create_directory(data_);
    for (const char* file : {"rig.yaml", "frames.csv", "truth.csv"}) fs::copy(open / file, data_ / file);
    fs::create_directory_symlink(fs::absolute(open) / "images", data_ / "images");
  }

  test::ProgramRun calibrate(const std::string& more = "") const {
    return run("calibrate correction --data " + data_.string() + " --out " + out_.string() + " " + more);
  }
  static test::ProgramRun run(const std::string& arguments) {
    return test::run_program(std::string(MOVIS_PROGRAM) + " " + arguments);
  }

  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string text = read_text(data_ / file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    std::ofstream(data_ / file, std::ios::binary) << text.replace(at, from.size(), to);
  }

  // Keeps the header and so many rows.
  void shorten(const std::string& file, int rows) const {
    std::istringstream stream(read_text(data_ / file));
    std::string kept;
    std::string line;
    for (int i = 0; i <= rows && std::getline(stream, line); ++i) kept += line + "\n";
    std::ofstream(data_ / file, std::ios::binary) << kept;
  }

  // Exit code 1, every part in the message, and no file left behind.
  void expect_failure(std::initializer_list<const char*> parts, const std::string& more = "") const {
    const test::ProgramRun run = calibrate(more);
    EXPECT_EQ(run.exit_code, 1) << run.output;
    for (const char* part : parts) EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
    for (const auto& entry : fs::directory_iterator(folder_.path())) EXPECT_EQ(entry.path(), data_);
  }

  const test::TemporaryFolder folder_;
  const fs::path data_ = folder_.path() / "set";
  const fs::path out_ = folder_.path() / "correction.yaml";
};

TEST_F(CalibrateCorrection, TrackReadsWhatItWrites) {
  const test::ProgramRun calibrated = calibrate();
  ASSERT_EQ(calibrated.exit_code, 0) << calibrated.output;
  for (const char* part : {"40 sets of 3 images", "M1", "M2", "M3", "cross-validated"}) {
    EXPECT_NE(calibrated.output.find(part), std::string::npos) << part << "\n" << calibrated.output;
  }
  EXPECT_EQ(calibrated.output.find("left out"), std::string::npos) << calibrated.output;
  const std::string track =
      "track --data " + data_.string() + " --out " + (folder_.path() / "est.csv").string() + " --correction ";
  const test::ProgramRun tracked = run(track + out_.string());
  EXPECT_EQ(tracked.exit_code, 0) << tracked.output;
  EXPECT_NE(tracked.output.find("ball: 40 of 40 found"), std::string::npos) << tracked.output;

  replace("rig.yaml", "name: M2", "name: M4");
  replace("frames.csv", "M2", "M4");
  const test::ProgramRun other_names = run(track + out_.string());
  EXPECT_EQ(other_names.exit_code, 1);
  EXPECT_NE(other_names.output.find("no camera of the rig"), std::string::npos) << other_names.output;
  const test::ProgramRun no_file = run(track + (folder_.path() / "none.yaml").string());
  EXPECT_EQ(no_file.exit_code, 1);
  EXPECT_NE(no_file.output.find("none.yaml"), std::string::npos) << no_file.output;
}

TEST_F(CalibrateCorrection, ColumnsSwapped) {
  replace("frames.csv", "M1,M2", "M2,M1");
  expect_failure({"the images of M1 look like those of M2", "frames.csv"});
}

TEST_F(CalibrateCorrection, TooFewPlaces) {
  shorten("frames.csv", 8);
  shorten("truth.csv", 8);
  expect_failure({"M1 has 8 balls at known places", "it needs 12"});
}

TEST_F(CalibrateCorrection, NoTruth) {
  fs::remove(data_ / "truth.csv");
  expect_failure({"truth.csv: is missing", "known places"});
}

TEST_F(CalibrateCorrection, TruthOfAnotherRecording) {
  shorten("truth.csv", 0);
  std::ofstream(data_ / "truth.csv", std::ios::app) << "977,0,0,0,0,1,1,0.11,\n";
  expect_failure({"none of the frames"});
}

TEST_F(CalibrateCorrection, DoesNotOverwriteItsInput) {
  fs::copy(data_ / "truth.csv", data_ / "mask.png");  // nothing reads it before
  replace("rig.yaml", "name: M2", "name: M2\n  mask: mask.png");
  for (const char* input : {"truth.csv", "mask.png"}) {
    const std::string before = read_text(data_ / input);
    const test::ProgramRun run_result =
        run("calibrate correction --data " + data_.string() + " --out " + (data_ / input).string());
    EXPECT_EQ(run_result.exit_code, 1) << input;
    EXPECT_NE(run_result.output.find("is the input file"), std::string::npos) << run_result.output;
    EXPECT_EQ(read_text(data_ / input), before);
  }
}

TEST_F(CalibrateCorrection, MissingArguments) {
  EXPECT_EQ(run("calibrate correction --data " + data_.string()).exit_code, 2);
  EXPECT_EQ(run("calibrate").exit_code, 2);
}

}  // namespace
}  // namespace movis
