// Compiled once for every vector instruction set by Highway's foreach_target; the best that the processor has is
// chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "classify.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include <algorithm>
#include <cstring>

#include "movis/core/error.h"
#include "movis/scan/classify.h"

HWY_BEFORE_NAMESPACE();
namespace movis::scan::HWY_NAMESPACE {

struct Context {
  const std::vector<IntegerClass>& classes;
  std::vector<Stretch>& stretches;
};

// A stretch that goes on where the last one ended is part of it.
HWY_INLINE void append(std::vector<Stretch>& stretches, int row, int begin, int end, ObjectClass object) {
  if (!stretches.empty()) {
    Stretch& last = stretches.back();
    if (last.end == begin && last.row == row && last.object == object) {
      last.end = static_cast<std::uint16_t>(end);
      return;
    }
  }
  stretches.push_back(
      {static_cast<std::uint16_t>(row), static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(end), object});
}

#if HWY_TARGET == HWY_SCALAR

constexpr int vector_lanes() {
  return 1;
}

template <PixelFormat format>
void classify_vector(const std::uint8_t* pixels, int u, int v, std::size_t /*skipped*/, const Context& context) {
  constexpr int kRed = format == PixelFormat::bgr8 ? 2 : 0;
  for (const IntegerClass& colour : context.classes) {
    if (!belongs(colour, pixels[kRed], pixels[1], pixels[2 - kRed])) continue;
    append(context.stretches, v, u, u + 1, colour.object);
    return;
  }
}

#else

namespace hn = hwy::HWY_NAMESPACE;
// At most 64 lanes: their mask fits in one word.
using Bytes = hn::CappedTag<std::uint8_t, 64>;
using Words = hn::Repartition<std::int16_t, Bytes>;
using ByteVector = hn::Vec<Bytes>;
using WordVector = hn::Vec<Words>;
using ByteMask = hn::Mask<Bytes>;

struct Colour {
  ByteVector r, g, b;
};

template <PixelFormat format>
HWY_INLINE Colour load(const std::uint8_t* pixels) {
  const Bytes d;
  Colour c{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  if constexpr (format == PixelFormat::rgba8) {
    ByteVector alpha;
    hn::LoadInterleaved4(d, pixels, c.r, c.g, c.b, alpha);
  } else if constexpr (format == PixelFormat::rgb8) {
    hn::LoadInterleaved3(d, pixels, c.r, c.g, c.b);
  } else {
    hn::LoadInterleaved3(d, pixels, c.b, c.g, c.r);
  }
  return c;
}

// X = R − G and Y = B − G of every other pixel: the even or the odd byte lanes as 16-bit words. (Lambdas would not be
// compiled for the vector target, hence the small functions.)
struct Opponents {
  WordVector x, y;
};

HWY_INLINE WordVector even_bytes(ByteVector bytes) {
  const Words w;
  return hn::And(hn::BitCast(w, bytes), hn::Set(w, 0xFF));
}

HWY_INLINE WordVector odd_bytes(ByteVector bytes) {
  const hn::RepartitionToWide<Bytes> unsigned_words;
  return hn::BitCast(Words(), hn::ShiftRight<8>(hn::BitCast(unsigned_words, bytes)));
}

HWY_INLINE Opponents even_opponents(const Colour& c) {
  const WordVector g = even_bytes(c.g);
  return {hn::Sub(even_bytes(c.r), g), hn::Sub(even_bytes(c.b), g)};
}

HWY_INLINE Opponents odd_opponents(const Colour& c) {
  const WordVector g = odd_bytes(c.g);
  return {hn::Sub(odd_bytes(c.r), g), hn::Sub(odd_bytes(c.b), g)};
}

// Negative words lie outside the hue sector.
HWY_INLINE WordVector sector(const IntegerClass& colour, const Opponents& o) {
  const Words w;
  const auto from = hn::Add(hn::Mul(hn::Set(w, colour.from_x), o.x), hn::Mul(hn::Set(w, colour.from_y), o.y));
  const auto to = hn::Add(hn::Mul(hn::Set(w, colour.to_x), o.x), hn::Mul(hn::Set(w, colour.to_y), o.y));
  return hn::Or(from, to);  // the sign bit of either
}

HWY_INLINE ByteMask within(ByteVector value, std::uint8_t min, std::uint8_t max) {
  const Bytes d;
  return hn::And(hn::Eq(hn::Max(value, hn::Set(d, min)), value), hn::Eq(hn::Min(value, hn::Set(d, max)), value));
}

HWY_INLINE ByteVector channel(const Colour& c, std::uint8_t index) {
  return index == 0 ? c.r : index == 1 ? c.g : c.b;
}

HWY_INLINE ByteMask may_belong(const IntegerClass& colour, const Colour& c) {
  const auto ahead = hn::SaturatedSub(channel(c, colour.lead), channel(c, colour.trail));
  return within(ahead, colour.lead_min, 255);
}

HWY_INLINE ByteMask in_class(const IntegerClass& colour, ByteVector chroma, ByteVector brightness,
                             const Opponents& even, const Opponents& odd) {
  const Words w;
  const hn::Repartition<std::int8_t, Bytes> s;
  // The words' high bytes back to their byte lanes: the even words' into the low bytes.
  const auto low = hn::Set(w, 0xFF);
  const auto outside =
      hn::Or(hn::And(hn::ShiftRight<8>(sector(colour, even)), low), hn::AndNot(low, sector(colour, odd)));
  const auto in_sector = hn::Not(hn::Lt(hn::BitCast(s, outside), hn::Zero(s)));
  return hn::And(hn::RebindMask(Bytes(), in_sector),
                 hn::And(within(chroma, colour.chroma_min, colour.chroma_max),
                         within(brightness, colour.brightness_min, colour.brightness_max)));
}

// Classifies a vector's pixels, the first of which is (u, v), without the first `skipped` ones.
template <PixelFormat format>
HWY_INLINE void classify_vector(const std::uint8_t* pixels, int u, int v, std::size_t skipped, const Context& context) {
  const Bytes d;
  const Colour c = load<format>(pixels);
  bool possible = false;
  for (const IntegerClass& colour : context.classes) possible |= !hn::AllFalse(d, may_belong(colour, c));
  if (!possible) return;
  const auto brightness = hn::Max(hn::Max(c.r, c.g), c.b);
  const auto chroma = hn::Sub(brightness, hn::Min(hn::Min(c.r, c.g), c.b));
  const Opponents even = even_opponents(c);
  const Opponents odd = odd_opponents(c);
  auto open = hn::Not(hn::FirstN(d, skipped));
  for (const IntegerClass& colour : context.classes) {
    const auto mask = hn::And(open, in_class(colour, chroma, brightness, even, odd));
    if (hn::AllFalse(d, mask)) continue;
    open = hn::AndNot(mask, open);
    std::uint64_t bits = 0;
    hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
    while (bits != 0) {
      const int begin = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      const std::uint64_t ended = ~(bits >> begin);  // 0 where all 64 lanes belong to the class
      const int length = ended == 0 ? 64 : static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(ended));
      append(context.stretches, v, u + begin, u + begin + length, colour.object);
      const int end = begin + length;
      bits = end >= 64 ? 0 : bits >> end << end;
    }
  }
}

int vector_lanes() {
  return static_cast<int>(hn::Lanes(Bytes()));
}

#endif  // HWY_SCALAR

template <PixelFormat format>
void classify_format(const ImageView& image, const std::vector<Run>& runs, const Context& context) {
  constexpr int kChannels = channels(format);
  const int lanes = vector_lanes();
  for (const Run& run : runs) {
    const std::uint8_t* row = image.row(run.row);
    int u = run.begin;
    for (; u + lanes <= run.end; u += lanes) classify_vector<format>(row + kChannels * u, u, run.row, 0, context);
    if (u == run.end) continue;
    if (run.end >= lanes) {  // the last vector ends with the run and skips what it shares with the one before
      const int first = run.end - lanes;
      classify_vector<format>(row + kChannels * first, first, run.row, static_cast<std::size_t>(u - first), context);
    } else {  // the row has no room for a vector: a copy, shifted to the vector's end
      HWY_ALIGN std::uint8_t copy[kChannels * HWY_MAX_BYTES] = {};
      const int skipped = lanes - (run.end - u);
      std::memcpy(copy + kChannels * skipped, row + kChannels * u, static_cast<std::size_t>(kChannels) * (run.end - u));
      classify_vector<format>(copy, u - skipped, run.row, static_cast<std::size_t>(skipped), context);
    }
  }
}

void classify_image(const ImageView& image, const std::vector<Run>& runs, const std::vector<IntegerClass>& classes,
                    std::vector<Stretch>& stretches) {
  const Context context{classes, stretches};
  switch (image.format) {
    case PixelFormat::bgr8:
      return classify_format<PixelFormat::bgr8>(image, runs, context);
    case PixelFormat::rgb8:
      return classify_format<PixelFormat::rgb8>(image, runs, context);
    case PixelFormat::rgba8:
      return classify_format<PixelFormat::rgba8>(image, runs, context);
    default:
      throw Error("colours are scanned in BGR8, RGB8 or RGBA8 images, not in {}: convert it first", name(image.format));
  }
}

}  // namespace movis::scan::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace movis::scan {

HWY_EXPORT(classify_image);

void classify(const ImageView& image, const std::vector<Run>& runs, const std::vector<IntegerClass>& classes,
              std::vector<Stretch>& stretches) {
  HWY_DYNAMIC_DISPATCH(classify_image)(image, runs, classes, stretches);
}

}  // namespace movis::scan
#endif
