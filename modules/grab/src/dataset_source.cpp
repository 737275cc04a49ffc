#include "movis/grab/dataset_source.h"

#include <utility>

#include "dataset_image.h"
#include "movis/core/error.h"
#include "movis/grab/views.h"

namespace movis::grab {
namespace {

constexpr std::size_t kSetsAhead = 4;

void check_formats(const Dataset& dataset) {
  for (const omni::Camera& camera : dataset.rig.cameras) {
    if (camera.format.value_or(PixelFormat::bgr8) == PixelFormat::bgr8) continue;
    throw Error(
        "{}: camera '{}' insists on the format {}, but the images of a data set are read as BGR8; remove `format`",
        dataset.rig_file.string(), camera.name, name(*camera.format));
  }
}

}  // namespace

DatasetSource::DatasetSource(Dataset dataset) : dataset_(std::move(dataset)) {}

DatasetSource::~DatasetSource() {
  close();
}

void DatasetSource::open() {
  close();
  check_formats(dataset_);
  check_images(dataset_);
  free_.resize(kSetsAhead);
  thread_ = std::thread([this] { decode_all(); });
  open_ = true;
}

void DatasetSource::close() {
  if (thread_.joinable()) {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }
  open_ = stop_ = finished_ = false;
  failure_ = nullptr;
  free_.clear();
  ready_.clear();
}

bool DatasetSource::acquire(FrameSet& set) {
  if (!open_) throw Error("{}: the data set is not open; call open() before acquire()", dataset_.folder.string());
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !ready_.empty() || finished_; });
  if (ready_.empty()) {
    if (failure_) std::rethrow_exception(failure_);
    return false;
  }
  free_.push_back(std::exchange(set, std::move(ready_.front())));
  ready_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return true;
}

void DatasetSource::decode_all() {
  std::exception_ptr failure;
  try {
    std::vector<std::uint8_t> bytes;
    for (const DatasetFrame& row : dataset_.frames) {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return !free_.empty() || stop_; });
      if (stop_) return;
      FrameSet set = std::move(free_.back());
      free_.pop_back();
      lock.unlock();
      decode(row, set, bytes);
      lock.lock();
      ready_.push_back(std::move(set));
      lock.unlock();
      changed_.notify_all();
    }
  } catch (...) {
    failure = std::current_exception();
  }
  {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    failure_ = std::move(failure);
  }
  changed_.notify_all();
}

void DatasetSource::decode(const DatasetFrame& row, FrameSet& set, std::vector<std::uint8_t>& bytes) const {
  set.index = row.index;
  set.time_s = row.time_s;
  set.frames.resize(row.images.size());
  set.memory.resize(row.images.size());
  for (std::size_t k = 0; k < row.images.size(); ++k) {
    set.frames[k] = {{}, row.images[k].time_s};
    if (row.images[k].file.empty()) continue;
    read_image(dataset_, row, k, bytes, set.memory[k]);
    set.frames[k].view = view_of(set.memory[k]);
  }
}

}  // namespace movis::grab
