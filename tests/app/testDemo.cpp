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

TEST(Demo, SameSeedSameRows) {
  const test::TemporaryFolder folder;
  std::string rows[2];
  for (std::string& text : rows) {
    const auto file = folder.path() / "rows.csv";
    const test::ProgramRun run = test::run_program(kProgram + " demo --episodes 1 --seed 7 --controllers pbvs --rows " +
                                                   file.string() + " --out " + (folder.path() / "demo.html").string());
    ASSERT_EQ(run.exit_code, 0) << run.output;
    text = content(file);
  }
  EXPECT_FALSE(rows[0].empty());
  EXPECT_EQ(rows[0], rows[1]);
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
  const std::string data = MOVIS_SOURCE_DIR "/data/";
  const auto scenario =
      folder.write("scenario.yaml", "rig: " + data + "rigs/movis.yaml\nrobot: " + data +
                                        "robots/miniature.yaml\nlook: " + data + "looks/hall.yaml\nfield: " + data +
                                        "fields/paper.yaml\nstart: {robot: [0, 0, 0], ball: [0.1, 0]}\n");
  const test::ProgramRun run = test::run_program(kProgram + " demo --scenario " + scenario.string() + " --out " +
                                                 (folder.path() / "demo.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("scenario.yaml"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("ball"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace movis
