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

// Linear light below which something is black: the robots' bodies.
inline constexpr float kBlack = 0.035F;

inline float brightness(const Light& light) {
  return std::max({light.r, light.g, light.b});
}

// The opponent axes of hue (colours.h) over brightness, in linear light: what shading leaves alone.
struct Chromaticity {
  float alpha = 0.0F, beta = 0.0F;
};

inline Chromaticity operator+(const Chromaticity& a, const Chromaticity& b) {
  return {a.alpha + b.alpha, a.beta + b.beta};
}
inline Chromaticity operator-(const Chromaticity& a, const Chromaticity& b) {
  return {a.alpha - b.alpha, a.beta - b.beta};
}
inline Chromaticity operator*(const Chromaticity& c, float factor) {
  return {factor * c.alpha, factor * c.beta};
}
inline float dot(const Chromaticity& a, const Chromaticity& b) {
  return a.alpha * b.alpha + a.beta * b.beta;
}
inline float saturation(const Chromaticity& c) {
  return std::sqrt(dot(c, c));
}

inline Chromaticity chromaticity(const Light& light, float dark) {
  const float scale = 1.0F / (brightness(light) + dark);
  return {scale * (light.r - 0.5F * (light.g + light.b)), scale * 0.8660254F * (light.g - light.b)};
}

// How far a chromaticity has come from that of the surroundings to that of the object: w of refine.h.
inline float membership(const Chromaticity& c, const Chromaticity& outside, const Chromaticity& inside) {
  const Chromaticity way = inside - outside;
  return std::clamp(dot(c - outside, way) / dot(way, way), 0.0F, 1.0F);
}

}  // namespace movis::scan
