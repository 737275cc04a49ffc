#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "movis/report/episode_page.h"
#include "report/page_test.h"
#include "report/synthetic_episodes.h"
#include "support/chromium.h"
#include "support/temporary_folder.h"

namespace movis::report {
namespace {

using test::count;
using test::expect_error;
using test::kInfinity;
using test::kNan;
using test::kNone;
using test::TemporaryFolder;

const EncodedImage kPicture = {test::kPixelPng, 640, 480};

EpisodePage complete_page() {
  return test::synthetic_page({"fuzzy", "pbvs"}, 3, kPicture);
}

// A page of one episode with one tick, in which everything is known.
EpisodePage small_page() {
  EpisodePage page;
  page.field = test::paper_field();
  page.camera_names = {"M1"};
  EpisodeTick tick;
  tick.true_pose = {1.0, -0.5, radians(179.0)};
  tick.true_ball = {0.5, 1.0, 0.11};
  tick.pose = Pose2{1.03, -0.46, radians(-179.0)};
  tick.ball = Eigen::Vector2d(0.56, 1.08);
  tick.vx = 0.3;
  tick.vy = -0.4;
  tick.omega = radians(-90.0);
  tick.status = "ok";
  tick.signals = {0.25, 123.456};
  Episode episode;
  episode.contender = "fuzzy";
  episode.seed = 7;
  episode.outcome = "goal";
  episode.duration_s = 4.0;
  episode.signal_names = {"shoot", "e_x"};
  episode.signal_units = {"", "mm"};
  episode.ticks = {tick};
  page.episodes = {episode};
  return page;
}

std::string write(const TemporaryFolder& folder, const EpisodePage& page) {
  write_episode_page(page, folder.path() / "page.html");
  return test::read(folder.path() / "page.html");
}

nlohmann::json written(const EpisodePage& page) {
  const TemporaryFolder folder;
  return test::data_in(write(folder, page));
}

TEST(EpisodePage, NeedsNothingBesideIt) {
  const TemporaryFolder folder;
  test::expect_self_contained(write(folder, complete_page()));
}

TEST(EpisodePage, EscapesTextFromOutside) {
  const TemporaryFolder folder;
  EpisodePage page = small_page();
  const std::string name = "</script><script>alert('name')</script><!-- \"&";
  page.title = "<b>&title";
  page.episodes[0].contender = name;
  page.episodes[0].signal_names[0] = "shoot\xff";  // a byte that is not UTF-8
  const std::string html = write(folder, page);
  EXPECT_EQ(html.find("alert('name')</script>"), kNone);
  EXPECT_NE(html.find("<title>&lt;b&gt;&amp;title</title>"), kNone);
  EXPECT_EQ(test::data_in(html)["episodes"][0]["contender"], name);
  EXPECT_EQ(test::data_in(html)["episodes"][0]["signals"][0]["name"], "shoot\xef\xbf\xbd");
}

// (3, 4) cm are 5 cm, (6, 8) cm are 10 cm; from 179° on to −179° it is 2°.
TEST(EpisodePage, StatesTheErrors) {
  const auto believed = written(small_page())["episodes"][0]["believed"];
  EXPECT_EQ(believed["pose_error_m"], nlohmann::json({0.05}));
  EXPECT_EQ(believed["beta_error_deg"], nlohmann::json({2.0}));
  EXPECT_EQ(believed["ball_error_m"], nlohmann::json({0.1}));
}

TEST(EpisodePage, RoundsToWhatAScreenShows) {
  EpisodePage page = small_page();
  page.episodes[0].ticks[0].true_pose.x = 1.0 / 3.0;
  page.episodes[0].seed = 18446744073709551615U;
  const auto episode = written(page)["episodes"][0];
  EXPECT_EQ(episode["truth"]["x"], nlohmann::json({0.333}));
  EXPECT_EQ(episode["signals"][1]["values"], nlohmann::json({123.5}));
  EXPECT_EQ(episode["command"]["speed"], nlohmann::json({0.5}));
  EXPECT_EQ(episode["command"]["turn_rate_deg"], nlohmann::json({-90.0}));
  EXPECT_EQ(episode["seed"], "18446744073709551615") << "more digits than a number of JavaScript has";
}

TEST(EpisodePage, GathersTicksWhoseDriveWasNotOk) {
  EpisodePage page = small_page();
  page.episodes[0].ticks.resize(5, page.episodes[0].ticks[0]);
  for (const int i : {1, 2}) page.episodes[0].ticks[i].status = "stale_pose";
  page.episodes[0].ticks[3].status = "stale_ball";
  page.episodes[0].ticks[4].kick = true;
  const auto episode = written(page)["episodes"][0];
  EXPECT_EQ(episode["troubles"], nlohmann::json::parse(R"([{"status": "stale_pose", "from": 1, "to": 2},
                                                           {"status": "stale_ball", "from": 3, "to": 3}])"));
  EXPECT_EQ(episode["kick_ticks"], nlohmann::json({4}));
}

TEST(EpisodePage, LeavesNoFileBehindWherePartsDoNotFit) {
  const TemporaryFolder folder;
  const auto expect_refused = [&folder](auto spoil, std::initializer_list<const char*> parts) {
    EpisodePage page = small_page();
    page.episodes[0].ticks.push_back(page.episodes[0].ticks[0]);
    spoil(page);
    expect_error([&] { write(folder, page); }, parts);
  };
  expect_refused([](EpisodePage& page) { page.episodes[0].signal_units.pop_back(); }, {"fuzzy", "seed 7", "1 units"});
  expect_refused([](EpisodePage& page) { page.episodes[0].ticks[1].signals = {1.0}; }, {"fuzzy", "1 signals"});
  expect_refused([](EpisodePage& page) { page.episodes[0].ticks[1].time_s = -1.0; }, {"seed 7", "-1 s after"});
  expect_refused([](EpisodePage& page) { page.episodes[0].ticks[1].time_s = kNan; }, {"seed 7", "nan s after"});
  expect_refused([](EpisodePage& page) { page.episodes[0].views = {{0.0, {}}}; }, {"0 pictures", "1 cameras"});
  expect_refused([](EpisodePage& page) { page.episodes.push_back(page.episodes[0]); }, {"two episodes", "seed 7"});
  expect_refused(
      [](EpisodePage& page) {
        page.episodes[0].views = {{0.0, {{{1, 2, 3}, 4, 4}}}};
      },
      {"M1", "neither PNG"});
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// Everything that may be not finite is.
EpisodePage unknown_numbers() {
  EpisodePage page = test::synthetic_page({"fuzzy", "pbvs"}, 1, kPicture);
  page.robot_radius = kNan;
  page.ball_radius = kInfinity;
  page.obstacles = {{{kNan, 0.0}, 0.1}, {{0.0, 0.0}, kNan}};
  for (ContenderSummary& summary : page.summaries) {
    summary.rate_low = summary.rate_high = summary.median_time_s = kNan;
    summary.pose_error_m = summary.ball_error_m = kInfinity;
  }
  for (Episode& episode : page.episodes) {
    episode.duration_s = kNan;
    for (EpisodeTick& tick : episode.ticks) {
      tick.true_pose.x = kNan;
      tick.true_ball.y() = kInfinity;
      tick.pose = Pose2{0.0, kNan, kInfinity};
      tick.ball = Eigen::Vector2d(kNan, 0.0);
      tick.vx = tick.omega = kNan;
      for (double& signal : tick.signals) signal = -kInfinity;
    }
    for (EpisodeView& view : episode.views) view.time_s = 0.0;
  }
  page.summaries[1].episodes = 0;
  return page;
}

TEST(EpisodePage, WritesNumbersThatAreNotFiniteAsNull) {
  const auto data = written(unknown_numbers());  // parses: it is JSON
  EXPECT_TRUE(data["robot_radius"].is_null());
  EXPECT_TRUE(data["obstacles"][0]["position"].is_null());
  EXPECT_TRUE(data["summaries"][0]["rate_low"].is_null());
  EXPECT_TRUE(data["summaries"][1]["rate"].is_null()) << "of no episodes";
  EXPECT_TRUE(data["episodes"][0]["believed"]["pose_error_m"][0].is_null());
  EXPECT_TRUE(data["episodes"][0]["command"]["speed"][0].is_null());
  EXPECT_TRUE(data["episodes"][0]["signals"][0]["values"][0].is_null());
}

// What the page must hold when it has been opened.
struct Drawn {
  int contenders, starts, intervals, plans, views, charts;
};

std::string open(const TemporaryFolder& folder, const std::filesystem::path& page) {
  const auto run = test::open_in_chromium(page, folder.path());
  test::expect_silent(run);
  return run.dom;
}

std::string expect_drawn(const EpisodePage& page, const Drawn& expected) {
  const TemporaryFolder folder;
  write(folder, page);
  std::string dom = open(folder, folder.path() / "page.html");
  EXPECT_EQ(count(dom, R"(<tr class="contender")"), expected.contenders);
  EXPECT_EQ(count(dom, R"(<tr class="start)"), expected.starts);
  EXPECT_EQ(count(dom, R"(<line class="range"[^>]*y1="11" y2="11")"), expected.intervals);
  EXPECT_EQ(count(dom, R"(<svg[^>]*class="plan")"), expected.plans);
  EXPECT_EQ(count(dom, R"(<div class="view")"), expected.views);
  EXPECT_EQ(count(dom, R"(<figure class="chart")"), expected.charts);
  test::expect_drawn_with_numbers(dom);
  return dom;
}

// Weights of one contender, errors in two units of the other; three charts of estimates and two of commands each.
TEST(EpisodePageInChromium, DrawsACompletePage) {
  EpisodePage page = test::synthetic_page({"fuzzy", "pbvs"}, 3, kPicture);
  Episode& fuzzy = page.episodes[0];
  fuzzy.outcome = "ball_out";
  fuzzy.duration_s = 12.34;
  fuzzy.kicks = 3;
  EpisodeTick& last = fuzzy.ticks.back();
  last.pose = Pose2{last.true_pose.x + 0.07, last.true_pose.y, last.true_pose.beta + radians(1.5)};
  last.ball = Eigen::Vector2d(last.true_ball.x(), last.true_ball.y() - 0.09);
  last.measured_pose = true;
  last.measured_ball = false;
  last.status = "stale_ball";
  last.signals = {0.125, 0.25, 0.625};
  page.episodes[1].ticks.resize(fuzzy.ticks.size() / 2);  // fuzzy's last tick is the start's
  const auto views = static_cast<int>(page.episodes[0].views.size() + page.episodes[1].views.size());
  const std::string dom = expect_drawn(page, {2, 3, 2, 2, views, 1 + 2 + 2 * (3 + 2)});
  EXPECT_NE(dom.find("55 – 88"), kNone) << "the interval of the rate";
  EXPECT_NE(dom.find("ball out</span><span> after 12.34 s, 3 kicks</span>"), kNone);
  EXPECT_NE(dom.find("Pose off by 7.0 cm and 1.5°, measured"), kNone);
  EXPECT_NE(dom.find("Ball off by 9.0 cm, carried along"), kNone);
  EXPECT_NE(dom.find("drive: stale ball"), kNone);
  EXPECT_NE(dom.find(R"(<span>shoot</span><b class="value">0.63</b>)"), kNone);
  EXPECT_EQ(count(dom, R"(<img [^>]*src="data:image/png;base64,)"), 3 * views);
}

TEST(EpisodePageInChromium, ShowsNamesAsTheyAre) {
  const TemporaryFolder folder;
  EpisodePage page = small_page();
  page.summaries = {{"<b>\"fuzzy\" & 'co'</b>", 1, 1, 0.2, 1.0, {{"<i>lost</i>", 0}}, 4.0, 0.05, 0.1}};
  page.episodes[0].contender = page.summaries[0].contender;
  page.episodes[0].signal_names[0] = "<u>shoot</u>";
  page.episodes[0].outcome = "</script><u>";
  const std::string dom = [&] {
    write(folder, page);
    return open(folder, folder.path() / "page.html");
  }();
  EXPECT_NE(dom.find("<h4>&lt;b&gt;\"fuzzy\" &amp; 'co'&lt;/b&gt;"), kNone);
  EXPECT_NE(dom.find("<span>&lt;u&gt;shoot&lt;/u&gt;</span>"), kNone);
  EXPECT_NE(dom.find("&lt;i&gt;lost&lt;/i&gt;</th>"), kNone);
  EXPECT_EQ(count(dom, "<(b|i|u)>[^<]*(fuzzy|lost|shoot)"), 0);
}

// A script after the page's own uses keys and buttons, and lets pass as much time as the test wants.
TEST(EpisodePageInChromium, PlaysByKeysAndButtons) {
  const TemporaryFolder folder;
  EpisodePage page = small_page();
  page.episodes[0].ticks.resize(31, page.episodes[0].ticks[0]);
  for (int i = 0; i <= 30; ++i) page.episodes[0].ticks[i].time_s = 0.1 * i;
  page.episodes.push_back(page.episodes[0]);
  page.episodes[1].seed = 8;
  const auto played = folder.write("played.html", write(folder, page) + R"(<script>
    let frame = () => {};
    window.requestAnimationFrame = next => { frame = next; };
    const element = id => document.getElementById(id);
    const log = (...ids) => document.body.append("[" + ids.map(id => element(id).textContent).join("|") + "]");
    const press = (key, more) => document.dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, ...more}));
    log("selected", "time", "play");
    press("ArrowLeft"); log("time");
    press("ArrowLeft", {shiftKey: true}); log("time");
    press("ArrowRight"); log("time");
    press(" "); frame(1000); frame(1500); log("time", "play");
    element("speed").value = "2"; frame(1700); log("time");
    press(" "); frame(9000); log("time", "play");
    element("play").click(); frame(10000); frame(60000); log("time", "play");
    element("slider").value = 4; element("slider").dispatchEvent(new Event("input")); log("time");
    document.querySelector("tr.start:last-child button").click(); log("selected", "time");
    element("previous").click(); log("selected");
  </script>)");
  const std::string dom = open(folder, played);
  EXPECT_NE(dom.find("[Seed 7 (1 of 2)|3.00 s of 3.00 s|▶ Play][2.90 s of 3.00 s][1.90 s of 3.00 s][2.00 s of 3.00 s]"
                     "[2.50 s of 3.00 s|❚❚ Pause][2.90 s of 3.00 s][2.90 s of 3.00 s|▶ Play]"
                     "[3.00 s of 3.00 s|▶ Play][0.40 s of 3.00 s]"
                     "[Seed 8 (2 of 2)|3.00 s of 3.00 s][Seed 7 (1 of 2)]"),
            kNone)
      << dom.substr(dom.rfind("</script>"));
}

TEST(EpisodePageInChromium, SaysThatThereAreNoEpisodes) {
  const std::string dom = expect_drawn({}, {0, 0, 0, 0, 0, 0});
  EXPECT_NE(dom.find("This page holds no episodes"), kNone);
}

TEST(EpisodePageInChromium, ShowsOutcomesWithoutEpisodes) {
  EpisodePage page = complete_page();
  page.episodes.clear();
  expect_drawn(page, {2, 0, 2, 0, 0, 0});
}

TEST(EpisodePageInChromium, DrawsOneContenderWithoutViewsAndSummary) {
  EpisodePage page = test::synthetic_page({"fuzzy"}, 2, kPicture);
  page.summaries.clear();
  for (Episode& episode : page.episodes) episode.views.clear();
  const std::string dom = expect_drawn(page, {0, 2, 0, 1, 0, 1 + 3 + 2});
  EXPECT_NE(dom.find("No pictures of this episode are stored"), kNone);
}

TEST(EpisodePageInChromium, DrawsAStartThatOneContenderLacks) {
  EpisodePage page = complete_page();
  page.episodes.erase(page.episodes.begin());
  const std::string dom = expect_drawn(page, {2, 3, 2, 1, static_cast<int>(page.episodes[0].views.size()), 2 + 3 + 2});
  EXPECT_EQ(count(dom, "No episode from this start"), 5 + 1) << "in every section, and in the script";
}

TEST(EpisodePageInChromium, DrawsAnEpisodeWithoutTicks) {
  EpisodePage page = complete_page();
  for (Episode& episode : page.episodes) episode.ticks.clear();
  const auto views = static_cast<int>(page.episodes[0].views.size() + page.episodes[1].views.size());
  expect_drawn(page, {2, 3, 2, 2, views, 1 + 2 + 2 * (3 + 2)});
}

TEST(EpisodePageInChromium, DrawsAnEpisodeWithNothingInIt) {
  EpisodePage page;
  page.episodes = {Episode{}};
  expect_drawn(page, {0, 1, 0, 1, 0, 3 + 2});
}

TEST(EpisodePageInChromium, DrawsWhatIsKnownOfUnknownNumbers) {
  const EpisodePage page = unknown_numbers();
  const auto views = static_cast<int>(page.episodes[0].views.size() + page.episodes[1].views.size());
  const std::string dom = expect_drawn(page, {2, 1, 0, 2, views, 1 + 2 + 2 * (3 + 2)});
  EXPECT_NE(dom.find("Pose not known"), kNone);
}

}  // namespace
}  // namespace movis::report
