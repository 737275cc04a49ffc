#include "movis/grab/dataset_grabber.h"

#include <visp3/core/vpFrameGrabberException.h>
#include <visp3/core/vpImageConvert.h>

#include "dataset_image.h"
#include "movis/core/error.h"
#include "movis/grab/views.h"

namespace movis::grab {
namespace {

// Runs a function; its Error becomes ViSP's exception.
template <typename Function>
auto as_visp(vpFrameGrabberException::errorFrameGrabberCodeEnum code, Function function) {
  try {
    return function();
  } catch (const Error& error) {
    throw vpFrameGrabberException(code, std::string(error.what()));
  }
}

}  // namespace

DatasetGrabber::DatasetGrabber(const std::filesystem::path& folder)
    : dataset_(as_visp(vpFrameGrabberException::initializationError, [&] { return read_dataset(folder); })) {}

void DatasetGrabber::setCameraIndex(unsigned int index) {
  if (index >= getNumCameras()) {
    throw vpFrameGrabberException(vpFrameGrabberException::settingError,
                                  fmt::format("{}: there is no camera {}; its {} cameras count from 0",
                                              dataset_.folder.string(), index, getNumCameras()));
  }
  close();
  camera_ = index;
}

void DatasetGrabber::open(vpImage<vpRGBa>& I) {
  close();
  const omni::Camera& camera = dataset_.rig.cameras[camera_];
  as_visp(vpFrameGrabberException::initializationError, [&] {
    check_images(dataset_);
    next_ = next_image(0);
    if (next_ == dataset_.frames.size()) {
      throw Error("{}: every image of camera '{}' is lost; choose another camera", dataset_.folder.string(),
                  camera.name);
    }
    load_next(I);
  });
  width = static_cast<unsigned int>(camera.width);
  height = static_cast<unsigned int>(camera.height);
  init = true;
}

void DatasetGrabber::acquire(vpImage<vpRGBa>& I) {
  if (!init) open(I);
  as_visp(vpFrameGrabberException::otherError, [&] {
    if (end()) {
      throw Error("{}: the data set has no image after frame {}; ask end() before acquire()", dataset_.folder.string(),
                  getFrameIndex());
    }
    load_next(I);
  });
  next_ = next_image(next_ + 1);
}

void DatasetGrabber::open(vpImage<unsigned char>& I) {
  open(colour_);
  vpImageConvert::convert(colour_, I);
}

void DatasetGrabber::acquire(vpImage<unsigned char>& I) {
  acquire(colour_);
  vpImageConvert::convert(colour_, I);
}

void DatasetGrabber::close() {
  init = false;
}

DatasetGrabber& DatasetGrabber::operator>>(vpImage<unsigned char>& I) {
  acquire(I);
  return *this;
}

DatasetGrabber& DatasetGrabber::operator>>(vpImage<vpRGBa>& I) {
  acquire(I);
  return *this;
}

bool DatasetGrabber::end() const {
  return init && next_ == dataset_.frames.size();
}

std::size_t DatasetGrabber::next_image(std::size_t row) const {
  while (row < dataset_.frames.size() && dataset_.frames[row].images[camera_].file.empty()) ++row;
  return row;
}

void DatasetGrabber::load_next(vpImage<vpRGBa>& I) {
  read_image(dataset_, dataset_.frames[next_], camera_, bytes_, bgr_);
  copy(view_of(bgr_), I);
  current_ = next_;
}

}  // namespace movis::grab
