// Compiled once for every vector instruction set, as classify.cpp is.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "find_white.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "movis/core/error.h"
#include "movis/scan/floor_scan.h"

HWY_BEFORE_NAMESPACE();
namespace movis::scan::HWY_NAMESPACE {

HWY_INLINE void append_white(std::vector<Stretch>& stretches, int row, int begin, int end) {
  if (!stretches.empty() && stretches.back().end == begin && stretches.back().row == row) {
    stretches.back().end = static_cast<std::uint16_t>(end);
    return;
  }
  stretches.push_back({static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(begin),
                       static_cast<std::uint16_t>(end), ObjectClass::line});
}

#if HWY_TARGET != HWY_SCALAR

namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::CappedTag<std::uint8_t, 64>;  // their mask fits in one word
using Words = hn::RepartitionToWide<Bytes>;

// Every other byte lane, even or odd, as the high byte of a word.
template <bool odd>
HWY_INLINE hn::Vec<Words> times_256(hn::Vec<Bytes> bytes) {
  const Words w;
  const auto words = hn::BitCast(w, bytes);
  return odd ? hn::And(words, hn::Set(w, 0xFF00)) : hn::ShiftLeft<8>(words);
}

// 0 in the words where both channels reach their share of G.
template <bool odd>
HWY_INLINE hn::Vec<Words> lacking(hn::Vec<Bytes> r, hn::Vec<Bytes> g, hn::Vec<Bytes> b, const WhiteBounds& bounds) {
  const Words w;
  const auto green = hn::ShiftRight<8>(times_256<odd>(g));
  const auto red_lacks = hn::SaturatedSub(hn::Mul(green, hn::Set(w, bounds.red)), times_256<odd>(r));
  const auto blue_lacks = hn::SaturatedSub(hn::Mul(green, hn::Set(w, bounds.blue)), times_256<odd>(b));
  return hn::Or(red_lacks, blue_lacks);
}

template <PixelFormat format>
HWY_INLINE std::uint64_t white_bits(const std::uint8_t* pixels, const WhiteBounds& bounds) {
  const Bytes d;
  const Words w;
  auto r = hn::Zero(d);
  auto g = hn::Zero(d);
  auto b = hn::Zero(d);
  auto alpha = hn::Zero(d);
  if constexpr (format == PixelFormat::rgba8) {
    hn::LoadInterleaved4(d, pixels, r, g, b, alpha);
  } else if constexpr (format == PixelFormat::rgb8) {
    hn::LoadInterleaved3(d, pixels, r, g, b);
  } else {
    hn::LoadInterleaved3(d, pixels, b, g, r);
  }
  const auto even = hn::VecFromMask(w, hn::Eq(lacking<false>(r, g, b, bounds), hn::Zero(w)));
  const auto odd = hn::VecFromMask(w, hn::Eq(lacking<true>(r, g, b, bounds), hn::Zero(w)));
  const auto low = hn::Set(w, 0x00FF);
  const auto white = hn::MaskFromVec(hn::BitCast(d, hn::Or(hn::And(even, low), hn::AndNot(low, odd))));
  const auto bright = hn::Eq(hn::Max(g, hn::Set(d, bounds.green)), g);
  const auto mask = hn::And(white, bright);
  if (hn::AllFalse(d, mask)) return 0;
  std::uint64_t bits = 0;
  hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
  return bits;
}

#endif  // not HWY_SCALAR

template <PixelFormat format>
void find_in_format(const ImageView& image, const std::vector<Run>& runs, const WhiteBounds& bounds,
                    std::vector<Stretch>& stretches) {
  constexpr int kChannels = channels(format);
  constexpr int kRed = format == PixelFormat::bgr8 ? 2 : 0;
  for (const Run& run : runs) {
    const std::uint8_t* row = image.row(run.row);
    int u = run.begin;
#if HWY_TARGET != HWY_SCALAR
    // The last vector may reach beyond the run, not beyond the row: what it finds there is judged like everything else.
    const int lanes = static_cast<int>(hn::Lanes(Bytes()));
    for (; u < run.end && u + lanes <= image.width; u += lanes) {
      std::uint64_t bits = white_bits<format>(row + kChannels * u, bounds);
      while (bits != 0) {
        const int begin = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
        const std::uint64_t ended = ~(bits >> begin);  // 0 where all 64 lanes are white
        const int end = begin + (ended == 0 ? 64 : static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(ended)));
        append_white(stretches, run.row, u + begin, u + end);
        bits = end >= 64 ? 0 : bits >> end << end;
      }
    }
#endif
    for (; u < run.end; ++u) {
      const std::uint8_t* pixel = row + kChannels * u;
      if (may_be_white(bounds, pixel[kRed], pixel[1], pixel[2 - kRed])) append_white(stretches, run.row, u, u + 1);
    }
  }
}

void find_in_image(const ImageView& image, const std::vector<Run>& runs, const WhiteBounds& bounds,
                   std::vector<Stretch>& stretches) {
  switch (image.format) {
    case PixelFormat::bgr8:
      return find_in_format<PixelFormat::bgr8>(image, runs, bounds, stretches);
    case PixelFormat::rgb8:
      return find_in_format<PixelFormat::rgb8>(image, runs, bounds, stretches);
    case PixelFormat::rgba8:
      return find_in_format<PixelFormat::rgba8>(image, runs, bounds, stretches);
    default:
      throw Error("lines are sought in BGR8, RGB8 or RGBA8 images, not in {}: convert it first", name(image.format));
  }
}

}  // namespace movis::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace movis::scan {

HWY_EXPORT(find_in_image);

void find_white(const ImageView& image, const std::vector<Run>& runs, const WhiteBounds& bounds,
                std::vector<Stretch>& stretches) {
  HWY_DYNAMIC_DISPATCH(find_in_image)(image, runs, bounds, stretches);
}

}  // namespace movis::scan
#endif
