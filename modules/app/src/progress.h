#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

namespace movis::app {

// A bar on standard error for work that takes more than a moment; silent where standard error is no terminal.
class Progress {
 public:
  Progress(std::string what, std::size_t total) : what_(std::move(what)), total_(total), shown_(isatty(2) != 0) {}

  ~Progress() { finish(); }  // before an error's message
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void advance() {
    ++done_;
    const auto now = Clock::now();
    if (!shown_ || now - drawn_ < std::chrono::milliseconds(100)) return;
    drawn_ = now;
    constexpr std::size_t kWidth = 40;
    const std::size_t filled = total_ > 0 ? kWidth * done_ / total_ : kWidth;
    std::fprintf(stderr, "\r%s [%s%s] %zu/%zu", what_.c_str(), std::string(filled, '#').c_str(),
                 std::string(kWidth - filled, ' ').c_str(), done_, total_);
  }
  void finish() const {
    if (shown_) std::fprintf(stderr, "\r\033[K");
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  std::size_t total_;
  std::size_t done_ = 0;
  bool shown_;
  Clock::time_point drawn_;
};

}  // namespace movis::app
