#include <gtest/gtest.h>

#include "support/chromium.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

const std::string kProgram = MOVIS_PROGRAM;

TEST(Demo, PageOpensInABrowserWithoutErrors) {
  const test::TemporaryFolder folder;
  const auto page = folder.path() / "demo.html";
  const test::ProgramRun run = test::run_program(kProgram + " demo --out " + page.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const test::ChromiumRun browser = test::open_in_chromium(page, folder.path());
  EXPECT_TRUE(browser.messages.empty()) << browser.messages.front();
  // Three pictures, panoramas and histograms of the selected frame were drawn.
  for (const char* part : {"M1", "M2", "M3", "spot A"}) EXPECT_NE(browser.dom.find(part), std::string::npos) << part;
  std::size_t drawings = 0;
  for (auto at = browser.dom.find("<svg"); at != std::string::npos; at = browser.dom.find("<svg", at + 1)) ++drawings;
  EXPECT_GE(drawings, 9U);
}

TEST(Demo, PlaceThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const test::ProgramRun run =
      test::run_program(kProgram + " demo --out " + (folder.path() / "absent/demo.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("does not exist"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace movis
