#pragma once

#include <visp3/core/vpFrameGrabber.h>

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "movis/grab/dataset.h"

namespace movis::grab {

// One camera of a data set as a frame grabber of ViSP, used as vpVideoReader is:
//
//   DatasetGrabber grabber("data/images/near");
//   grabber.setCameraIndex(1);
//   vpImage<vpRGBa> I;
//   grabber.open(I);
//   while (!grabber.end()) grabber.acquire(I);
//
// As there, open() shows the first image and acquire() begins with it, acquire() opens what is not open, and images
// that are not there (lost ones) are passed over: getFrameIndex() tells which frame it is. Names are ViSP's. Images are
// decoded when they are asked for. Everything that goes wrong is a vpFrameGrabberException with the Error's message.
class DatasetGrabber : public vpFrameGrabber {
 public:
  explicit DatasetGrabber(const std::filesystem::path& folder);

  // NOLINTBEGIN(readability-identifier-naming)
  unsigned int getNumCameras() const { return static_cast<unsigned int>(dataset_.rig.cameras.size()); }
  unsigned int getCameraIndex() const { return static_cast<unsigned int>(camera_); }
  void setCameraIndex(unsigned int index);  // in the rig's order, 0 unless set; closes the grabber

  void open(vpImage<unsigned char>& I) override;
  void open(vpImage<vpRGBa>& I) override;
  void acquire(vpImage<unsigned char>& I) override;  // throws after the last image
  void acquire(vpImage<vpRGBa>& I) override;
  void close() override;
  DatasetGrabber& operator>>(vpImage<unsigned char>& I);
  DatasetGrabber& operator>>(vpImage<vpRGBa>& I);

  bool end() const;  // has the camera's last image been acquired?

  // Of the image that was opened or acquired last.
  long getFrameIndex() const { return static_cast<long>(current().index); }
  double getFrameTime() const { return current().images[camera_].time_s; }  // seconds
  std::string getFrameName() const { return current().images[camera_].file.string(); }
  // NOLINTEND(readability-identifier-naming)

 private:
  const DatasetFrame& current() const { return dataset_.frames[current_]; }
  std::size_t next_image(std::size_t row) const;  // at or after the row; the number of rows where there is none
  void load_next(vpImage<vpRGBa>& I);             // an image becomes the current one

  Dataset dataset_;
  std::size_t camera_ = 0;
  std::size_t current_ = 0;  // rows of dataset_.frames
  std::size_t next_ = 0;
  std::vector<std::uint8_t> bytes_;
  cv::Mat bgr_;
  vpImage<vpRGBa> colour_;
};

}  // namespace movis::grab
