#include "interrupt.h"

#include <atomic>
#include <csignal>

#include "movis/core/error.h"

namespace movis::app {
namespace {

std::atomic<bool> signal_seen = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

// A second signal ends the program at once.
extern "C" void remember_signal(int signal) {
  signal_seen = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, remember_signal);
}

void check_interrupts() {
  if (signal_seen) throw Error("interrupted; nothing was written");
}

}  // namespace movis::app
