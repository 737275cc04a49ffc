// `movis experiment` as one runs it: files, replay, interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

namespace fs = std::filesystem;

const std::string kProgram = MOVIS_PROGRAM;

std::string content(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// The shipped rigs on eight places around the robot.
fs::path small_experiment(const test::TemporaryFolder& folder, const std::string& draws) {
  const std::string data = MOVIS_SOURCE_DIR "/data/";
  return folder.write("small.yaml",
                      "experiment: measurement\nrigs: {single: " + data + "rigs/single.yaml, vertical: " + data +
                          "rigs/vertical.yaml, vertical_short: " + data + "rigs/vertical-short.yaml, movis: " + data +
                          "rigs/movis.yaml}\nrobot: " + data + "robots/miniature.yaml\nlook: " + data +
                          "looks/hall.yaml\ncolours: " + data +
                          "colours/default.yaml\nlattice: {half_width: 1, step: 1}\ncalibration_points: 12\n" + draws);
}

const char* const kFewDraws = "bearings: {draws: 2}\nimages: {draws: 1}\none_difference: {draws: 1, step: 1}\n";

TEST(Experiment, WritesItsFilesAndReplaysItsRows) {
  const test::TemporaryFolder folder;
  const std::string command =
      kProgram + " experiment " + small_experiment(folder, kFewDraws).string() + " --out " + folder.path().string();
  const test::ProgramRun run = test::run_program(command + " --seed 5");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("8 points, 1 under the robot left out; seed 5"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("MOVIS, pairs"), std::string::npos) << run.output;
  for (const char* file : {"rows.csv", "summary.json", "index.html"}) {
    EXPECT_TRUE(fs::exists(folder.path() / file)) << file;
  }
  // 8 places: 3 draws of 4 knowledges and 6 kinds alone, each by 8 systems; and the header. The last is on images.
  const std::string rows = content(folder.path() / "rows.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 8 * 8 * (3 * 4 + 6) + 1);
  for (const char* row : {"0", "1151"}) {
    const test::ProgramRun replay = test::run_program(command + " --replay " + row);
    EXPECT_EQ(replay.exit_code, 0) << replay.output;
    EXPECT_NE(replay.output.find("recomputed"), std::string::npos) << replay.output;
  }
  const test::ProgramRun absent = test::run_program(command + " --replay 1152");
  EXPECT_EQ(absent.exit_code, 1);
  EXPECT_NE(absent.output.find("no row 1152"), std::string::npos) << absent.output;

  // A row that says something else than what comes out.
  std::string changed = rows;
  const std::size_t first = changed.find(",ok,") + 4;
  changed.replace(first, changed.find(',', first) - first, "12.5");
  folder.write("rows.csv", changed);
  const std::string number = "0";
  const test::ProgramRun differs = test::run_program(command + " --replay " + number);
  EXPECT_EQ(differs.exit_code, 1) << differs.output;
  EXPECT_NE(differs.output.find("comes out differently"), std::string::npos) << differs.output;
}

// An interrupt in the middle leaves whole rows; --resume goes on to the very file of a run that was left alone.
TEST(Experiment, InterruptLosesNothing) {
  const test::TemporaryFolder folder;
  const std::string experiment =
      kProgram + " experiment " + small_experiment(folder, "bearings: {draws: 12}\nimages: {draws: 0}\n").string();
  const std::string part = (folder.path() / "part").string();
  const std::string whole = (folder.path() / "whole").string();
  const test::ProgramRun stopped =
      test::run_program("timeout --signal=INT --kill-after=20 0.15 " + experiment + " --jobs 1 --out " + part);
  if (stopped.output.find("open in a browser") != std::string::npos) {
    GTEST_SKIP() << "this machine was done before the interrupt";
  }
  EXPECT_FALSE(fs::exists(part + "/index.html"));
  const char* resume = fs::exists(part + "/rows.csv") ? " --resume" : "";  // else it came before the first row
  const test::ProgramRun resumed = test::run_program(experiment + resume + " --out " + part);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.output;
  const test::ProgramRun alone = test::run_program(experiment + " --jobs 2 --out " + whole);
  EXPECT_EQ(alone.exit_code, 0) << alone.output;
  EXPECT_EQ(content(part + "/rows.csv"), content(whole + "/rows.csv"));
  EXPECT_EQ(content(part + "/summary.json"), content(whole + "/summary.json"));
}

// One spot, two headings, one draw, and the paper's methods among the localizers.
TEST(Experiment, SelfLocalization) {
  const test::TemporaryFolder folder;
  const std::string data = MOVIS_SOURCE_DIR "/data/";
  const fs::path file = folder.write(
      "spots.yaml", "experiment: self-localization\nrig: " + data + "rigs/movis.yaml\nrobot: " + data +
                        "robots/miniature.yaml\nlook: " + data + "looks/hall.yaml\ncolours: " + data +
                        "colours/default.yaml\nfield: " + data +
                        "fields/paper.yaml\nspots: [{name: E, place: [0, 0]}]\nheading_step_deg: 180\ncalibration: "
                        "{points: 12}\ncoloured_draws: 1\nwhite_draws: 0\n");
  const std::string command = kProgram + " experiment " + file.string() + " --out " + (folder.path() / "out").string();
  const test::ProgramRun run = test::run_program(command + " --seed 5");
  ASSERT_EQ(run.exit_code, 0) << run.output;
  EXPECT_NE(run.output.find("1 spots, 2 headings"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("composed"), std::string::npos) << run.output;
  EXPECT_LE(std::count(run.output.begin(), run.output.end(), '\n'), 27) << run.output;
  for (const char* name : {"rows.csv", "summary.json", "index.html"}) {
    EXPECT_TRUE(fs::exists(folder.path() / "out" / name)) << name;
  }
  const test::ProgramRun replay = test::run_program(command + " --replay 1");
  EXPECT_EQ(replay.exit_code, 0) << replay.output;
}

TEST(Experiment, WhatCannotWorkIsRefused) {
  const test::TemporaryFolder folder;
  const std::string out = " --out " + folder.path().string();
  const struct {
    std::string arguments;
    const char* message;
    int exit_code;
  } cases[] = {{"measuremnt", "did you mean 'measurement'", 1},
               {"/absent.yaml", "/absent.yaml", 1},
               {small_experiment(folder, "images: {drws: 1}\n").string(), "drws", 1},
               {folder.write("kind.yaml", "experiment: shooting\n").string(), "measurement, self-localization", 1},
               {"measurement --jobs 0", "--jobs", 2},
               {"measurement --seed -1", "--seed", 2},
               {"measurement --replay 3", "rows.csv", 1},
               {"measurement --replay 3 --seed 2", "--seed excludes --replay", 2},
               {"measurement --replay 3 --jobs 2", "--jobs excludes --replay", 2},
               {"measurement --replay 3 --resume", "--resume excludes --replay", 2},
               {"measurement --replay 1.5", "1.5 not in range", 2},
               {"measurement --replay -1", "-1 not in range", 2},
               {"measurement --resume", "nothing can be resumed", 1},
               {"", "experiment is required", 2}};
  for (const auto& [arguments, message, exit_code] : cases) {
    const test::ProgramRun run = test::run_program(kProgram + " experiment " + arguments + out);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << run.output;
    EXPECT_NE(run.output.find(message), std::string::npos) << arguments << run.output;
    EXPECT_LT(run.output.size(), 600U) << run.output;
    EXPECT_FALSE(fs::exists(folder.path() / "rows.csv")) << arguments;
  }
}

}  // namespace
}  // namespace movis
