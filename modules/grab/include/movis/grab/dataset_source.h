#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "movis/grab/dataset.h"
#include "movis/grab/image_source.h"

namespace movis::grab {

// The sets of a data set in the order of frames.csv. All images are BGR8: grey is spread to three channels, 16 bits
// keep their upper eight, alpha and an orientation in the metadata are ignored. A thread of its own decodes a few sets
// ahead; the memory of the sets goes round between it and the caller, so that after the first few none is allocated for
// images.
//
// All functions are to be called from one thread at a time; close() and the destructor end the decoding at any moment.
class DatasetSource final : public ImageSource {
 public:
  explicit DatasetSource(Dataset dataset);
  ~DatasetSource() override;
  DatasetSource(const DatasetSource&) = delete;
  DatasetSource& operator=(const DatasetSource&) = delete;

  // Checks that every image is there and starts decoding. Opened again, at any moment, it starts from the first set.
  // Throws where an image is missing or where the rig insists on a format other than BGR8; it is closed then.
  void open() override;

  // The next set; `set` gives its memory back. False at the end, then and ever after, `set` untouched. An image that
  // cannot be decoded is an Error in its turn: after the sets before it, and from then on every time. An Error where
  // the source is not open.
  bool acquire(FrameSet& set) override;

  // A set that was acquired stays valid. Closing a closed source does nothing.
  void close() override;

  const Dataset& dataset() const { return dataset_; }

 private:
  void decode_all();  // on thread_
  void decode(const DatasetFrame& row, FrameSet& set, std::vector<std::uint8_t>& bytes) const;

  const Dataset dataset_;
  bool open_ = false;
  std::thread thread_;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool stop_ = false;
  bool finished_ = false;       // no set will be added to ready_
  std::exception_ptr failure_;  // why, where it was not the end of the data set
  std::vector<FrameSet> free_;  // memory to decode into; its number bounds how far the thread runs ahead
  std::deque<FrameSet> ready_;
};

}  // namespace movis::grab
