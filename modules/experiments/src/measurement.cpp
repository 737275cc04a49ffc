#include "movis/experiments/measurement.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <system_error>
#include <thread>

#include "measurement_bench.h"
#include "measurement_rows.h"
#include "movis/core/error.h"
#include "movis/core/output_file.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

int draws_of(const MeasurementSettings& settings, Level level, Differences differences) {
  if (level == Level::images) return differences == Differences::all ? settings.image_draws : 0;
  return differences == Differences::all ? settings.bearing_draws : settings.alone_draws;
}

constexpr std::array kResults{"rows.csv", "summary.json", "index.html"};

void check_regular(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored) || fs::is_regular_file(file, ignored)) return;
  throw Error(
      "{}: is a folder or a device where a file of results should be; remove it, or name another folder with "
      "--out",
      file.string());
}

// What cannot be written must be known before the work, not after it.
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw Error("{}: the folder cannot be created: {}; name another with --out", folder.string(), error.message());
  }
  for (const char* name : kResults) {
    check_regular(folder / name);
    const OutputFile draft(folder / name);  // throws, or leaves nothing behind
  }
}

void check_beginning(const fs::path& folder, const MeasurementRun& run) {
  std::error_code ignored;
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
    throw Error("{}: is a file; name a folder with --out", folder.string());
  }
  const fs::path file = folder / kResults[0];
  const bool exists = fs::exists(file, ignored);
  if (exists && !run.resume && fs::is_regular_file(file, ignored)) {
    throw Error("{}: exists; add --resume to go on with it, or name another folder with --out", file.string());
  }
  if (!exists && run.resume) {
    throw Error("{}: is not there, so nothing can be resumed; leave out --resume, or name the folder with --out",
                file.string());
  }
}

// Rows of blocks that are whole.
std::vector<std::vector<std::string>> finished(const StoredRows& stored, const std::vector<MeasurementBlock>& blocks) {
  std::vector<std::vector<std::string>> lines(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const auto begin = stored.lines.lower_bound(blocks[i].first_row);
    const auto end = stored.lines.lower_bound(blocks[i].first_row + blocks[i].rows);
    if (std::distance(begin, end) != blocks[i].rows) continue;
    for (auto line = begin; line != end; ++line) lines[i].push_back(line->second);
  }
  return lines;
}

// Blocks are shared out among threads. A finished block's lines are appended to the file at once.
class Workers {
 public:
  Workers(const MeasurementSettings& settings, const MeasurementRun& run, const std::vector<MeasurementBlock>& blocks,
          std::vector<std::vector<std::string>>& lines, const fs::path& file)
      : settings_(settings), run_(run), blocks_(blocks), lines_(lines), file_(file), stream_(file, std::ios::app) {
    done_ = static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [](const auto& block) { return !block.empty(); }));
  }

  void work() {
    const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(1, run_.jobs)), blocks_.size() - done_);
    std::vector<std::thread> threads;
    threads.reserve(wanted);
    const int opencv_threads = cv::getNumThreads();
    cv::setNumThreads(1);  // every core measures a block of its own
    try {
      while (threads.size() + 1 < wanted) threads.emplace_back([this] { take(); });
    } catch (const std::system_error&) {  // the system gives no more: these do the work
    }
    take();
    for (std::thread& thread : threads) thread.join();
    cv::setNumThreads(opencv_threads);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void take() {
    try {
      for (std::size_t i = next_++; i < blocks_.size(); i = next_++) {
        if (lines_[i].empty()) measure(i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_ = blocks_.size();
    }
  }

  void measure(std::size_t i) {
    MeasurementBench bench(settings_, run_.seed, blocks_[i]);
    std::vector<MeasurementRow> rows;
    for (int point = 0; point < static_cast<int>(bench.lattice().points.size()); ++point) bench.measure(point, rows);
    std::vector<std::string> lines;
    lines.reserve(rows.size());
    for (const MeasurementRow& row : rows) lines.push_back(line_of(row, settings_, run_.seed));
    const std::lock_guard lock(mutex_);
    for (const std::string& line : lines) stream_ << line << '\n';
    if (!stream_.flush()) throw Error("{}: cannot be written; is the disk full?", file_.string());
    lines_[i] = std::move(lines);
    ++done_;
    if (run_.progress) run_.progress(done_, blocks_.size());
  }

  const MeasurementSettings& settings_;
  const MeasurementRun& run_;
  const std::vector<MeasurementBlock>& blocks_;
  std::vector<std::vector<std::string>>& lines_;
  const fs::path& file_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // of what follows
  std::ofstream stream_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

std::vector<MeasurementBlock> blocks_of(const MeasurementSettings& settings) {
  std::vector<MeasurementBlock> blocks;
  std::int64_t row = 0;
  for (const Level level : kLevels) {
    for (const Differences differences : kDifferences) {
      const auto points = static_cast<std::int64_t>(lattice_of(settings, differences).points.size());
      const auto knowledges = static_cast<std::int64_t>(knowledges_of(differences).size());
      for (int draw = 0; draw < draws_of(settings, level, differences); ++draw) {
        for (const RigIndex rig : {kSingleRig, kVerticalRig, kShortVerticalRig, kMovisRig}) {
          const std::int64_t rows = points * knowledges * static_cast<std::int64_t>(systems_of(rig).size());
          blocks.push_back({level, differences, draw, rig, row, rows});
          row += rows;
        }
      }
    }
  }
  return blocks;
}

std::vector<MeasurementRow> run_measurement(const MeasurementSettings& settings, const MeasurementRun& run,
                                            const fs::path& folder) {
  const fs::path file = folder / kResults[0];
  check_beginning(folder, run);
  make_folder(folder);
  const RowPlan plan(settings);
  std::vector<std::vector<std::string>> lines(plan.blocks().size());
  if (run.resume) {
    const StoredRows stored = read_rows(file, settings, plan);
    if (!stored.lines.empty() && stored.seed != run.seed) {
      throw Error("{}: its rows are of seed {}; go on with --seed {}, or name another folder with --out", file.string(),
                  stored.seed, stored.seed);
    }
    lines = finished(stored, plan.blocks());
  }
  {
    OutputFile begin(file);  // without the rows of blocks that are not whole
    begin.stream() << rows_header() << '\n';
    for (const auto& block : lines) {
      for (const std::string& line : block) begin.stream() << line << '\n';
    }
    begin.commit();
  }
  Workers(settings, run, plan.blocks(), lines, file).work();

  std::vector<MeasurementRow> rows;
  OutputFile ordered(file);
  ordered.stream() << rows_header() << '\n';
  for (const auto& block : lines) {
    for (const std::string& line : block) {
      ordered.stream() << line << '\n';
      // What stands in the file is what is evaluated, resumed or not.
      rows.push_back(parse_row(line, settings, run.seed, plan, file.string()));
    }
  }
  ordered.commit();
  return rows;
}

ReplayedRow replay_measurement(const MeasurementSettings& settings, std::int64_t row, const fs::path& folder) {
  const fs::path file = folder / kResults[0];
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    throw Error("{}: is not there; name the folder of the results with --out", file.string());
  }
  check_regular(file);
  const RowPlan plan(settings);
  const StoredRows stored = read_rows(file, settings, plan);
  const auto found = stored.lines.find(row);
  if (found == stored.lines.end()) {
    throw Error("{}: has no row {}; it has {} rows, numbered from 0 in the first column", file.string(), row,
                stored.lines.size());
  }
  MeasurementBench bench(settings, stored.seed, *plan.block(row));
  std::vector<MeasurementRow> rows;
  bench.measure(plan.row(row)->point, rows);
  const MeasurementRow& again = rows.at(static_cast<std::size_t>(row - rows.front().row));
  return {rows_header(), found->second, line_of(again, settings, stored.seed)};
}

}  // namespace movis::experiments
