#pragma once

#include <filesystem>

#include "movis/core/output_file.h"
#include "movis/pipeline/pipeline.h"
#include "outputs.h"

namespace movis::app {

// The estimates as CSV, one row a set; see docs/files.md for the columns. Numbers are written only with the status ok.
class EstimatesFile {
 public:
  explicit EstimatesFile(const std::filesystem::path& file);
  void add(const pipeline::Estimate& estimate);
  void flush() { app::flush(output_); }
  void commit() { output_.commit(); }

 private:
  OutputFile output_;
};

}  // namespace movis::app
