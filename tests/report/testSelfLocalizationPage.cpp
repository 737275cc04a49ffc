#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "movis/report/self_localization_page.h"
#include "report/page_test.h"
#include "support/chromium.h"
#include "support/temporary_folder.h"

namespace movis::report {
namespace {

using test::count;
using test::expect_error;
using test::kNan;
using test::kNone;
using test::TemporaryFolder;

LocalizationCell cell(const char* goals, const char* knowledge, const char* localizer, int spot) {
  LocalizationCell cell;
  cell.goals = goals;
  cell.knowledge = knowledge;
  cell.localizer = localizer;
  cell.spot = spot;
  cell.asked = 40;
  cell.ok = 39;
  cell.mean = 0.1234;
  cell.low = 0.11;
  cell.high = 0.14;
  cell.largest = 0.5;
  cell.nees = 3.4;
  cell.within = 0.93;
  if (spot < 0) return cell;
  cell.first = {{"ok", 0.01, -0.02, 0.3}, {"one_goal"}, {"ok", 0.03, 0.01, -0.3}, {"ok", -0.01, 0.0, 0.1}};
  cell.position_by_heading = {0.02, kNan, 0.03, 0.01};
  return cell;
}

// Two spots and four headings; two localizers with coloured goals, one with white ones.
SelfLocalizationPage complete_page() {
  SelfLocalizationPage page;
  page.title = "MOVIS: self-localization";
  page.field.half_width = 1.75;
  page.field.half_length = 2.0;
  page.field.circle = 0.5;
  page.field.line = 0.05;
  page.field.Fd = 2.0;
  page.field.Fw = 0.5;
  page.field.goal_depth = 0.25;
  page.robot_radius = 0.25;
  page.far_off = 0.2;
  page.heading_step_deg = 90;
  page.coloured_draws = 3;
  page.white_draws = 1;
  page.spots = {{"A", {-1.0, 1.1}}, {"B", {0.0, 1.1}}};
  for (const char* knowledge : {"nominal", "corrected"}) {
    for (int spot = -1; spot < 2; ++spot) {
      page.cells.push_back(cell("coloured", knowledge, "composed", spot));
      page.cells.push_back(cell("coloured", knowledge, "nls", spot));
      page.cells.push_back(cell("white", knowledge, "nls", spot));
    }
  }
  page.observations = {
      {"Method 1 is better in X", {{"nominal", "0.5 times", "agrees"}, {"corrected", "2 times", "does not agree"}}}};
  page.findings = {{"Far off", {"none of them", "and so on"}}};
  return page;
}

std::string write(const TemporaryFolder& folder, const SelfLocalizationPage& page) {
  write_self_localization_page(page, folder.path() / "page.html");
  return test::read(folder.path() / "page.html");
}

TEST(SelfLocalizationPage, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  test::expect_self_contained(write(folder, complete_page()));
}

TEST(SelfLocalizationPage, EscapesTextFromOutside) {
  const TemporaryFolder folder;
  SelfLocalizationPage page = complete_page();
  page.title = "<b>&title";
  page.spots[0].name = "</script><script>alert('spot')</script>";
  const std::string html = write(folder, page);
  EXPECT_EQ(html.find("alert('spot')</script>"), kNone);
  EXPECT_NE(html.find("<title>&lt;b&gt;&amp;title</title>"), kNone);
  EXPECT_EQ(test::data_in(html)["spots"][0]["name"], page.spots[0].name);
}

TEST(SelfLocalizationPage, FixesAsErrorsOrStatus) {
  const TemporaryFolder folder;
  SelfLocalizationPage page = complete_page();
  page.cells[0].mean = kNan;
  const auto data = test::data_in(write(folder, page));
  EXPECT_TRUE(data["cells"][0]["mean"].is_null());
  const auto& first = data["cells"][3]["first"];  // the first cell of a spot
  EXPECT_EQ(first[0], (nlohmann::json{0.01, -0.02, 0.3}));
  EXPECT_EQ(first[1], "one_goal");
  EXPECT_TRUE(data["cells"][3]["mean_by_heading"][1].is_null());
}

TEST(SelfLocalizationPage, CellOfNoSpot) {
  const TemporaryFolder folder;
  SelfLocalizationPage page = complete_page();
  page.cells[1].spot = 2;
  expect_error([&] { write(folder, page); }, {"nls", "spot 2", "2"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.html"));
}

TEST(SelfLocalizationPageInChromium, DrawsTablesVerdictsAndSpots) {
  const TemporaryFolder folder;
  write(folder, complete_page());
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_EQ(count(run.dom, R"(<tr class="result)"), 2 * 3);  // rigs; localizers with coloured and with white goals
  EXPECT_EQ(count(run.dom, R"(<tr class="of-spot")"), 2);
  EXPECT_EQ(count(run.dom, R"(<tr class="observation")"), 1);
  EXPECT_EQ(count(run.dom, R"(class="verdict agrees")"), 1);
  EXPECT_EQ(count(run.dom, R"(class="verdict differs")"), 1);
  EXPECT_EQ(count(run.dom, R"(<li>none of them</li>)"), 1);
  EXPECT_EQ(count(run.dom, R"(<svg[^>]*class="chart")"), 2);
  EXPECT_EQ(count(run.dom, R"(<svg[^>]*class="plan")"), 2);
  EXPECT_EQ(count(run.dom, R"(<path class="mark")"), 2 * 3 * 2);  // X and Y of three fixes
  EXPECT_EQ(count(run.dom, R"(<line class="missing")"), 2);
  EXPECT_EQ(count(run.dom, R"(<circle class="place")"), 2 * 3);
  EXPECT_NE(run.dom.find("12.34"), kNone);
  EXPECT_NE(run.dom.find("97.5 %"), kNone);  // 39 of 40
  EXPECT_NE(run.dom.find("2 spots, a heading every 90°: 8 poses; 3 draws of the rig with coloured goals, 1 draws"),
            kNone);
  test::expect_drawn_with_numbers(run.dom);
}

// A script after the page's own turns every control and writes down what is then shown.
TEST(SelfLocalizationPageInChromium, ControlsChangeTheSpots) {
  const TemporaryFolder folder;
  const std::string html = write(folder, complete_page());
  const auto page = folder.write("controls.html", html + R"(<script>
    const shown = () => document.body.append("[" + document.querySelectorAll("#spots svg.chart").length + " " +
        document.getElementById("localizer").value + " " + document.querySelectorAll("#spots .mark").length + " " +
        document.querySelectorAll("#spots .goal.white").length + "]");
    const turn = (id, value) => {
      const control = document.getElementById(id);
      control.value = value;
      control.dispatchEvent(new Event("change"));
      shown();
    };
    shown();
    turn("curves", "mean");
    turn("localizer", "nls");
    turn("goals", "white");
    turn("knowledge", "nominal");
  </script>)");
  const auto run = test::open_in_chromium(page, folder.path());
  test::expect_silent(run);
  EXPECT_NE(run.dom.find("[2 composed 12 0][2 composed 6 0][2 nls 6 0][2 nls 6 4][2 nls 6 4]"), kNone);
  test::expect_drawn_with_numbers(run.dom);
}

TEST(SelfLocalizationPageInChromium, SaysThatThereIsNothing) {
  const TemporaryFolder folder;
  write(folder, {});
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_NE(run.dom.find("This page holds no fixes."), kNone);
}

}  // namespace
}  // namespace movis::report
