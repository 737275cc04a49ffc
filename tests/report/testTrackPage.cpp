#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "movis/report/track_page.h"
#include "report/page_test.h"
#include "support/chromium.h"
#include "support/temporary_folder.h"

namespace movis::report {
namespace {

using test::expect_error;
using test::TemporaryFolder;

using test::count;
using test::kInfinity;
using test::kNan;
using test::kNone;
using test::kPixelPng;

CameraPicture camera(const std::string& name, const Eigen::Vector2d& position) {
  BearingMark mark;
  mark.object = ObjectClass::ball;
  mark.azimuth_deg = 45.0;
  mark.elevation_deg = -8.0;
  mark.left_deg = 47.0;
  mark.right_deg = 43.0;
  mark.flags = kCutByBody;
  mark.centre_px = Eigen::Vector2d(10.0, 20.0);
  mark.centre_line = {{1.0, 2.0}, {3.0, 4.0}};
  CameraPicture picture;
  picture.name = name;
  picture.position = position;
  picture.image = {kPixelPng, 640, 480};
  picture.panorama = {{kPixelPng, 720, 150}, -50.0, 25.0};
  picture.marks = {mark};
  picture.histograms = {{ObjectClass::ball, std::vector<std::uint32_t>(360, 2), 3.0}};
  return picture;
}

// Everything is known and well: the ball 2 m ahead is measured 3 mm to the left, the robot 4 cm and 1° off.
TrackFrame complete_frame(int number) {
  TrackFrame frame;
  frame.set = "field";
  frame.frame = number;
  frame.label = "A";
  frame.cameras = {camera("M1", {-0.17, 0.1}), camera("M2", {0.17, 0.1}), camera("M3", {0.0, -0.2})};
  frame.ball_in_robot.status = PointStatus::ok;
  frame.ball_in_robot.point = {-0.003, 2.0, 0.11};
  frame.ball_in_robot.covariance = Eigen::Vector3d(1e-6, 4e-4, 1e-6).asDiagonal();
  frame.fix = Fix{FixStatus::ok, {1.04, 0.0, 1.0 * kPi / 180.0}, Eigen::Vector3d(1e-4, 4e-4, 1e-4).asDiagonal()};
  frame.tick_us = 912.3;
  frame.field = Field{1.75, 2.0, 0.5, 0.05, 2.0, 0.5, 0.5, 0.25, 0.01, Field::Goals::coloured, {}, {}, 0.0};
  frame.true_pose = Pose2{1.0, 0.0, 0.0};
  frame.true_ball_in_robot = Eigen::Vector2d(0.0, 2.0);
  frame.true_ball_in_field = Eigen::Vector2d(1.0, 2.0);
  return frame;
}

std::string write(const TemporaryFolder& folder, const TrackPage& page) {
  write_track_page(page, folder.path() / "page.html");
  return test::read(folder.path() / "page.html");
}

TEST(TrackPage, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  const std::string html = write(folder, {"MOVIS", {complete_frame(0)}, "1.2.3", "movis track"});
  test::expect_self_contained(html);
}

TEST(TrackPage, EscapesTextFromOutside) {
  const TemporaryFolder folder;
  TrackFrame frame = complete_frame(0);
  frame.label = "</script><script>alert('label')</script><!--";
  frame.set = "a \"set\"\n\xff";  // a byte that is not UTF-8
  const std::string html = write(folder, {"<b>&title", {frame}, "<v>", "movis --out '<dir>'"});
  EXPECT_EQ(html.find("alert('label')</script>"), kNone);
  EXPECT_NE(html.find(R"(\u003c/script>\u003cscript>alert('label'))"), kNone);
  EXPECT_EQ(test::data_in(html)[0]["label"], frame.label);
  EXPECT_EQ(test::data_in(html)[0]["set"], "a \"set\"\n\xef\xbf\xbd");
  EXPECT_NE(html.find("<title>&lt;b&gt;&amp;title</title>"), kNone);
  EXPECT_NE(html.find("<code>movis --out '&lt;dir&gt;'</code>"), kNone);
}

TEST(TrackPage, StatesTheErrors) {
  const TemporaryFolder folder;
  const auto frame = test::data_in(write(folder, {"MOVIS", {complete_frame(0)}, "", ""}))[0];
  EXPECT_DOUBLE_EQ(frame["ball_error"]["length"], 0.003);
  // 3 mm to the left at 2 m are atan(0.003 / 2) = 0.0859°, towards larger azimuths
  EXPECT_NEAR(frame["ball_error"]["direction_deg"], 0.0859, 5e-5);
  EXPECT_DOUBLE_EQ(frame["fix_error"]["length"], 0.04);
  EXPECT_DOUBLE_EQ(frame["fix_error"]["beta_deg"], 1.0);
  EXPECT_DOUBLE_EQ(frame["ball"]["measured"]["sigma"]["y"], 0.02);
  EXPECT_NEAR(frame["ball"]["measured"]["sigma"]["distance"], 0.02, 1e-4);  // the ball is ahead: along y
  EXPECT_NEAR(frame["ball"]["measured"]["sigma"]["direction_deg"], 0.0286 + 0.0005, 6e-4);  // 1 mm / 2 m
}

// At β = 0 the ball 2 m ahead has σ_y² = 4e-4 of itself and of the pose each; x is shaken by the heading: 2² · 1e-4.
TEST(TrackPage, CarriesTheBallIntoTheField) {
  const TemporaryFolder folder;
  TrackFrame frame = complete_frame(0);
  frame.ball_in_robot.point.x() = 0.0;
  frame.fix->world_from_robot = {1.0, 0.5, 0.0};
  const auto ball = test::data_in(write(folder, {"MOVIS", {frame}, "", ""}))[0]["ball_in_field"];
  EXPECT_EQ(ball["point"], nlohmann::json({1.0, 2.5}));
  EXPECT_NEAR(ball["covariance"][0], 1e-6 + 1e-4 + 4e-4, 1e-9);
  EXPECT_NEAR(ball["covariance"][1], 0.0, 1e-9);
  EXPECT_NEAR(ball["covariance"][2], 4e-4 + 4e-4, 1e-9);
}

TEST(TrackPage, EmbedsPictures) {
  const TemporaryFolder folder;
  TrackFrame frame = complete_frame(0);
  // RFC 4648's base64 of ff d8 ff e0 00 is /9j/4AA=
  frame.cameras[1].image = {{0xff, 0xd8, 0xff, 0xe0, 0x00}, 4, 3};
  const auto cameras = test::data_in(write(folder, {"MOVIS", {frame}, "", ""}))[0]["cameras"];
  EXPECT_EQ(cameras[0]["image"]["src"].get<std::string>().rfind("data:image/png;base64,iVBORw0KGgo", 0), 0U);
  EXPECT_EQ(cameras[1]["image"]["src"], "data:image/jpeg;base64,/9j/4AA=");
}

TEST(TrackPage, LeavesNoFileBehindWhereAPictureCannotBeShown) {
  const TemporaryFolder folder;
  TrackFrame frame = complete_frame(0);
  frame.cameras[2].image.bytes = {1, 2, 3};
  expect_error([&] { write(folder, {"MOVIS", {frame}, "", ""}); }, {"M3", "neither PNG nor JPEG"});
  frame.cameras[2].image = {kPixelPng, 0, 480};
  expect_error([&] { write(folder, {"MOVIS", {frame}, "", ""}); }, {"M3", "0×480"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TrackFrame unknown_numbers() {
  TrackFrame frame = complete_frame(1);
  frame.tick_us = kNan;
  frame.ball_in_robot.point = {kNan, kInfinity, 0.1};
  frame.fix->world_from_robot.beta = -kInfinity;
  frame.fix->covariance.setConstant(kNan);
  frame.true_ball_in_robot = Eigen::Vector2d(kNan, 0.0);
  frame.true_ball_in_field = Eigen::Vector2d(kNan, 0.0);
  frame.cameras[0].position.x() = kNan;
  frame.cameras[0].marks[0].azimuth_deg = kNan;
  frame.cameras[1].marks[0].left_deg = kInfinity;
  frame.cameras[1].marks[0].centre_px = Eigen::Vector2d(kNan, 1.0);
  frame.cameras[1].marks[0].centre_line = {{kNan, 1.0}};
  frame.cameras[2].histograms[0].threshold = kNan;
  return frame;
}

TEST(TrackPage, WritesNumbersThatAreNotFiniteAsNull) {
  const TemporaryFolder folder;
  const auto frame = test::data_in(write(folder, {"MOVIS", {unknown_numbers()}, "", ""}))[0];  // parses: it is JSON
  EXPECT_TRUE(frame["tick_us"].is_null());
  EXPECT_TRUE(frame["ball"]["measured"].is_null());
  EXPECT_TRUE(frame["fix"]["measured"].is_null());
  EXPECT_TRUE(frame["true_ball"].is_null());
  EXPECT_TRUE(frame["cameras"][0]["marks"][0]["azimuth_deg"].is_null());
}

// The number of frames, and what the first of them must show.
struct Drawn {
  int rows, pictures, panoramas, histograms, plans, close_ups, notices;
};

void expect_drawn(const TrackPage& page, const Drawn& expected) {
  const TemporaryFolder folder;
  write(folder, page);
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  const std::string& dom = run.dom;
  EXPECT_EQ(count(dom, R"(<tr class="frame)"), expected.rows);
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="picture")"), expected.pictures);
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="panorama")"), expected.panoramas);
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="histogram")"), expected.histograms);
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="plan")"), expected.plans);
  EXPECT_EQ(count(dom, R"(<figure class="close-up)"), expected.close_ups);
  EXPECT_EQ(count(dom, R"(<p class="notice">(No ball|No pose|Camera))"), expected.notices);
  test::expect_drawn_with_numbers(dom);
}

TEST(TrackPageInChromium, DrawsACompleteFrame) {
  expect_drawn({"MOVIS", {complete_frame(0), complete_frame(1), complete_frame(2)}, "", ""}, {3, 3, 3, 3, 1, 2, 0});
}

// A script after the page's own presses an arrow key, a button and a row, and writes down which frame is shown.
TEST(TrackPageInChromium, MovesBetweenFrames) {
  const TemporaryFolder folder;
  const std::string html =
      write(folder, {"MOVIS", {complete_frame(10), complete_frame(20), complete_frame(30)}, "", ""});
  const auto page = folder.write("moves.html", html + R"(<script>
    const shown = () => document.body.append("[" + document.getElementById("selected").textContent + "]");
    const press = key => document.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true}));
    shown();
    press("ArrowRight"); shown();
    document.getElementById("next").click(); shown();
    press("ArrowRight"); shown();
    document.querySelector("tr.frame button").click(); shown();
    const at = {clientX: 300, clientY: 0, bubbles: true};
    document.querySelector("svg.panorama").dispatchEvent(new MouseEvent("mousemove", at));
    document.querySelector("svg.panorama").dispatchEvent(new MouseEvent("mouseleave"));
  </script>)");
  const auto run = test::open_in_chromium(page, folder.path());
  test::expect_silent(run);
  EXPECT_NE(run.dom.find("[field, frame 10, spot A (1 of 3)][field, frame 20, spot A (2 of 3)]"
                         "[field, frame 30, spot A (3 of 3)][field, frame 30, spot A (3 of 3)]"
                         "[field, frame 10, spot A (1 of 3)]"),
            kNone);
}

TEST(TrackPageInChromium, SaysThatThereAreNoFrames) {
  const TemporaryFolder folder;
  write(folder, {"MOVIS", {}, "", ""});
  const auto run = test::open_in_chromium(folder.path() / "page.html", folder.path());
  test::expect_silent(run);
  EXPECT_NE(run.dom.find("This page holds no frames"), kNone);
}

TEST(TrackPageInChromium, DrawsWithoutFieldAndTruth) {
  TrackFrame frame = complete_frame(0);
  frame.fix.reset();
  frame.field.reset();
  frame.true_pose.reset();
  frame.true_ball_in_robot.reset();
  frame.true_ball_in_field.reset();
  expect_drawn({"MOVIS", {frame}, "", ""}, {1, 3, 3, 3, 1, 1, 0});
}

TEST(TrackPageInChromium, TellsWhatWentWrong) {
  TrackFrame frame = complete_frame(0);
  frame.ball_in_robot.status = PointStatus::one_camera;
  frame.fix->status = FixStatus::one_goal;
  frame.cameras[1] = {};
  frame.cameras[1].name = "M2";
  frame.cameras[1].lost = true;
  expect_drawn({"MOVIS", {frame}, "", ""}, {1, 2, 2, 2, 1, 0, 3});
}

TEST(TrackPageInChromium, DrawsWhatIsKnownOfUnknownNumbers) {
  expect_drawn({"MOVIS", {unknown_numbers()}, "", ""}, {1, 3, 3, 3, 1, 0, 0});
}

TEST(TrackPageInChromium, DrawsAFrameWithNothingInIt) {
  expect_drawn({"", {TrackFrame{}}, "", ""}, {1, 0, 0, 0, 1, 0, 1});
}

// The guard itself: a page whose script fails must not pass.
TEST(TrackPageInChromium, ReportsAScriptThatFails) {
  const TemporaryFolder folder;
  const auto page = folder.write("page.html", "<!DOCTYPE html><script>absent_function();</script>");
  EXPECT_EQ(test::open_in_chromium(page, folder.path()).messages.size(), 1U);
}

}  // namespace
}  // namespace movis::report
