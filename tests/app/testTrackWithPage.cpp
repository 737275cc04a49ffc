#include <gtest/gtest.h>

#include "support/chromium.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace movis {
namespace {

const std::string kTrack = std::string(MOVIS_PROGRAM) + " track --data " MOVIS_SOURCE_DIR "/data/images/field --out ";

TEST(TrackWithPage, OpensInABrowserWithoutErrors) {
  const test::TemporaryFolder folder;
  const auto page = folder.path() / "track.html";
  const test::ProgramRun run =
      test::run_program(kTrack + (folder.path() / "est.csv").string() + " --page " + page.string());
  ASSERT_EQ(run.exit_code, 0) << run.output;
  const test::ChromiumRun browser = test::open_in_chromium(page, folder.path());
  EXPECT_TRUE(browser.messages.empty()) << browser.messages.front();
  // Three pictures, panoramas and histograms of the selected frame were drawn.
  for (const char* part : {"M1", "M2", "M3", "spot A"}) EXPECT_NE(browser.dom.find(part), std::string::npos) << part;
  std::size_t drawings = 0;
  for (auto at = browser.dom.find("<svg"); at != std::string::npos; at = browser.dom.find("<svg", at + 1)) ++drawings;
  EXPECT_GE(drawings, 9U);
}

TEST(TrackWithPage, PlaceThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const auto estimates = folder.path() / "est.csv";
  const test::ProgramRun run =
      test::run_program(kTrack + estimates.string() + " --page " + (folder.path() / "absent/track.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("does not exist"), std::string::npos) << run.output;
  EXPECT_FALSE(std::filesystem::exists(estimates));
}

// No page stands without its table.
TEST(TrackWithPage, EstimatesThatCannotBeWritten) {
  const test::TemporaryFolder folder;
  const test::ProgramRun run =
      test::run_program(kTrack + "/dev/full --page " + (folder.path() / "track.html").string());
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("/dev/full: writing failed"), std::string::npos) << run.output;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TrackWithPage, SameFileAsTheEstimates) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "est.csv").string();
  const test::ProgramRun run = test::run_program(kTrack + file + " --page " + file);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.output.find("--page"), std::string::npos) << run.output;
}

}  // namespace
}  // namespace movis
