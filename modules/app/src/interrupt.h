#pragma once

namespace movis::app {

// From now on SIGINT, SIGTERM and SIGHUP end the work in an orderly way: by an Error at the next check_interrupts(), so
// that drafts of files are removed.
void catch_interrupts();

// Throws an Error where a signal has come. To be called once in every step of long work.
void check_interrupts();

}  // namespace movis::app
