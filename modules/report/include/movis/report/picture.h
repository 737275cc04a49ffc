#pragma once

#include <cstdint>
#include <vector>

namespace movis::report {

struct EncodedImage {
  std::vector<std::uint8_t> bytes;  // a whole PNG or JPEG file; empty: there is no picture
  int width = 0;                    // pixels
  int height = 0;
};

}  // namespace movis::report
