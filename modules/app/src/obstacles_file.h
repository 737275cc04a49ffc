#pragma once

#include <filesystem>

#include "movis/core/output_file.h"
#include "movis/pipeline/pipeline.h"
#include "outputs.h"

namespace movis::app {

// The obstacles of every set as CSV, one row an obstacle; see docs/files.md for the columns.
class ObstaclesFile {
 public:
  explicit ObstaclesFile(const std::filesystem::path& file);
  void add(const pipeline::Estimate& estimate);
  void flush() { app::flush(output_); }
  void commit() { output_.commit(); }

 private:
  OutputFile output_;
};

}  // namespace movis::app
