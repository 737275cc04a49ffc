#pragma once

#include <filesystem>
#include <fstream>

namespace movis {

// A file that appears under its name only when it is complete: it is written beside its place and moved there by
// commit(). Without commit() nothing is left behind. A link is followed; what is no regular file, a device or a pipe, is
// written to as it is.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  std::ostream& stream() { return stream_; }
  void commit();  // throws where the disk is full or the place cannot be written

 private:
  std::filesystem::path file_;
  std::filesystem::path draft_;
  std::ofstream stream_;
  bool direct_ = false;  // no draft: file_ is a device or a pipe
  bool committed_ = false;
};

}  // namespace movis
