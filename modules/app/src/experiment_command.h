#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace movis::app {

struct ExperimentArguments {
  std::string experiment;  // a name in data/experiments, or a YAML file
  std::optional<std::filesystem::path> out;
  std::int64_t seed = 1;
  int jobs = 0;  // threads; 0: as many as there are cores
  bool quick = false;
  bool resume = false;
  std::optional<std::int64_t> replay;  // a row
};

// `movis experiment`: runs it and writes rows.csv, summary.json and index.html into one folder; or recomputes one row
// of such a folder and prints it beside the stored one. Throws an Error; rows that were finished before stay.
void experiment(const ExperimentArguments& arguments);

}  // namespace movis::app
