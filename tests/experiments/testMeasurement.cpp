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
  ExperimentRun run;
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
  ExperimentRun stopped;
  stopped.progress = [](std::size_t done, std::size_t) {
    if (done == 5) throw Error("stopped");
  };
  EXPECT_THROW(run_measurement(settings, stopped, folder.path() / "part"), Error);
  const auto part = folder.path() / "part/rows.csv";
  std::ofstream(part, std::ios::app) << "4711,0.1.0,half a li";
  std::size_t first_done = 0;
  ExperimentRun resumed;
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
  ExperimentRun run;
  run.resume = true;
  run.seed = 2;
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv", "--seed 1"});
  run.seed = 1;
  settings.digest = "another";
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv", "other settings"});
  folder.write("rows.csv", "a,b\n1,2\n");
  test::expect_error([&] { run_measurement(settings, run, folder.path()); }, {"rows.csv:1", "header"});
}

// In the file's third line, row 1.
void change_row(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = content(file);
  std::size_t line = text.find('\n') + 1;
  line = text.find('\n', line) + 1;
  const std::size_t at = text.find(from, line);
  ASSERT_LT(at, text.find('\n', line)) << from;
  std::ofstream(file, std::ios::binary) << text.replace(at, from.size(), to);
}

// A row's number tells every cell but status and errors; whatever else stands there is no row of this experiment. Row 1
// is that of the single camera by ground contact at (-1, -1), the first draw's first point, with the nominal rig.
TEST(MeasurementRows, ThatAreNotOnesOfTheExperimentAreRefused) {
  MeasurementSettings settings = small_settings();
  settings.alone_draws = 0;
  settings.bearing_draws = 1;
  const test::TemporaryFolder folder;
  run_measurement(settings, {}, folder.path());
  const auto file = folder.path() / "rows.csv";
  const std::string good = content(file);
  const struct {
    const char *from, *to;
    std::initializer_list<const char*> message;
  } cases[] = {
      {",all,0,0,-1,", ",all,0,0,nan,", {"rows.csv:3", "'nan'", "column x", "'-1'"}},
      {",all,0,0,-1,", ",all,0,0,1e6,", {"rows.csv:3", "'1e6'", "column x"}},
      {",all,0,0,-1,", ",all,77,0,-1,", {"rows.csv:3", "'77'", "column draw"}},
      {",all,0,0,-1,", ",all,0,99999,-1,", {"rows.csv:3", "'99999'", "column point"}},
      {",all,0,0,-1,", ",all,0,-1,-1,", {"rows.csv:3", "'-1'", "column point"}},
      {",bearings,", ",images,", {"rows.csv:3", "'images'", "column level", "'bearings'"}},
      {"single-contact", "movis-pairs", {"rows.csv:3", "'movis-pairs'", "column system"}},
      {",nominal,", ",true,", {"rows.csv:3", "'true'", "column knowledge"}},
      {",ok,", ",banana,", {"rows.csv:3", "no status 'banana'"}},
      {",ok,", ",parallel_rays,", {"rows.csv:3", "column distance_error_m", "has ''"}},
      {",ok,", ",ok,nan,", {"rows.csv:3", "16 cells instead of 15"}},
      {",ok,", ",ok,x", {"rows.csv:3", "where a number should"}},
      {"1,", "1000000,", {"rows.csv:3", "no row 1000000"}},
      {"1,", "0,", {"rows.csv:3", "column system"}},
  };
  ExperimentRun resume;
  resume.resume = true;
  for (const auto& [from, to, message] : cases) {
    std::ofstream(file, std::ios::binary) << good;
    change_row(file, from, to);
    const std::string changed = content(file);
    test::expect_error([&] { run_measurement(settings, resume, folder.path()); }, message);
    test::expect_error([&] { replay_measurement(settings, 5, folder.path()); }, message);
    EXPECT_EQ(content(file), changed) << to;
  }
  const std::size_t first = good.find('\n') + 1;
  std::ofstream(file, std::ios::binary) << good + good.substr(first, good.find('\n', first) + 1 - first);
  test::expect_error([&] { run_measurement(settings, resume, folder.path()); }, {"row 0", "second time"});
}

// Whatever stands in rows.csv that is not ours stays as it is, a half line of ours too when it is only read.
TEST(MeasurementRows, ReadingChangesNoFile) {
  const test::TemporaryFolder folder;
  MeasurementSettings settings = small_settings();
  settings.alone_draws = 0;
  settings.bearing_draws = 1;
  ExperimentRun resume;
  resume.resume = true;
  for (const char* foreign : {"precious single line", "a,b\n1,2\nhalf"}) {
    const auto file = folder.write("rows.csv", foreign);
    test::expect_error([&] { replay_measurement(settings, 0, folder.path()); }, {"rows.csv:1", "header"});
    test::expect_error([&] { run_measurement(settings, resume, folder.path()); }, {"rows.csv:1", "header"});
    EXPECT_EQ(content(file), foreign);
  }
  run_measurement(settings, {}, folder.path() / "ours");
  const auto ours = folder.path() / "ours/rows.csv";
  std::ofstream(ours, std::ios::app) << "4711,half a li";
  const std::string before = content(ours);
  const ReplayedRow replayed = replay_measurement(settings, 3, folder.path() / "ours");
  EXPECT_EQ(replayed.stored, replayed.recomputed);
  EXPECT_EQ(content(ours), before);
}

// Known before anything is measured, and named.
TEST(MeasurementRows, PlacesThatCannotBeWrittenAreRefused) {
  const test::TemporaryFolder folder;
  const MeasurementSettings settings = small_settings();
  ExperimentRun run;
  run.progress = [](std::size_t, std::size_t) { FAIL() << "measured"; };
  for (const char* name : {"rows.csv", "summary.json", "index.html"}) {
    const auto out = folder.path() / (std::string("with-") + name);
    std::filesystem::create_directories(out / name);
    test::expect_error([&] { run_measurement(settings, run, out); }, {name, "is a folder", "--out"});
  }
  test::expect_error([&] { replay_measurement(settings, 0, folder.path() / "with-rows.csv"); },
                     {"rows.csv", "is a folder"});
  const auto file = folder.write("file", "text");
  test::expect_error([&] { run_measurement(settings, run, file); }, {"file: is a file", "--out"});
  test::expect_error([&] { run_measurement(settings, run, file / "below"); }, {"below", "cannot be created", "--out"});
  run.resume = true;
  test::expect_error([&] { run_measurement(settings, run, folder.path() / "absent"); }, {"rows.csv", "--resume"});
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "absent"));
}

// A robot as large as its lattice leaves no place for a ball, however long one seeks.
TEST(Measurement, LatticeUnderTheRobotEnds) {
  MeasurementSettings settings = small_settings();
  settings.alone_draws = 0;
  settings.robot.radius = 2.0;
  settings.half_width = 1.0;
  settings.bearing_draws = 1;
  EXPECT_TRUE(lattice_of(settings, Differences::all).points.empty());
  const test::TemporaryFolder folder;
  test::expect_error([&] { run_measurement(settings, {}, folder.path()); }, {"2 m in radius", "half width 1 m"});
}

TEST(MeasurementRows, Replay) {
  const test::TemporaryFolder folder;
  const MeasurementSettings settings = small_settings();
  ExperimentRun run;
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
               {"rigs/single.yaml", "rigs", {"single", "is a folder"}},
               {"robots/miniature.yaml", "robots", {"robot", "is a folder"}},
               {"detector_factor: 2.0", "detector_factor: 0", {"detector_factor", "out of range"}},
               {"quick: {step: 2.0", "quick: {stp: 2.0", {"quick", "stp"}}};
  for (const auto& [from, to, message] : cases) {
    const test::TemporaryFolder folder;
    const auto file = changed(folder, from, to);
    test::expect_error([&] { read_measurement(file, false); }, message);
  }
}

// A hull of 1 m and a ball of 0.11 m cover 1.11 m around the centre.
TEST(MeasurementSettings, RobotThatCoversTheLatticeIsRefused) {
  const test::TemporaryFolder folder;
  std::string robot = content(data_file("robots/miniature.yaml"));
  const auto radius = robot.find("\nradius:");
  ASSERT_NE(radius, std::string::npos);
  robot.replace(radius, robot.find('\n', radius + 1) - radius, "\nradius: 1.0");
  const std::string named = folder.write("large.yaml", robot).string();
  std::string text = content(changed(folder, "half_width: 4.0", "half_width: 1.0"));
  const std::string shipped = data_file("robots/miniature.yaml").string();
  const auto at = text.find(shipped);
  ASSERT_NE(at, std::string::npos) << text;
  const auto file = folder.write("covered.yaml", text.replace(at, shipped.size(), named));
  test::expect_error([&] { read_measurement(file, false); }, {"covered.yaml", "lattice", "1 m", "1.11 m"});
}

TEST(MeasurementSettings, NoDrawsAreRefused) {
  const test::TemporaryFolder folder;
  std::string text = content(changed(folder, "images: {draws: 10}", "images: {draws: 0}"));
  for (auto at = text.find("draws: 20"); at != std::string::npos; at = text.find("draws: 20")) {
    text.replace(at, 9, "draws: 0");
  }
  const auto file = folder.write("nothing.yaml", text);
  test::expect_error([&] { read_measurement(file, false); }, {"nothing.yaml", "0 draws", "raise"});
  EXPECT_EQ(read_measurement(file, true).bearing_draws, 3);  // of the map `quick`
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
