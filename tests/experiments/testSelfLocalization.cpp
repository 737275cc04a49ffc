// The self-localization experiment: how a fix is judged and rows are summed up by hand, and that rows of rendered
// images replay.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/experiments/self_localization.h"
#include "movis/localization/localizer.h"
#include "support/temporary_folder.h"

namespace movis::experiments {
namespace {

constexpr auto kColoured = Field::Goals::coloured;
constexpr auto kWhite = Field::Goals::white;

std::string content(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// The same cameras with a quarter of the pixels: what is asked here does not depend on how fine they are.
omni::Rig at_half_resolution(omni::Rig rig) {
  for (omni::Camera& camera : rig.cameras) {
    camera.width /= 2;
    camera.height /= 2;
    auto& model = std::get<omni::Hyperboloid>(camera.model);
    model.fu *= 0.5;
    model.fv *= 0.5;
    model.u0 = 0.5 * (model.u0 - 0.5);  // (0, 0) is the middle of a pixel
    model.v0 = 0.5 * (model.v0 - 0.5);
  }
  return rig;
}

// The shipped experiment, as small as one likes: two spots, two headings.
SelfLocalizationSettings small_settings() {
  SelfLocalizationSettings settings = read_self_localization(data_file("experiments/self-localization.yaml"), true);
  settings.spots = {settings.spots[1], settings.spots[4]};
  settings.rig = at_half_resolution(settings.rig);
  settings.heading_step_deg = 180;
  settings.calibration_points = 12;
  settings.coloured_draws = 2;
  settings.white_draws = 1;
  return settings;
}

SelfLocalizationRow judged(const Fix& fix, const Pose2& truth) {
  SelfLocalizationRow row;
  judge(fix, truth, row);
  return row;
}

Fix fix_at(const Pose2& pose) {
  Fix fix;
  fix.status = FixStatus::ok;
  fix.world_from_robot = pose;
  fix.covariance = Eigen::Vector3d(0.01, 0.04, 0.0025).asDiagonal();
  return fix;
}

// 3-4-5 cm off; 0.3 m at σ 0.1 m and 0.4 m at σ 0.2 m and 0.05 rad at σ 0.05 rad: 9 + 4 + 1 = 14.
TEST(SelfLocalizationJudge, ErrorsSigmasAndNees) {
  const SelfLocalizationRow row = judged(fix_at({1.3, 0.6, -kPi + 0.02}), {1.0, 1.0, kPi - 0.03});
  EXPECT_EQ(row.status, "ok");
  EXPECT_NEAR(row.error.x(), 0.3, 1e-12);
  EXPECT_NEAR(row.error.y(), -0.4, 1e-12);
  EXPECT_NEAR(row.error.z(), 0.05, 1e-12);
  EXPECT_NEAR(row.distance(), 0.5, 1e-12);
  EXPECT_NEAR((row.sigma - Eigen::Vector3d(0.1, 0.2, 0.05)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(row.nees, 14.0, 1e-9);
}

// (x, y, β) and (−x, −y, β + π) are the same on a field that looks the same from both ends. Turning changes the signs
// of x and y, and so those of their covariances with β.
TEST(SelfLocalizationJudge, HalfTurnOfASymmetricField) {
  const Pose2 truth{1.0, 0.5, 0.2};
  Fix fix = fix_at({-1.1, -0.5, 0.3 - kPi});
  EXPECT_NEAR(judged(fix, truth).distance(), std::hypot(2.1, 1.0), 1e-12) << "not said to be symmetric: it counts";
  fix.symmetric = true;
  fix.covariance = Eigen::Vector3d(0.01, 0.01, 0.01).asDiagonal();
  fix.covariance(0, 2) = fix.covariance(2, 0) = -0.005;
  const SelfLocalizationRow row = judged(fix, truth);
  EXPECT_TRUE(row.symmetric);
  EXPECT_NEAR((row.error - Eigen::Vector3d(0.1, 0.0, 0.1)).norm(), 0.0, 1e-12);
  // e = (0.1, 0, 0.1). C of (x, β), turned: [0.01 0.005; 0.005 0.01], of determinant 7.5e-5;
  // eᵀC⁻¹e = 0.01·(0.01 − 2·0.005 + 0.01)/7.5e-5 = 4/3.
  EXPECT_NEAR(row.nees, 4.0 / 3.0, 1e-9);
  fix.world_from_robot = {1.1, 0.5, 0.3};  // not turned: C as it is, 0.01·(0.01 + 2·0.005 + 0.01)/7.5e-5 = 4
  EXPECT_NEAR(judged(fix, truth).nees, 4.0, 1e-9);
}

TEST(SelfLocalizationJudge, CovarianceWithoutInverse) {
  Fix fix = fix_at({0.0, 0.0, 0.0});
  fix.covariance.setZero();
  EXPECT_TRUE(std::isnan(judged(fix, {0.1, 0.0, 0.0}).nees));
}

TEST(SelfLocalizationJudge, NoPose) {
  Fix fix;
  fix.status = FixStatus::one_goal;
  const SelfLocalizationRow row = judged(fix, {1.0, 0.0, 0.0});
  EXPECT_EQ(row.status, "one_goal");
  EXPECT_EQ(row.error, Eigen::Vector3d::Zero());
}

// Nine spots, 72 headings: the paper's 648 poses.
TEST(SelfLocalizationSettings, ThePapersPoses) {
  const auto settings = read_self_localization(data_file("experiments/self-localization.yaml"), false);
  EXPECT_EQ(settings.spots.size(), 9U);
  EXPECT_EQ(settings.headings(), 72);
  EXPECT_EQ(settings.spots.front().name, "A");
  EXPECT_EQ(settings.spots.front().place, Eigen::Vector2d(-1.0, 1.1));
  EXPECT_EQ(settings.spots.back().place, Eigen::Vector2d(1.0, -1.1));
  EXPECT_GE(settings.coloured_draws, kFewestDraws) << "intervals are by draws";
}

TEST(SelfLocalizationSettings, WhiteGoalsAreForThoseThatCan) {
  const auto settings = small_settings();
  const auto coloured = localizers_for(settings, kColoured);
  EXPECT_EQ(coloured, localization::localizer_names());
  const auto white = localizers_for(settings, kWhite);
  EXPECT_EQ(std::count(white.begin(), white.end(), "composed"), 0);
  EXPECT_EQ(std::count(white.begin(), white.end(), "nls"), 1);
}

std::filesystem::path changed(const test::TemporaryFolder& folder, const std::string& from, const std::string& to) {
  std::string text = content(data_file("experiments/self-localization.yaml"));
  for (auto at = text.find("../"); at != std::string::npos; at = text.find("../", at)) {
    text.replace(at, 3, data_directory().string() + "/");
  }
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return folder.write("changed.yaml", text.replace(at, from.size(), to));
}

TEST(SelfLocalizationSettings, AreReadStrictly) {
  const struct {
    const char *from, *to;
    std::initializer_list<const char*> message;
  } cases[] = {{"\nspots:", "\nspotz:", {"changed.yaml", "spotz", "spots"}},
               {"experiment: self-localization", "experiment: measurement", {"experiment", "self-localization"}},
               {"name: A, place: [-1.0, 1.1]", "name: A, place: [-1.6, 1.1]", {"spots", "0.25 m in radius", "1.75"}},
               {"name: A,", "name: \"A,B\",", {"name", "comma"}},
               {"name: I,", "name: A,", {"changed.yaml:19", "spots[8].name", "'A'"}},
               {"heading_step_deg: 5\n", "heading_step_deg: 7\n", {"heading_step_deg", "divide 360"}},
               {"half_width: 4.0", "half_width: 0", {"half_width", "out of range"}},
               {"\ncoloured_draws: 10", "\ntriangulation: pears\ncoloured_draws: 10", {"pears", "pairs"}},
               {"fields/paper.yaml", "fields", {"field", "is a folder"}},
               {"rigs/movis.yaml", "rigs/absent.yaml", {"rig", "does not exist"}},
               {"quick: {heading_step_deg: 45", "quick: {heading_step_deg: 50", {"heading_step_deg", "50"}},
               {"quick: {heading_step_deg", "quick: {headings", {"quick", "headings"}}};
  for (const auto& [from, to, message] : cases) {
    const test::TemporaryFolder folder;
    const auto file = changed(folder, from, to);
    test::expect_error([&] { read_self_localization(file, false); }, message);
  }
  const test::TemporaryFolder folder;
  std::string text = content(changed(folder, "\ncoloured_draws: 10", "\ncoloured_draws: 0"));
  const auto at = text.find("\nwhite_draws: 10");
  ASSERT_NE(at, std::string::npos);
  const auto file = folder.write("nothing.yaml", text.replace(at, 16, "\nwhite_draws: 0"));
  test::expect_error([&] { read_self_localization(file, false); }, {"nothing.yaml", "nothing to measure"});
}

SelfLocalizationRow row(std::string_view localizer, int draw, int spot, int heading, double x, double y,
                        const char* status = "ok") {
  SelfLocalizationRow row;
  row.localizer = localizer;
  row.knowledge = Knowledge::corrected;
  row.draw = draw;
  row.spot = spot;
  row.heading = heading;
  row.status = status;
  row.error << x, y, 0.01;
  row.nees = 3.0;
  return row;
}

// Of four answers one is none: errors 3-4-5 cm, 0 and 30 cm, the last far off. Mean 35/3 cm; |x| 11, |y| 4/3 cm.
TEST(SelfLocalizationSummary, CellsByHand) {
  const auto settings = small_settings();
  auto wild = row("composed", 0, 1, 1, -0.30, 0.0);
  wild.nees = 100.0;
  const auto summary =
      summarize_self_localization(settings, 1,
                                  {row("composed", 0, 0, 0, 0.03, -0.04), row("composed", 0, 0, 1, 0.0, 0.0),
                                   row("composed", 0, 1, 0, 9.0, 9.0, "one_goal"), wild});
  const auto* all = summary.find(kColoured, Knowledge::corrected, "composed", kAllSpots);
  ASSERT_NE(all, nullptr);
  EXPECT_EQ(all->asked, 4);
  EXPECT_EQ(all->ok, 3);
  EXPECT_EQ(all->far_off, 1);
  EXPECT_NEAR(all->position.mean, 0.35 / 3.0, 1e-12);
  EXPECT_NEAR(all->position.largest, 0.30, 1e-12);
  EXPECT_NEAR(all->x.mean, 0.11, 1e-12);
  EXPECT_NEAR(all->y.mean, 0.04 / 3.0, 1e-12);
  EXPECT_NEAR(all->nees, 106.0 / 3.0, 1e-12);
  EXPECT_NEAR(all->within, 2.0 / 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(all->position.mean_interval.low)) << "one draw tells nothing of chance";
  const auto* spot = summary.find(kColoured, Knowledge::corrected, "composed", 1);
  ASSERT_NE(spot, nullptr);
  EXPECT_EQ(spot->first.size(), 2U);
  EXPECT_TRUE(std::isnan(spot->position_by_heading.at(0)));
  EXPECT_NEAR(spot->position_by_heading.at(1), 0.30, 1e-12);
}

// Cases that one of both did not answer do not count: (1 + 3)/(2 + 4). Of two draws there is no interval. Of three like
// either, k of the first kind and 6 − k of the other are picked with the probability (6 over k)/64, and give
// (18 − 2k)/(24 − 2k). 1/64 for k = 0 is below 2.5 %, 7/64 for k ≤ 1 above it: from k = 5, 8/14, to k = 1, 16/22.
TEST(SelfLocalizationSummary, RatiosArePaired) {
  const std::vector<SelfLocalizationRow> rows{
      row("nls", 0, 0, 0, 1.0, 0.0), row("composed", 0, 0, 0, 2.0, 0.0),
      row("nls", 1, 0, 0, 3.0, 0.0), row("composed", 1, 0, 0, 4.0, 0.0),
      row("nls", 0, 1, 0, 7.0, 0.0), row("composed", 0, 1, 0, 0.1, 0.0, "one_goal")};
  const LocalizerRatio r = localizer_ratio(rows, kColoured, Knowledge::corrected, "nls", "composed");
  EXPECT_EQ(r.cases, 2);
  EXPECT_NEAR(r.ratio.ratio, 4.0 / 6.0, 1e-12);
  EXPECT_TRUE(std::isnan(r.ratio.interval.low) && std::isnan(r.ratio.interval.high));
  EXPECT_EQ(localizer_ratio(rows, kWhite, Knowledge::corrected, "nls", "composed").cases, 0);

  std::vector<SelfLocalizationRow> six;
  for (int draw = 0; draw < 6; ++draw) {
    six.push_back(row("nls", draw, 0, 0, draw < 3 ? 1.0 : 3.0, 0.0));
    six.push_back(row("composed", draw, 0, 0, draw < 3 ? 2.0 : 4.0, 0.0));
  }
  const LocalizerRatio of_six = localizer_ratio(six, kColoured, Knowledge::corrected, "nls", "composed");
  EXPECT_NEAR(of_six.ratio.interval.low, 8.0 / 14.0, 1e-12);
  EXPECT_NEAR(of_six.ratio.interval.high, 16.0 / 22.0, 1e-12);
}

const Observation::Ours& ours(const SelfLocalizationSummary& summary, const char* begin) {
  for (const Observation& observation : summary.observations) {
    if (observation.paper.rfind(begin, 0) == 0) return observation.ours.at(0);
  }
  throw Error("there is no observation '{}'", begin);
}

// Draws that all say the same, draws that all say the opposite, and draws that do not agree with each other.
TEST(SelfLocalizationSummary, VerdictsFollowFromDraws) {
  const auto settings = small_settings();
  const auto summary_of = [&](double first, double second, int draws = 6) {
    std::vector<SelfLocalizationRow> rows;
    for (int draw = 0; draw < draws; ++draw) {
      rows.push_back(row("method1", draw, 0, 0, draw % 2 == 0 ? first : second, 0.02));
      rows.push_back(row("method2", draw, 0, 0, 0.02, draw % 2 == 0 ? first : second));
    }
    return summarize_self_localization(settings, 1, rows);
  };
  for (const char* method : {"Method 1", "Method 2"}) {
    EXPECT_EQ(ours(summary_of(0.01, 0.012), method).verdict, "agrees");
    EXPECT_EQ(ours(summary_of(0.03, 0.05), method).verdict, "does not agree");
    EXPECT_EQ(ours(summary_of(0.01, 0.05), method).verdict, "not decided");
    const Observation::Ours of_five = ours(summary_of(0.01, 0.012, 5), method);
    EXPECT_EQ(of_five.verdict, "not decided: fewer than 6 draws");
    EXPECT_EQ(of_five.figures.find("–"), std::string::npos) << of_five.figures;
  }
}

// Two spots: B, on the axis, and A.
TEST(SelfLocalizationSummary, SpotsAndTheLostGoal) {
  auto settings = small_settings();
  settings.spots = {{"A", {-1.0, 1.1}}, {"B", {0.0, 1.1}}};
  settings.heading_step_deg = 72;
  const auto summary_of = [&](double of_a, const char* status, const char* elsewhere = "ok", int draws = 6) {
    std::vector<SelfLocalizationRow> rows;
    for (int draw = 0; draw < draws; ++draw) {
      for (int heading = 0; heading < 5; ++heading) {
        rows.push_back(row("composed", draw, 0, heading, of_a, 0.0, heading < 2 ? "ok" : status));
        rows.push_back(row("composed", draw, 1, heading, 0.02, 0.0, heading < 2 ? "ok" : elsewhere));
      }
    }
    return summarize_self_localization(settings, 1, rows);
  };
  const auto like_the_paper = summary_of(0.05, "one_goal");
  EXPECT_EQ(ours(like_the_paper, "The spots on the Y axis").verdict, "agrees");
  EXPECT_EQ(ours(like_the_paper, "A and C").verdict, "agrees");
  EXPECT_EQ(ours(like_the_paper, "because").verdict, "agrees");
  EXPECT_NE(ours(like_the_paper, "because").figures.find("18 of 30 on A and C, 0 of 30"), std::string::npos);
  const auto unlike = summary_of(0.01, "ok");
  EXPECT_EQ(ours(unlike, "The spots on the Y axis").verdict, "does not agree");
  EXPECT_EQ(ours(unlike, "A and C").verdict, "does not agree");
  EXPECT_EQ(ours(unlike, "because").verdict, "not tested: no goal was lost anywhere");
  EXPECT_EQ(ours(summary_of(0.01, "ok", "one_goal"), "because").verdict, "does not agree");
  EXPECT_EQ(ours(summary_of(0.01, "no_goal", "no_goal"), "because").verdict, "not decided");
  const auto of_two = summary_of(0.05, "one_goal", "ok", 2);
  for (const char* observation : {"The spots on the Y axis", "A and C", "because"}) {
    EXPECT_EQ(ours(of_two, observation).verdict, "not decided: fewer than 6 draws");
  }
  EXPECT_NE(table_of(of_two).find("A and C are the worst spots: not decided: fewer than 6 draws (corrected)\n"),
            std::string::npos);
  EXPECT_EQ(ours(summary_of(0.05, "ok", "ok", 2), "because").verdict, "not tested: no goal was lost anywhere");
}

// One spot, 2 headings, 3 knowledges, by all localizers, and with white goals by those that can. How rows resume, and
// that the number of threads does not matter, testMeasurement tests: it is the same code.
TEST(SelfLocalizationRows, AreMadeAndReplayed) {
  const test::TemporaryFolder folder;
  auto settings = small_settings();
  settings.spots.resize(1);
  settings.coloured_draws = 1;
  ExperimentRun run;
  run.seed = 3;
  run.jobs = 2;
  const auto rows = run_self_localization(settings, run, folder.path());
  const std::size_t expected =
      2 * 3 * (localizers_for(settings, kColoured).size() + localizers_for(settings, kWhite).size());
  ASSERT_EQ(rows.size(), expected);
  const std::string whole = content(folder.path() / "rows.csv");

  const auto last = static_cast<std::int64_t>(expected) - 1;
  const ReplayedRow replayed = replay_self_localization(settings, last, folder.path());
  EXPECT_EQ(replayed.stored, replayed.recomputed);
  EXPECT_EQ(replayed.stored.substr(0, replayed.stored.find(',')), std::to_string(last));

  // With the true rig the paper's composed method has the pose to some centimetres.
  int poses = 0;
  for (const SelfLocalizationRow& r : rows) {
    if (r.localizer != "composed" || r.knowledge != Knowledge::true_rig || !r.ok()) continue;
    ++poses;
    EXPECT_LT(r.distance(), 0.20);
    EXPECT_LT(std::abs(r.error.z()), radians(3.0));
  }
  EXPECT_GT(poses, 0);

  // What another one wrote into it is no row of the experiment.
  std::string text = whole;
  const auto second = text.find('\n', text.find('\n') + 1) + 1;
  const auto at = text.find(",coloured,", second);
  std::ofstream(folder.path() / "rows.csv", std::ios::binary) << text.replace(at, 10, ",white,");
  test::expect_error([&] { replay_self_localization(settings, 5, folder.path()); },
                     {"rows.csv:3", "'white'", "column goals", "'coloured'"});
}

}  // namespace
}  // namespace movis::experiments
