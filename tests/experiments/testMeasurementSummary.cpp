// What is counted of rows: by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "measurement_settings.h"
#include "movis/core/angle.h"
#include "movis/experiments/measurement_summary.h"
#include "support/temporary_folder.h"

namespace movis::experiments {
namespace {

MeasurementRow row(const char* system, Knowledge knowledge, int draw, int point, double distance_error,
                   const char* status = "ok") {
  MeasurementRow row;
  row.system = system_index(system);
  row.knowledge = knowledge;
  row.draw = draw;
  row.point = point;
  row.status = status;
  row.distance_error = distance_error;
  row.direction_error = radians(0.1);
  return row;
}

const MeasurementCell& cell_in(const MeasurementSummary& summary, const char* system, Knowledge knowledge) {
  const MeasurementCell* cell = summary.find(Level::bearings, Differences::all, system, knowledge);
  if (cell == nullptr) throw std::runtime_error("no such cell");
  return *cell;
}

// Magnitudes 1, 2, 3, 6: mean 3, median 2.5, RMS √(50/4), 95 % and largest 6. One of five is not measured. By point 0:
// (1 + 3)/2. Draw 0 has the mean 1.5, draw 1 the mean 4.5: resampling two draws gives nothing beyond these.
TEST(MeasurementSummary, StatisticsByHand) {
  const auto pairs = [](int draw, int point, double error) {
    return row("movis-pairs", Knowledge::nominal, draw, point, error);
  };
  const std::vector<MeasurementRow> rows = {pairs(0, 0, -1.0), pairs(0, 1, 2.0), pairs(1, 0, 3.0), pairs(1, 1, -6.0),
                                            row("movis-pairs", Knowledge::nominal, 1, 2, 0.0, "parallel_rays")};
  const MeasurementSummary summary = summarize_measurement(small_settings(), 1, rows);
  ASSERT_EQ(summary.cells.size(), 1U);
  const MeasurementCell& cell = cell_in(summary, "movis-pairs", Knowledge::nominal);
  EXPECT_EQ(cell.asked, 5);
  EXPECT_EQ(cell.measured, 4);
  EXPECT_DOUBLE_EQ(cell.distance.mean, 3.0);
  EXPECT_DOUBLE_EQ(cell.distance.median, 2.5);
  EXPECT_DOUBLE_EQ(cell.distance.rms, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(cell.distance.percentile95, 6.0);
  EXPECT_DOUBLE_EQ(cell.distance.largest, 6.0);
  EXPECT_DOUBLE_EQ(cell.distance.mean_interval.low, 1.5);
  EXPECT_DOUBLE_EQ(cell.distance.mean_interval.high, 4.5);
  EXPECT_DOUBLE_EQ(cell.distance_by_point[0], 2.0);
  EXPECT_TRUE(std::isnan(cell.distance_by_point[2]));
  EXPECT_DOUBLE_EQ(cell.first_distance[0], -1.0);
  EXPECT_NEAR(cell.direction.mean, radians(0.1), 1e-12);
}

TEST(MeasurementSummary, NothingMeasured) {
  const MeasurementSummary summary =
      summarize_measurement(small_settings(), 1, {row("single-contact", Knowledge::true_rig, 0, 0, 0.0, "one_camera")});
  const MeasurementCell& cell = cell_in(summary, "single-contact", Knowledge::true_rig);
  EXPECT_EQ(cell.measured, 0);
  EXPECT_TRUE(std::isnan(cell.distance.mean));
  EXPECT_TRUE(std::isnan(cell.distance.mean_interval.low));
}

// Means 2 and 1 in one draw, 6 and 3 in the other: twice as much, in every resample.
TEST(MeasurementSummary, RatioIsPaired) {
  std::vector<MeasurementRow> rows;
  for (const int draw : {0, 1}) {
    rows.push_back(row("vertical", Knowledge::nominal, draw, 0, draw == 0 ? 2.0 : -6.0));
    rows.push_back(row("movis-pairs", Knowledge::corrected, draw, 0, draw == 0 ? 1.0 : 3.0));
  }
  const Ratio ratio =
      ratio_of(rows, Level::bearings, "vertical", Knowledge::nominal, "movis-pairs", Knowledge::corrected);
  EXPECT_DOUBLE_EQ(ratio.ratio, 2.0);
  EXPECT_DOUBLE_EQ(ratio.interval.low, 2.0);
  EXPECT_DOUBLE_EQ(ratio.interval.high, 2.0);
  EXPECT_TRUE(std::isnan(
      ratio_of(rows, Level::images, "vertical", Knowledge::nominal, "movis-pairs", Knowledge::corrected).ratio));
}

// Both answer point 0, with 2 and 1; only one answers point 1, with 100: that it is hard is no fault of its own.
TEST(MeasurementSummary, RatioIsOfCasesThatBothAnswered) {
  const auto k = Knowledge::nominal;
  const std::vector<MeasurementRow> rows = {row("vertical", k, 0, 0, 2.0), row("movis-pairs", k, 0, 0, 1.0),
                                            row("vertical", k, 0, 1, 100.0),
                                            row("movis-pairs", k, 0, 1, 0.0, "parallel_rays")};
  EXPECT_DOUBLE_EQ(ratio_of(rows, Level::bearings, "vertical", k, "movis-pairs", k).ratio, 2.0);
}

// Only point 0 was answered by both, with 2 and 3. A system that never answers takes no case from the others, nor do
// rows of another knowledge.
TEST(MeasurementSummary, CommonCases) {
  const auto k = Knowledge::nominal;
  const MeasurementSummary summary = summarize_measurement(
      small_settings(), 1,
      {row("vertical", k, 0, 0, -2.0), row("movis-pairs", k, 0, 0, 3.0), row("vertical", k, 0, 1, 100.0),
       row("movis-pairs", k, 0, 1, 0.0, "parallel_rays"), row("single-contact", k, 0, 0, 0.0, "not_seen"),
       row("vertical", Knowledge::true_rig, 0, 1, 7.0)});
  const MeasurementCell& vertical = cell_in(summary, "vertical", k);
  EXPECT_DOUBLE_EQ(vertical.distance.mean, 51.0);
  EXPECT_EQ(vertical.common, 1);
  EXPECT_DOUBLE_EQ(vertical.common_distance, 2.0);
  EXPECT_NEAR(vertical.common_direction, radians(0.1), 1e-12);
  EXPECT_DOUBLE_EQ(cell_in(summary, "movis-pairs", k).common_distance, 3.0);
  EXPECT_EQ(cell_in(summary, "single-contact", k).common, 0);
  EXPECT_TRUE(std::isnan(cell_in(summary, "single-contact", k).common_distance));
  EXPECT_DOUBLE_EQ(cell_in(summary, "vertical", Knowledge::true_rig).common_distance, 7.0);
}

std::string words_of(const MeasurementSummary& summary) {
  std::string words;
  for (const Finding& finding : summary.findings) {
    for (const std::string& sentence : finding.sentences) words += sentence + "\n";
  }
  return words;
}

// The same rows, with the two systems' names exchanged, must say the opposite.
TEST(MeasurementFindings, FollowFromTheNumbers) {
  const auto findings = [](const char* good, const char* bad) {
    std::vector<MeasurementRow> rows;
    for (const int draw : {0, 1, 2}) {
      rows.push_back(row(good, Knowledge::nominal, draw, 0, 0.01));
      rows.push_back(row(bad, Knowledge::nominal, draw, 0, 0.05));
    }
    return words_of(summarize_measurement(small_settings(), 1, rows));
  };
  const std::string movis = findings("movis-pairs", "vertical");
  EXPECT_NE(movis.find("MOVIS, pairs 1.0 cm, vertical stereo 5.0 cm"), std::string::npos) << movis;
  EXPECT_NE(movis.find("beyond chance: with nominal rigs. It is not: nowhere"), std::string::npos) << movis;
  const std::string vertical = findings("vertical", "movis-pairs");
  EXPECT_NE(vertical.find("vertical stereo 1.0 cm, MOVIS, pairs 5.0 cm"), std::string::npos) << vertical;
  EXPECT_NE(vertical.find("beyond chance: nowhere. It is not: with nominal rigs"), std::string::npos) << vertical;
  EXPECT_NE(vertical.find("0.20 times"), std::string::npos) << vertical;
}

// Over all it answered vertical stereo errs 51 cm on average, and where both answered 2 cm against 3 cm.
TEST(MeasurementFindings, OrderIsOfCasesThatAllAnswered) {
  const auto k = Knowledge::nominal;
  const std::string words = words_of(
      summarize_measurement(small_settings(), 1,
                            {row("vertical", k, 0, 0, 0.02), row("movis-pairs", k, 0, 0, 0.03),
                             row("vertical", k, 0, 1, 1.0), row("movis-pairs", k, 0, 1, 0.0, "contradiction")}));
  EXPECT_NE(words.find("over the 1 of 2 cases that all answered: vertical stereo 2.0 cm, MOVIS, pairs 3.0 cm"),
            std::string::npos)
      << words;
}

TEST(MeasurementFindings, WarnOfWhatIsMissing) {
  const std::string words =
      words_of(summarize_measurement(small_settings(), 1,
                                     {row("single-contact", Knowledge::nominal, 0, 0, 0.0, "parallel_rays"),
                                      row("single-contact", Knowledge::nominal, 0, 1, 0.5)}));
  EXPECT_NE(words.find("single omni, by ground contact has no distance in some cases"), std::string::npos) << words;
  EXPECT_NE(words.find("nominal 1 of 2"), std::string::npos) << words;
}

// The bound of three cameras by azimuths and elevations cannot be better than with diameter and floor too, and one
// camera alone has none without the floor.
TEST(MeasurementSummary, Bounds) {
  const MeasurementSummary summary = summarize_measurement(
      small_settings(), 1,
      {row("movis-joint", Knowledge::true_rig, 0, 0, 0.01), row("single-contact", Knowledge::true_rig, 0, 0, 0.01)});
  const MeasurementCell& movis = cell_in(summary, "movis-joint", Knowledge::true_rig);
  EXPECT_GT(movis.bound.distance, 0.0);
  EXPECT_GT(movis.free_bound.distance, movis.bound.distance);
  const MeasurementCell& single = cell_in(summary, "single-contact", Knowledge::true_rig);
  EXPECT_TRUE(std::isnan(single.free_bound.distance));
  EXPECT_GT(single.bound.distance, movis.bound.distance);
}

TEST(MeasurementSummary, IsWrittenAsJson) {
  const test::TemporaryFolder folder;
  const MeasurementSummary summary = summarize_measurement(
      small_settings(), 7, {row("single-contact", Knowledge::nominal, 0, 0, 0.0, "parallel_rays")});
  write_summary(summary, folder.path() / "summary.json");
  std::ifstream stream(folder.path() / "summary.json");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  EXPECT_NE(text.find("\"seed\": 7"), std::string::npos);
  EXPECT_NE(text.find("\"mean\": null"), std::string::npos);
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace movis::experiments
