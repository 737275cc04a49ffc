#include "line_crossing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace movis::scan {
namespace {

float whiteness(const Light& light) {
  return light.r + light.b;
}

// What a byte's noise of one grey level is in linear light.
const std::array<float, 256>& light_per_level() {
  static const std::array<float, 256> table = [] {
    const auto& linear = linear_light();
    std::array<float, 256> slopes{};
    for (int i = 0; i < 256; ++i) {
      const int low = std::max(i - 1, 0);
      const int high = std::min(i + 1, 255);
      slopes[i] = (linear[high] - linear[low]) / static_cast<float>(high - low);
    }
    return slopes;
  }();
  return table;
}

// The carpet on one side: the mean of its two pixels, and how they differ.
struct Side {
  Light light;
  float flatness;  // |difference| of whiteness
  float noise;     // of the red and blue bytes: a sample of their variance
};

Side side_of(const Track& track, int near, int far) {
  const Light a = track.light(near);
  const Light b = track.light(far);
  const auto square = [](int value) { return static_cast<float>(value * value); };
  const float noise = 0.25F * (square(track.at(near)[track.red] - track.at(far)[track.red]) +
                               square(track.at(near)[2 - track.red] - track.at(far)[2 - track.red]));
  return {{0.5F * (a.r + b.r), 0.5F * (a.g + b.g), 0.5F * (a.b + b.b)}, std::abs(whiteness(a) - whiteness(b)), noise};
}

// White on carpet brightens all channels; yellow, blue, grey or a robot's band leave one behind.
bool balanced(const Light& white, const Light& carpet, double balance) {
  const auto [least, most] = std::minmax({white.r - carpet.r, white.g - carpet.g, white.b - carpet.b});
  return static_cast<double>(least) >= balance * static_cast<double>(most);
}

// Σ (i − c)² σ_i² for bytes of unit variance.
float moment_noise(const Track& track, int length, float middle) {
  const auto& per_level = light_per_level();
  float gain = 0.0F;
  for (int i = -1; i <= length; ++i) {
    const std::uint8_t* pixel = track.at(i);
    const float r = per_level[pixel[track.red]];
    const float b = per_level[pixel[2 - track.red]];
    const float lever = static_cast<float>(i) - middle;
    gain += lever * lever * (r * r + b * b);
  }
  return gain;
}

}  // namespace

std::optional<LineCrossing> measure_crossing(const Track& track, int length, const Carpet& carpet,
                                             const FloorOptions& options) {
  constexpr float kFlat = 0.1F;     // of the peak: the carpet's two pixels on one side
  constexpr float kLevel = 0.3F;    // both sides
  constexpr float kGoesOn = 0.35F;  // of the peak, along the line
  constexpr float kWhite = 0.85F;   // of the peak: pixels that are white all over
  constexpr float kResolved = 2.5F;
  const auto& linear = linear_light();
  const Side first = side_of(track, -2, -3);
  const Side last = side_of(track, length + 1, length + 2);
  const float from = whiteness(first.light);
  const float slope = (whiteness(last.light) - from) / static_cast<float>(length + 4);  // between −2.5 and length + 1.5
  std::array<float, kLongest + 2> excess{};
  float peak = 0.0F;
  int peak_at = 0;
  for (int i = -1; i <= length; ++i) {
    const std::uint8_t* pixel = track.at(i);
    const float white_here = linear[pixel[track.red]] + linear[pixel[2 - track.red]];
    const float e = white_here - from - slope * (static_cast<float>(i) + 2.5F);
    excess[i + 1] = e;
    if (e > peak) {
      peak = e;
      peak_at = i;
    }
  }
  const auto decoded = [&](float byte) { return linear[static_cast<int>(byte + 0.5F)]; };
  const float carpet_light = decoded(carpet.r) + decoded(carpet.g) + decoded(carpet.b);
  if (!(peak >= static_cast<float>(options.white_contrast) * carpet_light)) return std::nullopt;
  if (first.flatness > kFlat * peak || last.flatness > kFlat * peak) return std::nullopt;
  if (std::abs(whiteness(last.light) - from) > kLevel * peak) return std::nullopt;
  const Light& beside = 2 * peak_at < length ? first.light : last.light;
  if (!balanced(track.light(peak_at), beside, options.white_balance)) return std::nullopt;

  float sum = 0.0F;
  float moment = 0.0F;
  float white = 0.0F;
  int whites = 0;
  for (int i = -1; i <= length; ++i) {
    const float e = excess[i + 1];
    sum += e;
    moment += e * static_cast<float>(i);
    if (e < kWhite * peak) continue;
    white += e;
    ++whites;
  }
  LineCrossing crossing;
  crossing.middle = moment / sum;
  crossing.width = sum * static_cast<float>(whites) / white;
  crossing.resolved = crossing.width >= kResolved;
  crossing.level = from + kGoesOn * peak;
  crossing.noise_gain = moment_noise(track, length, crossing.middle) / (sum * sum);
  crossing.carpet_noise = 0.5F * (first.noise + last.noise);
  return crossing;
}

}  // namespace movis::scan
