#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "movis/report/measurement_page.h"
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

MeasurementCell cell(const char* level, const char* system, const char* knowledge) {
  MeasurementCell cell;
  cell.level = level;
  cell.differences = "all";
  cell.system = system;
  cell.knowledge = knowledge;
  cell.asked = 40;
  cell.measured = 39;
  cell.distance = {0.1234, 0.11, 0.14, 0.09, 0.2, 0.4, 1.5};
  cell.direction_deg = {0.5, 0.4, 0.6, 0.45, 0.55, 0.9, 1.2};
  cell.distance_free_bound = 0.02;
  cell.distance_bound = 0.01;
  cell.direction_bound_deg = 0.01;
  cell.mean_distance = {0.001, 0.05, 3.0, kNan};
  cell.mean_direction_deg = {0.001, 0.05, 3.0, kNan};
  cell.first_distance = {-0.001, 0.05, -3.0, kNan};
  cell.first_direction_deg = {-0.001, 0.05, -3.0, kNan};
  return cell;
}

MeasurementCell alone(const char* system, const char* differences, double mean) {
  MeasurementCell cell;
  cell.level = "bearings";
  cell.system = system;
  cell.knowledge = "nominal";
  cell.differences = differences;
  cell.distance.mean = mean;
  return cell;
}

// Two systems on two levels, with one more knowledge on images; two kinds of difference alone.
MeasurementPage complete_page() {
  MeasurementPage page;
  page.title = "MOVIS: measuring a ball";
  page.half_width = 0.5;
  page.step = 1.0;
  page.robot_radius = 0.1;
  page.under_robot = 1;
  page.points = {{-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}};
  for (const char* system : {"pairs", "vertical"}) {
    page.cells.push_back(cell("images", system, "nominal"));
    page.cells.push_back(cell("images", system, "corrected"));
    page.cells.push_back(cell("bearings", system, "nominal"));
    page.cells.push_back(alone(system, "yaw", 0.021));
    page.cells.push_back(alone(system, "principal_point", 0.042));
  }
  page.findings = {{"The order", {"pairs before vertical", "and so on"}}};
  return page;
}

std::string write(const TemporaryFolder& folder, const MeasurementPage& page) {
  write_measurement_page(page, folder.path() / "page.html");
  return test::read(folder.path() / "page.html");
}

TEST(MeasurementPage, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  test::expect_self_contained(write(folder, complete_page()));
}

TEST(MeasurementPage, EscapesTextFromOutside) {
  const TemporaryFolder folder;
  MeasurementPage page = complete_page();
  page.title = "<b>&title";
  page.findings[0].topic = "</script><script>alert('topic')</script>";
  const std::string html = write(folder, page);
  EXPECT_EQ(html.find("alert('topic')</script>"), kNone);
  EXPECT_NE(html.find("<title>&lt;b&gt;&amp;title</title>"), kNone);
  EXPECT_EQ(test::data_in(html)["findings"][0]["topic"], page.findings[0].topic);
}

TEST(MeasurementPage, WritesNumbersThatAreNotFiniteAsNull) {
  const TemporaryFolder folder;
  MeasurementPage page = complete_page();
  page.cells[0].distance.mean = kNan;
  page.cells[0].distance_bound = test::kInfinity;
  const auto data = test::data_in(write(folder, page));
  EXPECT_TRUE(data["cells"][0]["distance"]["mean"].is_null());
  EXPECT_TRUE(data["cells"][0]["distance_bound"].is_null());
  EXPECT_TRUE(data["cells"][0]["mean"]["distance"][3].is_null());
  EXPECT_EQ(data["cells"][0]["first"]["distance"][2], -3.0);
  EXPECT_TRUE(data["cells"][3]["mean"]["distance"].is_null());  // no map
}

TEST(MeasurementPage, MapOfAnotherLattice) {
  const TemporaryFolder folder;
  MeasurementPage page = complete_page();
  page.cells[1].mean_distance.pop_back();
  expect_error([&] { write(folder, page); }, {"pairs", "corrected", "3 numbers for 4 points"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.html"));
}

TEST(MeasurementPageInChromium, DrawsTablesFindingsAndMaps) {
  const TemporaryFolder folder;
  write(folder, complete_page());
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_EQ(count(run.dom, R"(<tr class="result)"), 6);
  EXPECT_EQ(count(run.dom, R"(<tr class="alone)"), 2);
  EXPECT_EQ(count(run.dom, R"(<li>pairs before vertical</li>)"), 1);
  EXPECT_EQ(count(run.dom, R"(<svg[^>]*class="plan")"), 4);       // two systems, distance and direction
  EXPECT_EQ(count(run.dom, R"(<rect[^>]*class="cell")"), 4 * 3);  // of four points
  EXPECT_EQ(count(run.dom, R"(<rect[^>]*class="cell unknown")"), 4);
  EXPECT_NE(run.dom.find("12.34"), kNone);  // cm
  EXPECT_NE(run.dom.find("39 of 40"), kNone);
  EXPECT_NE(run.dom.find("<td>4.20</td>"), kNone);  // alone
  EXPECT_NE(run.dom.find("5 points, 1.00 m apart over 1.0 m × 1.0 m; 1 under the robot left out."), kNone);
  test::expect_drawn_with_numbers(run.dom);
}

// A script after the page's own turns every control and writes down what the maps then show.
TEST(MeasurementPageInChromium, ControlsChangeTheMaps) {
  const TemporaryFolder folder;
  const std::string html = write(folder, complete_page());
  const auto page = folder.write("controls.html", html + R"(<script>
    const shown = () => document.body.append("[" + document.querySelectorAll("#maps svg.plan").length + " " +
        document.querySelector("#maps rect.cell title").textContent + "]");
    const turn = (id, value) => {
      const control = document.getElementById(id);
      control.value = value;
      control.dispatchEvent(new Event("change"));
      shown();
    };
    shown();
    turn("errors", "first");
    turn("form", "polar");
    turn("level", "bearings");
    document.getElementById("knowledge").value = "corrected";
    document.getElementById("knowledge").dispatchEvent(new Event("change"));
    document.body.append("[" + document.querySelector("#maps").textContent + "]");
  </script>)");
  const auto run = test::open_in_chromium(page, folder.path());
  test::expect_silent(run);
  const std::string where = "x −0.50 m, y −0.50 m (0.71 m at −135°): ";
  EXPECT_NE(run.dom.find("[4 " + where + "0.10 cm][4 " + where + "−0.10 cm][4 " + where + "−0.10 cm][4 " + where +
                         "−0.10 cm][This run has nothing of that kind.]"),
            kNone);
  test::expect_drawn_with_numbers(run.dom);
}

TEST(MeasurementPageInChromium, NeverMeasured) {
  const TemporaryFolder folder;
  MeasurementPage page = complete_page();
  page.cells[0].measured = 0;
  page.cells[0].distance = page.cells[0].direction_deg = {kNan, kNan, kNan, kNan, kNan, kNan, kNan};
  write(folder, page);
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_EQ(count(run.dom, R"(error: never measured<)"), 2);
  EXPECT_EQ(count(run.dom, R"(<svg[^>]*class="plan")"), 2);
  test::expect_drawn_with_numbers(run.dom);
}

TEST(MeasurementPageInChromium, SaysThatThereIsNothing) {
  const TemporaryFolder folder;
  write(folder, {});
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_NE(run.dom.find("This page holds no measurements."), kNone);
}

}  // namespace
}  // namespace movis::report
