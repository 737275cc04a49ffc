#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "movis/core/image_view.h"

namespace movis::scan {

// Linear light of one pixel, 0…1.
struct Light {
  float r = 0.0F, g = 0.0F, b = 0.0F;
};

// sRGB's decoding (IEC 61966-2-1) of every byte.
const std::array<float, 256>& linear_light();

inline Light light_at(const ImageView& image, int u, int v) {
  const auto& linear = linear_light();
  const std::uint8_t* pixel = image.row(v) + static_cast<std::ptrdiff_t>(u) * channels(image.format);
  if (image.format == PixelFormat::bgr8) return {linear[pixel[2]], linear[pixel[1]], linear[pixel[0]]};
  return {linear[pixel[0]], linear[pixel[1]], linear[pixel[2]]};
}

// The opponent axes of hue: see colours.h.
inline float alpha(const Light& light) { return light.r - 0.5F * (light.g + light.b); }
inline float beta(const Light& light) { return 0.8660254F * (light.g - light.b); }
inline float brightness(const Light& light) { return std::max({light.r, light.g, light.b}); }

// The saturation along a hue, s of refine.h, in 0…1.
struct Saturation {
  float cos_hue = 1.0F;
  float sin_hue = 0.0F;
  float dark = 0.03F;

  float operator()(const Light& light) const {
    const float along = cos_hue * alpha(light) + sin_hue * beta(light);
    return std::max(0.0F, along) / (brightness(light) + dark);
  }
};

// w of refine.h.
struct Membership {
  Saturation saturation;
  float outside = 0.0F;  // the saturation of the surroundings
  float inside = 1.0F;   // of the object

  float operator()(const Light& light) const {
    return std::clamp((saturation(light) - outside) / (inside - outside), 0.0F, 1.0F);
  }
};

}  // namespace movis::scan
