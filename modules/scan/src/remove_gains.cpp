// Compiled once for every vector instruction set by Highway's foreach_target, as classify.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "remove_gains.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "movis/scan/light.h"

HWY_BEFORE_NAMESPACE();
namespace movis::scan::HWY_NAMESPACE {

// Factors in 1/256, by channel: below 2^15 / 128 for every gain that is believed.
using Factors = std::array<std::int16_t, 4>;

HWY_INLINE std::uint8_t scaled(std::uint8_t byte, std::int16_t factor) {
  return static_cast<std::uint8_t>(std::min(255, (byte * factor + 128) >> 8));
}

#if HWY_TARGET == HWY_SCALAR

// Factors of the bytes of one row, from its first pixel on.
struct RowScaler {
  RowScaler(const Factors& /*factors*/, int /*channels*/) {}
  int operator()(const std::uint8_t* /*from*/, int /*bytes*/, std::uint8_t* /*to*/) const { return 0; }
};

#else

namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::ScalableTag<std::uint8_t>;
using Words = hn::Repartition<std::int16_t, Bytes>;

// Three vectors hold whole pixels, of three channels or of four: the factors' pattern begins anew after them.
class RowScaler {
 public:
  RowScaler(const Factors& factors, int channels) {
    const int words = kVectors * lanes() / 2;
    for (int i = 0; i < words; ++i) {
      even_[i] = factors[2 * i % channels];
      odd_[i] = factors[(2 * i + 1) % channels];
    }
  }

  // Scales what fills three vectors at a time; the number of bytes that it has come to.
  int operator()(const std::uint8_t* from, int bytes, std::uint8_t* to) const {
    const Bytes d;
    const Words w;
    const hn::RepartitionToWide<Bytes> unsigned_words;
    const int step = lanes();
    const auto low = hn::Set(w, 0xFF);
    int at = 0;
    for (; at + kVectors * step <= bytes; at += kVectors * step) {
      for (int k = 0; k < kVectors; ++k) {
        const auto pixels = hn::LoadU(d, from + at + k * step);
        const auto even = hn::And(hn::BitCast(w, pixels), low);
        const auto odd = hn::BitCast(w, hn::ShiftRight<8>(hn::BitCast(unsigned_words, pixels)));
        const auto to_even = scale(even, hn::Load(w, even_ + k * step / 2));
        const auto to_odd = scale(odd, hn::Load(w, odd_ + k * step / 2));
        hn::StoreU(hn::BitCast(d, hn::Or(to_even, hn::ShiftLeft<8>(to_odd))), d, to + at + k * step);
      }
    }
    return at;
  }

 private:
  static constexpr int kVectors = 3;

  static int lanes() { return static_cast<int>(hn::Lanes(Bytes())); }

  // (128 x · f + 2^14) / 2^15 = (x f + 128) / 256
  static HWY_INLINE hn::Vec<Words> scale(hn::Vec<Words> bytes, hn::Vec<Words> factors) {
    return hn::Min(hn::MulFixedPoint15(hn::ShiftLeft<7>(bytes), factors), hn::Set(Words(), 255));
  }

  HWY_ALIGN std::int16_t even_[kVectors * HWY_MAX_BYTES / 2];
  HWY_ALIGN std::int16_t odd_[kVectors * HWY_MAX_BYTES / 2];
};

#endif  // HWY_SCALAR

void scale_pixels(const ImageView& image, const std::vector<Run>& runs, const Factors& factors, std::uint8_t* to) {
  const int bytes_a_pixel = channels(image.format);
  const RowScaler scaler(factors, bytes_a_pixel);
  for (const Run& run : runs) {
    const std::uint8_t* from = image.row(run.row) + static_cast<std::ptrdiff_t>(bytes_a_pixel) * run.begin;
    std::uint8_t* row = to + (static_cast<std::ptrdiff_t>(run.row) * image.width + run.begin) * bytes_a_pixel;
    const int bytes = (run.end - run.begin) * bytes_a_pixel;
    for (int i = scaler(from, bytes, row); i < bytes; ++i) row[i] = scaled(from[i], factors[i % bytes_a_pixel]);
  }
}

}  // namespace movis::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace movis::scan {

HWY_EXPORT(scale_pixels);

void remove_gains(const ImageView& image, const std::vector<Run>& runs, const Gains& gains, std::uint8_t* to) {
  const auto factor = [](double gain) { return static_cast<std::int16_t>(std::lround(256.0 / gain)); };
  constexpr std::int16_t kOne = 256;
  const bool bgr = image.format == PixelFormat::bgr8;
  HWY_DYNAMIC_DISPATCH(scale_pixels)
  (image, runs, {factor(bgr ? gains.b : gains.r), factor(gains.g), factor(bgr ? gains.r : gains.b), kOne}, to);
}

}  // namespace movis::scan
#endif
