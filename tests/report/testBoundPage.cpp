#include <gtest/gtest.h>

#include "movis/report/bound_page.h"
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

BoundPlace place(double distance) {
  return {3, {"ok", distance, 0.01, 2.0 * distance}, {"ok", 3.0 * distance, 0.02, 4.0 * distance}};
}

// A map of 3 × 3 places and a polar one of two distances and four directions; one place is not observable without the
// floor, one not seen.
BoundPage small_page() {
  BoundPage page;
  page.title = "MOVIS";
  page.version = "movis 1.2.3";
  page.command = "movis bound";
  page.rig = "rig.yaml";
  page.contrast = 120.0;
  page.noise = 2.0;
  page.blur_px = 0.6;
  page.ball_radius = page.height = 0.11;
  page.cameras = {{"M1", {-0.17, 0.1}}, {"M2", {0.17, 0.1}}, {"M3", {0.0, -0.2}}};
  page.rows = {{1.0, "floor", 0.001, 0.002, 0.01, 0.02, 4, 4}, {2.0, "free", kNan, kNan, kNan, kNan, 0, 4}};
  page.step = 1.0;
  page.columns = 3;
  for (int i = 0; i < 9; ++i) page.cells.push_back(place(0.0012345 * (i + 1)));
  page.cells[2].free = {"unobservable", 0.0, 0.0, 0.0};
  page.cells[4] = {0, {"not_seen", 0.0, 0.0, 0.0}, {"not_seen", 0.0, 0.0, 0.0}};
  page.directions = 4;
  page.distances = {1.0, 2.0};
  for (int i = 0; i < 8; ++i) page.polar.push_back(place(0.001 * (i + 1)));
  return page;
}

std::string write(const TemporaryFolder& folder, const BoundPage& page) {
  write_bound_page(page, folder.path() / "page.html");
  return test::read(folder.path() / "page.html");
}

TEST(BoundPage, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  test::expect_self_contained(write(folder, small_page()));
}

TEST(BoundPage, EscapesTextFromOutside) {
  const TemporaryFolder folder;
  BoundPage page = small_page();
  page.rig = "</script><script>alert('rig')</script>";
  const std::string html = write(folder, page);
  EXPECT_EQ(html.find("alert('rig')</script>"), kNone);
  EXPECT_EQ(test::data_in(html)["rig"], page.rig);
}

TEST(BoundPage, HoldsTheMapsWithFourDigits) {
  const TemporaryFolder folder;
  const auto data = test::data_in(write(folder, small_page()));
  EXPECT_EQ(data["cells"]["floor"]["distance"][0], 0.001235);
  EXPECT_EQ(data["cells"]["floor"]["direction_deg"][0], 0.01);
  EXPECT_EQ(data["cells"]["cameras"][4], 0);
  EXPECT_EQ(data["polar"]["free"]["distance"][7], 0.024);
  EXPECT_EQ(data["rows"][0]["worst_distance"], 0.002);
}

TEST(BoundPage, WritesWhatIsNotKnownAsNull) {
  const TemporaryFolder folder;
  BoundPage page = small_page();
  page.cells[0].floor.distance = kNan;
  const auto data = test::data_in(write(folder, page));
  EXPECT_TRUE(data["cells"]["free"]["distance"][2].is_null());
  EXPECT_EQ(data["cells"]["free"]["status"][2], "unobservable");
  EXPECT_TRUE(data["cells"]["floor"]["distance"][0].is_null());
  EXPECT_TRUE(data["rows"][1]["mean_distance"].is_null());
}

TEST(BoundPage, RefusesMapsThatDoNotFit) {
  const TemporaryFolder folder;
  BoundPage page = small_page();
  page.cells.pop_back();
  expect_error([&] { write(folder, page); }, {"8 places", "3 columns"});
  page = small_page();
  page.polar.pop_back();
  expect_error([&] { write(folder, page); }, {"7 places", "2 distances", "4 directions"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

void expect_drawn(const std::string& dom) {
  EXPECT_EQ(count(dom, R"(<image [^>]*data:image/png)"), 4);  // distance and direction, from above and unrolled
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="key")"), 4);
  EXPECT_EQ(count(dom, R"(<tr class="ring")"), 2);
  EXPECT_EQ(count(dom, R"(<circle class="viewpoint")"), 6);
  test::expect_drawn_with_numbers(dom);
}

TEST(BoundPageInChromium, DrawsTheMaps) {
  const TemporaryFolder folder;
  write(folder, small_page());
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  expect_drawn(run.dom);
  EXPECT_NE(run.dom.find("σ of the distance"), kNone);
  EXPECT_NE(run.dom.find("contrast 120 grey levels"), kNone);
}

// A script after the page's own points at places, and presses the buttons.
TEST(BoundPageInChromium, TellsOfThePlacePointedAt) {
  const TemporaryFolder folder;
  const std::string html = write(folder, small_page());
  const auto page = folder.write("points.html", html + R"(<script>
    const shown = () => document.body.append("[" + document.getElementById("readout").textContent + "]");
    const point = (map, x, y) => {
      const surface = document.querySelectorAll(map + " .surface")[0];
      const box = surface.getBoundingClientRect();
      surface.dispatchEvent(new MouseEvent("mousemove",
          {clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true}));
      shown();
    };
    point("#above", 0.9, 0.9);    // x = 1, y = -1: place 2
    point("#above", 0.5, 0.5);    // the middle: place 4
    point("#unrolled", 0.1, 0.1); // 2 m at 180° to 270°: direction 2 of 0 to 3
    document.getElementById("free").click();
    point("#above", 0.9, 0.9);
    document.querySelector("#above .surface").dispatchEvent(new MouseEvent("mouseleave"));
  </script>)");
  const auto run = test::open_in_chromium(page, folder.path());
  test::expect_silent(run);
  expect_drawn(run.dom);
  EXPECT_NE(run.dom.find("[1.41 m at 315°: σ distance 3.70 mm, direction 0.0100°, position 7.41 mm (3 of 3 cameras)]"
                         "[0.00 m at 0°: seen by no camera (0 of 3 cameras)]"
                         "[2.00 m at 225°: σ distance 7.00 mm, direction 0.0100°, position 1.40 cm (3 of 3 cameras)]"
                         "[1.41 m at 315°: not observable (3 of 3 cameras)]"),
            kNone)
      << run.dom.substr(run.dom.rfind("</script>"));
}

TEST(BoundPageInChromium, DrawsWhereNothingIsObservable) {
  const TemporaryFolder folder;
  BoundPage page = small_page();
  for (auto* places : {&page.cells, &page.polar}) {
    for (BoundPlace& at : *places) at.floor = at.free = {"unobservable", 0.0, 0.0, 0.0};
  }
  page.free_first = true;
  write(folder, page);
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  expect_drawn(run.dom);
}

TEST(BoundPageInChromium, DrawsWithoutPolarMap) {
  const TemporaryFolder folder;
  BoundPage page = small_page();
  page.distances.clear();
  page.polar.clear();
  write(folder, page);
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_EQ(count(run.dom, R"(<image )"), 2);
}

}  // namespace
}  // namespace movis::report
