#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <stdexcept>
#include <string>

namespace movis::test {

struct ProgramRun {
  int exit_code = -1;
  std::string output;  // standard output and standard error
};

// Runs a command line in a shell and waits for it.
inline ProgramRun run_program(const std::string& command_line) {
  ProgramRun run;
  std::FILE* pipe = popen((command_line + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run: " + command_line);
  char buffer[4096];
  while (const std::size_t read = std::fread(buffer, 1, sizeof buffer, pipe)) run.output.append(buffer, read);
  const int status = pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return run;
}

}  // namespace movis::test
