#include "row_run.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <system_error>
#include <thread>

#include "movis/core/output_file.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

using Lines = std::vector<std::string>;

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

void check_beginning(const fs::path& folder, const ExperimentRun& run) {
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
std::vector<Lines> finished(const StoredRows& stored, const std::vector<RowBlock>& blocks) {
  std::vector<Lines> lines(blocks.size());
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
  Workers(const ExperimentRun& run, const MakeBlock& make, std::vector<Lines>& lines, const fs::path& file)
      : run_(run), make_(make), lines_(lines), file_(file), stream_(file, std::ios::app) {
    done_ = static_cast<std::size_t>(
        std::count_if(lines.begin(), lines.end(), [](const auto& block) { return !block.empty(); }));
  }

  void work() {
    const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(1, run_.jobs)), lines_.size() - done_);
    std::vector<std::thread> threads;
    threads.reserve(wanted);
    const int opencv_threads = cv::getNumThreads();
    cv::setNumThreads(1);  // every core makes a block of its own
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
      for (std::size_t i = next_++; i < lines_.size(); i = next_++) {
        if (lines_[i].empty()) keep(i, make_(i));
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_ = lines_.size();
    }
  }

  void keep(std::size_t i, Lines lines) {
    const std::lock_guard lock(mutex_);
    for (const std::string& line : lines) stream_ << line << '\n';
    if (!stream_.flush()) throw Error("{}: cannot be written; is the disk full?", file_.string());
    lines_[i] = std::move(lines);
    ++done_;
    if (run_.progress) run_.progress(done_, lines_.size());
  }

  const ExperimentRun& run_;
  const MakeBlock& make_;
  std::vector<Lines>& lines_;
  const fs::path& file_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;  // of what follows
  std::ofstream stream_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
};

void write_rows(const fs::path& file, const std::string& header, const std::vector<Lines>& blocks) {
  OutputFile output(file);
  output.stream() << header << '\n';
  for (const Lines& block : blocks) {
    for (const std::string& line : block) output.stream() << line << '\n';
  }
  output.commit();
}

}  // namespace

std::vector<std::string> run_blocks(const RowFormat& format, const ExperimentRun& run, const fs::path& folder,
                                    const MakeBlock& make) {
  const fs::path file = folder / kResults[0];
  check_beginning(folder, run);
  make_folder(folder);
  std::vector<Lines> lines(format.blocks.size());
  if (run.resume) {
    const StoredRows stored = read_rows(file, format);
    if (!stored.lines.empty() && stored.seed != run.seed) {
      throw Error("{}: its rows are of seed {}; go on with --seed {}, or name another folder with --out", file.string(),
                  stored.seed, stored.seed);
    }
    lines = finished(stored, format.blocks);
  }
  write_rows(file, format.header, lines);  // without the rows of blocks that are not whole
  Workers(run, make, lines, file).work();
  write_rows(file, format.header, lines);
  Lines all;
  for (Lines& block : lines) std::move(block.begin(), block.end(), std::back_inserter(all));
  return all;
}

StoredRow stored_row(const RowFormat& format, std::int64_t row, const fs::path& folder) {
  const fs::path file = folder / kResults[0];
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    throw Error("{}: is not there; name the folder of the results with --out", file.string());
  }
  check_regular(file);
  const StoredRows stored = read_rows(file, format);
  const auto found = stored.lines.find(row);
  if (found == stored.lines.end()) {
    throw Error("{}: has no row {}; it has {} rows, numbered from 0 in the first column", file.string(), row,
                stored.lines.size());
  }
  return {found->second, stored.seed};
}

}  // namespace movis::experiments
