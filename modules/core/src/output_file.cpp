#include "movis/core/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "movis/core/error.h"

namespace movis {
namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path file) : file_(std::move(file)) {
  std::error_code ignored;
  if (fs::is_symlink(file_, ignored)) file_ = fs::weakly_canonical(file_, ignored);
  const fs::path folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored)) {
    throw Error("{}: the folder '{}' does not exist; create it first", file_.string(), folder.string());
  }
  if (fs::is_directory(file_, ignored)) throw Error("{}: is a folder; name a file", file_.string());
  direct_ = fs::exists(file_, ignored) && !fs::is_regular_file(file_, ignored);
  draft_ = file_;
  if (!direct_) draft_ += fmt::format(".{}.tmp", ::getpid());
  stream_.open(draft_, std::ios::binary);
  if (!stream_) throw Error("{}: cannot be written: {}", file_.string(), std::strerror(errno));
}

OutputFile::~OutputFile() {
  if (committed_ || direct_) return;
  stream_.close();
  std::error_code ignored;
  fs::remove(draft_, ignored);
}

void OutputFile::commit() {
  stream_.close();
  if (!stream_) throw Error("{}: writing failed; is the disk full?", file_.string());
  if (!direct_) {
    std::error_code error;
    fs::rename(draft_, file_, error);
    if (error) throw Error("{}: cannot be written: {}", file_.string(), error.message());
  }
  committed_ = true;
}

}  // namespace movis
