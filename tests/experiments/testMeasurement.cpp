// The measurement experiment on bearings: what differences must do by hand, and that rows resume and replay.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "measurement_settings.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/experiments/measurement.h"
#include "movis/experiments/measurement_summary.h"
#include "support/temporary_folder.h"

namespace movis::experiments {
namespace {

std::string content(const std::filesystem::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::vector<MeasurementRow> run(const MeasurementSettings& settings) {
  const test::TemporaryFolder folder;
  return run_measurement(settings, {}, folder.path());
}

// Differences of one kind alone, hardly any noise.
std::vector<MeasurementRow> run_alone(Differences differences, const char* system) {
  MeasurementSettings settings = small_settings();
  settings.bearing_draws = 0;
  settings.alone_draws = 3;
  settings.detector_factor = 1e-6;
  std::vector<MeasurementRow> rows;
  for (const MeasurementRow& row : run(settings)) {
    if (row.differences == differences && row.system == system_index(system)) rows.push_back(row);
  }
  EXPECT_EQ(rows.size(), 24U);  // 3 draws, 8 places
  for (const MeasurementRow& row : rows) EXPECT_EQ(row.status, "ok") << system;
  return rows;
}

// 17 × 17 = 289 points; the hull of 0.25 m and the ball of 0.11 m cover the origin alone, as 0.36 < 0.5.
TEST(MeasurementLattice, HasThePapersPoints) {
  const MeasurementSettings settings = read_measurement(data_file("experiments/measurement.yaml"), false);
  const Lattice lattice = lattice_of(settings, Differences::all);
  EXPECT_EQ(lattice.points.size(), 288U);
  EXPECT_EQ(lattice.under_robot, 1);
  EXPECT_EQ(lattice.points.front(), Eigen::Vector2d(-4.0, -4.0));
  EXPECT_EQ(lattice.points.back(), Eigen::Vector2d(4.0, 4.0));
}

TEST(Measurement, WithoutDifferencesAndNoiseEverySystemIsExact) {
  for (const MeasurementSystem& system : kSystems) {
    for (const MeasurementRow& row : run_alone(Differences::none, system.name)) {
      EXPECT_NEAR(row.distance_error, 0.0, 2e-6) << system.name;
      EXPECT_NEAR(row.direction_error, 0.0, 2e-6) << system.name;
    }
  }
}

// A camera yawed by δ sees everything turned by −δ when it is believed not to be; elevations stay. So a single camera's
// direction is off alike everywhere, and no range by elevations is off at all; pairs of cameras turned unlike each
// other mistake the distance.
TEST(Measurement, YawAloneTurnsDirections) {
  for (const char* system : {"single-elevation", "single-contact"}) {
    const std::vector<MeasurementRow> rows = run_alone(Differences::yaw, system);
    for (const MeasurementRow& row : rows) {
      EXPECT_NEAR(row.direction_error, rows[8 * static_cast<std::size_t>(row.draw)].direction_error, 2e-6) << system;
      EXPECT_GT(std::abs(row.direction_error), radians(0.001));
    }
  }
  for (const char* system : {"single-elevation", "single-contact", "vertical", "vertical-short"}) {
    for (const MeasurementRow& row : run_alone(Differences::yaw, system)) {
      EXPECT_NEAR(row.distance_error, 0.0, 2e-6) << system;
    }
  }
  double largest = 0.0;
  for (const MeasurementRow& row : run_alone(Differences::yaw, "movis-pairs")) {
    largest = std::max(largest, std::abs(row.distance_error));
  }
  EXPECT_GT(largest, 0.005);
}

// A focal length scales an upright camera's picture about its principal point: azimuths stay, elevations do not.
TEST(Measurement, FocalLengthAloneLeavesAzimuths) {
  for (const char* system : {"movis-pairs", "movis-azimuths"}) {
    for (const MeasurementRow& row : run_alone(Differences::focal, system)) {
      EXPECT_NEAR(row.distance_error, 0.0, 2e-5) << system;
      EXPECT_NEAR(row.direction_error, 0.0, 2e-5) << system;
    }
  }
  for (const char* system : {"single-elevation", "single-contact", "vertical"}) {
    for (const MeasurementRow& row : run_alone(Differences::focal, system)) {
      EXPECT_NEAR(row.direction_error, 0.0, 2e-6) << system;
      EXPECT_GT(std::abs(row.distance_error), 1e-5) << system;
    }
  }
}

// What is known of the rig better must pay: the true rig beats the drawing by an order, and so do its two remedies.
TEST(Measurement, KnowledgeOfTheRigPays) {
  MeasurementSettings settings = small_settings();
  settings.alone_draws = 0;
  settings.calibration_points = 40;
  const std::vector<MeasurementRow> rows = run(settings);
  for (const char* system : {"vertical", "movis-pairs", "movis-joint"}) {
    for (const Knowledge knowledge : {Knowledge::corrected, Knowledge::calibrated, Knowledge::true_rig}) {
      EXPECT_LT(ratio_of(rows, Level::bearings, system, knowledge, system, Knowledge::nominal).ratio, 0.1)
          << system << ' ' << word(knowledge);
    }
  }
}

TEST(MeasurementRows, AreTheSameForAnyNumberOfJobs) {
  const test::TemporaryFolder folder;
  const MeasurementSettings settings = small_settings();
  MeasurementRun run;
  for (const int jobs : {1, 3}) {
    run.jobs = jobs;
    run_measurement(settings, run, folder.path() / std::to_string(jobs));
  }
  const std::string rows = content(folder.path() / "1/rows.csv");
  EXPECT_EQ(rows, content(folder.path() / "3/rows.csv"));
  // 8 places: 2 draws of 4 knowledges and 6 kinds alone, each by 8 systems; and the header.
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 8 * 8 * (2 * 4 + 6) + 1);
}

// An interrupted run keeps its blocks, a killed one may leave half a line; both go on to the same file.
TEST(MeasurementRows, ResumeAfterInterruption) {
  const test::TemporaryFolder folder;
  const MeasurementSettings settings = small_settings();
  run_measurement(settings, {}, folder.path() / "whole");
  MeasurementRun stopped;
  stopped.progress = [](std::size_t done, std::size_t) {
    if (done == 5) throw Error("stopped");
  };
  EXPECT_THROW(run_measurement(settings, stopped, folder.path() / "part"), Error);
  const auto part = folder.path() / "part/rows.csv";
  std::ofstream(part, std::ios::app) << "4711,0.1.0,half a li";
  std::size_t first_done = 0;
  MeasurementRun resumed;
  resumed.resume = true;
  resumed.progress = [&](std::size_t done, std::size_t) { first_done = first_done == 0 ? done : first_done; };
  run_measurement(settings, resumed, folder.path() / "part");
  EXPECT_EQ(first_done, 6U);
  EXPECT_EQ(content(part), content(folder.path() / "whole/rows.csv"));
}

TEST(MeasurementRows, OfAnotherRunAreRefused) {
  const test::TemporaryFolder folder;
  MeasurementSettings settings = small_settings();
  settings.alone_draws = 0;
  settings.bearing_draws = 1;
  run_measurement(settings, {}, folder.path());
  test::expect_error([&] { run_measurement(settings, {}, folder.path()); }, {"rows.csv", "--resume"});
  MeasurementRun run;
  run.resume = true;
  run.seed = 2;
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv", "--seed 1"});
  run.seed = 1;
  settings.digest = "another";
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv", "other settings"});
  folder.write("rows.csv", "a,b\n1,2\n");
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv:1", "header"});
}

TEST(MeasurementRows, Replay) {
  const test::TemporaryFolder folder;
  const MeasurementSettings settings = small_settings();
  MeasurementRun run;
  run.seed = 3;
  const auto rows = run_measurement(settings, run, folder.path());
  for (const std::size_t i : {std::size_t{0}, std::size_t{77}, std::size_t{300}, rows.size() - 1}) {
    const ReplayedRow replayed = replay_measurement(settings, static_cast<std::int64_t>(i), folder.path());
    EXPECT_EQ(replayed.stored, replayed.recomputed);
    EXPECT_EQ(replayed.stored.substr(0, replayed.stored.find(',')), std::to_string(i));
  }
  test::expect_error([&] { replay_measurement(settings, 1000000, folder.path()); }, {"rows.csv", "no row 1000000"});
  test::expect_error([&] { replay_measurement(settings, 0, folder.path() / "absent"); }, {"rows.csv", "--out"});
}

// A file beside the shipped ones, changed in one place.
std::filesystem::path changed(const test::TemporaryFolder& folder, const std::string& from, const std::string& to) {
  std::string text = content(data_file("experiments/measurement.yaml"));
  for (auto at = text.find("../"); at != std::string::npos; at = text.find("../", at)) {
    text.replace(at, 3, data_directory().string() + "/");
  }
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return folder.write("changed.yaml", text.replace(at, from.size(), to));
}

TEST(MeasurementSettings, AreReadStrictly) {
  const struct {
    const char *from, *to;
    std::initializer_list<const char*> message;
  } cases[] = {{"lattice:", "latice:", {"changed.yaml", "latice", "lattice"}},
               {"step: 0.5", "step: 0.6", {"changed.yaml", "does not divide", "4"}},
               {"experiment: measurement", "experiment: shooting", {"experiment", "measurement"}},
               {"rigs/single.yaml", "rigs/movis.yaml", {"single", "3 cameras", "must have 1"}},
               {"rigs/vertical.yaml", "rigs/absent.yaml", {"vertical", "does not exist"}},
               {"half_width: 4.0", "half_width: 12.0", {"lattice", "hall"}},
               {"detector_factor: 2.0", "detector_factor: 0", {"detector_factor", "out of range"}},
               {"quick: {step: 2.0", "quick: {stp: 2.0", {"quick", "stp"}}};
  for (const auto& [from, to, message] : cases) {
    const test::TemporaryFolder folder;
    const auto file = changed(folder, from, to);
    test::expect_error([&] { read_measurement(file, false); }, message);
  }
}

TEST(MeasurementSettings, QuickAndDifferencesAndDigest) {
  const test::TemporaryFolder folder;
  const auto file = changed(folder, "images:", "differences: {yaw_deg: 2, principal_point_px: 0}\nimages:");
  const MeasurementSettings settings = read_measurement(file, false);
  EXPECT_NEAR(settings.differences[3], radians(2.0), 1e-15);
  EXPECT_EQ(settings.differences[7], 0.0);
  EXPECT_EQ(settings.differences[0], omni::individual_differences()[0]);
  const MeasurementSettings quick = read_measurement(file, true);
  EXPECT_EQ(settings.step, 0.5);
  EXPECT_EQ(quick.step, 2.0);
  EXPECT_NE(settings.digest, quick.digest);
  EXPECT_NE(settings.digest, read_measurement(data_file("experiments/measurement.yaml"), false).digest);
}

}  // namespace
}  // namespace movis::experiments
