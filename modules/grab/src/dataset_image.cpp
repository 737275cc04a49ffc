#include "dataset_image.h"

#include <algorithm>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <string_view>

#include "movis/core/error.h"

namespace movis::grab {
namespace {

using Bytes = std::vector<std::uint8_t>;

bool starts_with(const Bytes& bytes, std::string_view signature) {
  return bytes.size() >= signature.size() &&
         std::equal(signature.begin(), signature.end(), bytes.begin(),
                    [](char expected, std::uint8_t byte) { return static_cast<std::uint8_t>(expected) == byte; });
}

std::size_t big_endian(const Bytes& bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
  return value;
}

// Walks from chunk to chunk (length, type, data, checksum) until IEND; bytes after it are no harm.
bool png_is_complete(const Bytes& bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    if (std::string_view(reinterpret_cast<const char*>(&bytes[at + 4]), 4) == "IEND") return true;
    at += 12 + big_endian(bytes, at, 4);
  }
  return false;
}

// Walks from marker to marker until the end of the image. Segments are skipped by their length, since a thumbnail in
// one of them has an end of its own; bytes after the end are no harm.
bool jpeg_is_complete(const Bytes& bytes) {
  auto at = bytes.begin() + 2;
  for (;;) {
    at = std::find(at, bytes.end(), 0xFF);
    at = std::find_if(at, bytes.end(), [](std::uint8_t byte) { return byte != 0xFF; });
    if (at == bytes.end()) return false;
    const std::uint8_t marker = *at++;
    if (marker == 0xD9) return true;
    if (marker <= 0x01 || (marker >= 0xD0 && marker <= 0xD8)) continue;  // part of the data, or without a length
    if (bytes.end() - at < 2) return false;
    const auto length = static_cast<std::ptrdiff_t>(big_endian(bytes, static_cast<std::size_t>(at - bytes.begin()), 2));
    if (bytes.end() - at < length) return false;
    at += length;
  }
}

// OpenCV decodes a JPEG that was cut off without a word, the missing part grey.
bool is_cut_off(const Bytes& bytes) {
  if (starts_with(bytes, "\x89PNG\r\n\x1A\n")) return !png_is_complete(bytes);
  if (starts_with(bytes, "\xFF\xD8")) return !jpeg_is_complete(bytes);
  return false;
}

bool read_bytes(const std::filesystem::path& file, Bytes& bytes) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (!stream || error) return false;
  bytes.resize(size);
  return stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)).good();
}

// Where it does not understand a file's head, cv::imdecode() leaves the matrix that it is given as it was, and the
// image before would pass for this one. So a pixel is marked; where the mark is still there, a new matrix tells what
// happened.
bool decode(const Bytes& bytes, cv::Mat& image) {
  static constexpr int kFlags = cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION;
  const cv::Vec3b mark(1, 254, 3);
  try {
    image.at<cv::Vec3b>(0, 0) = mark;
    cv::imdecode(bytes, kFlags, &image);
    if (!image.empty() && image.at<cv::Vec3b>(0, 0) == mark) image = cv::imdecode(bytes, kFlags);
    return !image.empty();
  } catch (const cv::Exception&) {
    return false;
  }
}

}  // namespace

void read_image(const Dataset& dataset, const DatasetFrame& frame, std::size_t camera, Bytes& bytes, cv::Mat& image) {
  const std::string file = frame.images[camera].file.string();
  const auto fail = [&](const std::string& what) {
    throw Error("{}: the image '{}' {}", where(dataset, frame, camera), file, what);
  };
  static constexpr const char* kOtherwise = "; copy it again, or leave the cell empty if the image is lost";
  if (!read_bytes(file, bytes)) fail("cannot be read; check that it is there and may be read");
  if (bytes.empty()) fail(std::string("is an empty file") + kOtherwise);
  if (is_cut_off(bytes)) fail(std::string("is cut off before its end") + kOtherwise);
  const omni::Camera& expected = dataset.rig.cameras[camera];
  image.create(expected.height, expected.width, CV_8UC3);
  if (!decode(bytes, image)) fail("cannot be decoded; is it an undamaged PNG or JPEG image?");
  if (image.cols != expected.width || image.rows != expected.height) {
    fail(fmt::format(
        "has {}x{} pixels where {} says {}x{} for camera '{}'; name the rig of these images, or correct its image size",
        image.cols, image.rows, dataset.rig_file.string(), expected.width, expected.height, expected.name));
  }
}

}  // namespace movis::grab
