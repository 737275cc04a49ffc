// `movis calibrate rig` as a user runs it, on the shipped ray-traced sets: their rig is the nominal one, so that hardly
// any deviation is to be found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/omni/rig.h"
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

class CalibrateRig : public testing::Test {
 protected:
  test::ProgramRun calibrate(const fs::path& data, const std::string& more = "") const {
    return test::run_program(std::string(MOVIS_PROGRAM) + " calibrate rig --data " + data.string() + " --out " +
                             out_.string() + " " + more);
  }

  // Exit code 1, every part in the message, and no file left behind.
  void expect_failure(const test::ProgramRun& run, std::initializer_list<const char*> parts) const {
    EXPECT_EQ(run.exit_code, 1) << run.output;
    for (const char* part : parts) EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
    EXPECT_FALSE(fs::exists(out_));
  }

  void expect_near_drawing(const fs::path& drawing) const {
    const omni::Rig nominal = omni::read_rig(drawing);
    const omni::Rig rig = omni::read_rig(out_);
    ASSERT_EQ(rig.cameras.size(), nominal.cameras.size());
    for (std::size_t k = 0; k < rig.cameras.size(); ++k) {
      EXPECT_LT((rig.cameras[k].position - nominal.cameras[k].position).norm(), 2e-3);
      EXPECT_LT(degrees(std::abs(turn(rig.cameras[k].yaw, nominal.cameras[k].yaw))), 0.1);
    }
  }

  const test::TemporaryFolder folder_;
  const fs::path out_ = folder_.path() / "calibrated.yaml";
};

TEST_F(CalibrateRig, KnownPlaces) {
  const fs::path data = test::shared_data() / "pov" / "open";
  MOVIS_NEEDS_SHARED_DATA(data);
  const test::ProgramRun run = calibrate(data);
  ASSERT_EQ(run.exit_code, 0) << run.output;
  for (const char* part : {"calibrated from balls at the known places of truth.csv: 40 of 40", "M3", "yaw", "rms"}) {
    EXPECT_NE(run.output.find(part), std::string::npos) << part << "\n" << run.output;
  }
  expect_near_drawing(data / "rig.yaml");
  EXPECT_NE(read_text(out_).find("# M1: x "), std::string::npos);
}

TEST_F(CalibrateRig, BySelf) {
  const fs::path data = test::shared_data() / "pov" / "field";
  MOVIS_NEEDS_SHARED_DATA(data);
  const test::ProgramRun run = calibrate(data, "--self");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("calibrated by itself"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("kept as drawn"), std::string::npos) << run.output;
  expect_near_drawing(data / "rig.yaml");
}

TEST_F(CalibrateRig, TooFewFrames) {
  expect_failure(calibrate(data_file("images/open")), {"at least 8", "all around the robot"});
  expect_failure(calibrate(data_file("images/field"), "--self"), {"self-calibration needs at least 8"});
}

TEST_F(CalibrateRig, NoTruthAndNoField) {
  const fs::path data = folder_.path() / "set";
  fs::copy(data_file("images/open"), data, fs::copy_options::recursive);
  fs::remove(data / "truth.csv");
  fs::remove(data / "field.yaml");
  expect_failure(calibrate(data), {"--field", "add a truth.csv"});
}

TEST_F(CalibrateRig, BySelfWithoutAField) {
  const fs::path data = folder_.path() / "set";
  fs::copy(data_file("images/open"), data, fs::copy_options::recursive);
  fs::remove(data / "field.yaml");
  const test::ProgramRun run = calibrate(data, "--self");
  expect_failure(run, {"--field", "leave --self out"});
  EXPECT_EQ(run.output.find("without truth.csv"), std::string::npos) << run.output;
}

TEST_F(CalibrateRig, FieldThatIsNotUsed) {
  const fs::path absent = folder_.path() / "absent.yaml";
  expect_failure(calibrate(data_file("images/open"), "--field " + absent.string()), {"absent.yaml", "add --self"});
}

TEST_F(CalibrateRig, TruthOfAnotherRecording) {
  const fs::path data = folder_.path() / "set";
  fs::copy(data_file("images/open"), data, fs::copy_options::recursive);
  std::ofstream(data / "truth.csv") << "frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z,label\n"
                                    << "777,0,0,0,0,1,1,0.11,\n";
  expect_failure(calibrate(data), {"another recording"});
}

TEST_F(CalibrateRig, OptionsAreReadStrictly) {
  const fs::path options = folder_.write("options.yaml", "calibration: {prior: {yaw: 1}}\n");
  expect_failure(calibrate(data_file("images/open"), "--options " + options.string()), {"'yaw'", "yaw_deg"});
}

TEST_F(CalibrateRig, OutputOntoItsInput) {
  const fs::path data = folder_.path() / "set";
  fs::copy(data_file("images/open"), data, fs::copy_options::recursive);
  const std::string before = read_text(data / "rig.yaml");
  const test::ProgramRun run = test::run_program(std::string(MOVIS_PROGRAM) + " calibrate rig --data " + data.string() +
                                                 " --out " + (data / "rig.yaml").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("is the input file"), std::string::npos) << run.output;
  EXPECT_EQ(read_text(data / "rig.yaml"), before);
}

TEST_F(CalibrateRig, WrongArguments) {
  EXPECT_EQ(test::run_program(std::string(MOVIS_PROGRAM) + " calibrate").exit_code, 2);
  EXPECT_EQ(test::run_program(std::string(MOVIS_PROGRAM) + " calibrate rig --out x").exit_code, 2);
}

}  // namespace
}  // namespace movis
