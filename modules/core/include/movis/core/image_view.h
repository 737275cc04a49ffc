#pragma once

#include <cstddef>
#include <cstdint>

namespace movis {

enum class PixelFormat : std::uint8_t { bgr8, rgb8, rgba8, mono8, bayer_rggb8, bayer_bggr8, bayer_grbg8, bayer_gbrg8 };

constexpr int channels(PixelFormat format) {
  return format == PixelFormat::rgba8 ? 4 : format == PixelFormat::bgr8 || format == PixelFormat::rgb8 ? 3 : 1;
}

const char* name(PixelFormat format);

// Pixels that somebody else owns, row by row; pixel (0,0) is the top-left one. `stride` is the distance of two rows
// in bytes.
struct ImageView {
  const std::uint8_t* data = nullptr;
  int width = 0;
  int height = 0;
  std::ptrdiff_t stride = 0;
  PixelFormat format = PixelFormat::bgr8;

  bool empty() const { return data == nullptr; }
  const std::uint8_t* row(int v) const { return data + v * stride; }
};

}  // namespace movis
