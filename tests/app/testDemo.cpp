#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "support/chromium.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

const std::string kProgram = MOVIS_PROGRAM;

std::string content(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(Demo, PageOpensInABrowserWithoutErrors) {
  const test::TemporaryFolder folder;
  const auto page = folder.path() / "demo.html";
  const test::ProgramRun run = test::run_program(kProgram + " demo --episodes 1 --out " + page.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const test::ChromiumRun browser = test::open_in_chromium(page, folder.path());
  EXPECT_TRUE(browser.messages.empty()) << browser.messages.front();
  for (const char* part : {"fuzzy", "pbvs", "M1", "M2", "M3"}) {
    EXPECT_NE(browser.dom.find(part), std::string::npos) << part;
  }
  std::size_t drawings = 0;
  for (auto at = browser.dom.find("<svg"); at != std::string::npos; at = browser.dom.find("<svg", at + 1)) ++drawings;
  EXPECT_GE(drawings, 6U);
}

// A scenario that is over soon.
std::filesystem::path short_scenario(const test::TemporaryFolder& folder, const std::string& more) {
  const std::string data = MOVIS_SOURCE_DIR "/data/";
  return folder.write("short.yaml", "rig: " + data + "rigs/movis.yaml\nrobot: " + data +
                                        "robots/miniature.yaml\nlook: " + data + "looks/hall.yaml\nfield: " + data +
                                        "fields/paper.yaml\n" + more);
}

// On one core the episodes are played one after the other, on several at the same time.
TEST(Demo, SameSeedSameRowsOnAnyNumberOfCores) {
  const test::TemporaryFolder folder;
  const auto scenario = short_scenario(folder, "duration_s: 2.4\nmargin: 0.9\n");
  std::string pages[2];
  std::string rows[2];
  for (const int i : {0, 1}) {
    const auto page = folder.path() / "demo.html";
    const auto file = folder.path() / "rows.csv";
    const test::ProgramRun run =
        test::run_program((i == 0 ? "taskset -c 0 " : "") + kProgram + " demo --episodes 2 --seed 7 --scenario " +
                          scenario.string() + " --rows " + file.string() + " --out " + page.string());
    ASSERT_EQ(run.exit_code, 0) << run.output;
    rows[i] = content(file);
    pages[i] = content(page);
  }
  EXPECT_FALSE(rows[0].empty());
  EXPECT_EQ(rows[0], rows[1]);
  EXPECT_TRUE(pages[0] == pages[1]);  // every pose of every tick, and every picture
}

TEST(Demo, SignalEndsItInTheMiddleOfAnEpisode) {
  const test::TemporaryFolder folder;
  const auto scenario = short_scenario(
      folder, "duration_s: 3600\nstart: {robot: [0, -1.9, 180]}\n");  // in the goal: composed has no pose
  const auto page = folder.path() / "demo.html";
  const test::ProgramRun run = test::run_program("timeout --signal=INT --kill-after=20 8 " + kProgram +
                                                 " demo --episodes 1 --localizer composed --scenario " +
                                                 scenario.string() + " --out " + page.string());
  EXPECT_NE(run.output.find("interrupted"), std::string::npos) << run.output;
  EXPECT_FALSE(std::filesystem::exists(page));
}

TEST(Demo, WhatCannotWorkIsRefusedBeforeThePlay) {
  const test::TemporaryFolder folder;
  const std::string page = (folder.path() / "demo.html").string();
  const std::string absent = (folder.path() / "absent/rows.csv").string();
  const std::string demo = kProgram + " demo --episodes 1 --out " + page;
  const struct {
    std::string arguments;
    const char* message;
    int exit_code;
  } cases[] = {{" --controllers fuzzy,fuzzy", "twice", 1},
               {" --controllers fuzzy,pbvs:/absent.yaml", "/absent.yaml", 1},
               {" --rows " + page, "is the file of --out", 1},
               {" --rows " + absent, "does not exist", 1},
               {" --seed -1", "--seed", 2},
               {" --episodes 0", "--episodes", 2}};
  for (const auto& [arguments, message, exit_code] : cases) {
    const test::ProgramRun run = test::run_program(demo + arguments);
    EXPECT_EQ(run.exit_code, exit_code) << arguments << run.output;
    EXPECT_NE(run.output.find(message), std::string::npos) << arguments << run.output;
    EXPECT_FALSE(std::filesystem::exists(page)) << arguments;
  }
}

TEST(Demo, PlaceThatCannotBeWrittenIsFoundBeforeTheWork) {
  const test::TemporaryFolder folder;
  const test::ProgramRun run =
      test::run_program(kProgram + " demo --out " + (folder.path() / "absent/demo.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("does not exist"), std::string::npos) << run.output;
}

TEST(Demo, UnknownController) {
  const test::TemporaryFolder folder;
  const auto page = folder.path() / "demo.html";
  const test::ProgramRun run =
      test::run_program(kProgram + " demo --episodes 1 --controllers fuzy --out " + page.string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("fuzy"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("pbvs[:FILE]"), std::string::npos) << run.output;
  EXPECT_FALSE(std::filesystem::exists(page));
}

TEST(Demo, ScenarioWithTheBallInsideTheRobot) {
  const test::TemporaryFolder folder;
  const auto scenario = short_scenario(folder, "start: {robot: [0, 0, 0], ball: [0.1, 0]}\n");
  const test::ProgramRun run = test::run_program(kProgram + " demo --scenario " + scenario.string() + " --out " +
                                                 (folder.path() / "demo.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("short.yaml"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("ball"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace movis
