#include "interrupt.h"

#include <csignal>

#include "movis/core/error.h"

namespace movis::app {
namespace {

volatile std::sig_atomic_t signal_seen = 0;  // NOLINT: a signal handler has no other way

extern "C" void remember_signal(int /*signal*/) {
  signal_seen = 1;
}

}  // namespace

void catch_interrupts() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, remember_signal);
}

void check_interrupts() {
  if (signal_seen != 0) throw Error("interrupted; nothing was written");
}

}  // namespace movis::app
