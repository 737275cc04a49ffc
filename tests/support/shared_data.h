#pragma once

#include <cstdlib>
#include <filesystem>

namespace movis::test {

// Data sets outside the project: the environment's MOVIS_SHARED_DATA, else ../shared/data beside the source tree.
inline std::filesystem::path shared_data() {
  if (const char* chosen = std::getenv("MOVIS_SHARED_DATA"); chosen != nullptr && *chosen != '\0') return chosen;
  return std::filesystem::path(MOVIS_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace movis::test

// Skips the running test, saying so, where a shared data set is absent.
#define MOVIS_NEEDS_SHARED_DATA(folder)                                                                      \
  if (!std::filesystem::is_directory(folder)) {                                                              \
    GTEST_SKIP() << (folder) << " is absent; set MOVIS_SHARED_DATA to the folder with the shared data sets"; \
  }
