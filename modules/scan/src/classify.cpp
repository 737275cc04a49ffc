// Compiled once for every vector instruction set by Highway's foreach_target; the best that the processor has is
// chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "classify.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include <cmath>
#include <cstring>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/scan/classify.h"

HWY_BEFORE_NAMESPACE();
namespace movis::scan::HWY_NAMESPACE {

struct Context {
  const std::vector<IntegerClass>& classes;
  std::uint8_t chroma_min;  // the least of all classes
  std::vector<Hit>& hits;
};

#if HWY_TARGET == HWY_SCALAR

constexpr int vector_lanes() {
  return 1;
}

template <PixelFormat format>
void classify_vector(const std::uint8_t* pixels, int u, int v, std::size_t /*count*/, const Context& context) {
  constexpr int kRed = format == PixelFormat::bgr8 ? 2 : 0;
  for (const IntegerClass& colour : context.classes) {
    if (!belongs(colour, pixels[kRed], pixels[1], pixels[2 - kRed])) continue;
    context.hits.push_back({static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v), colour.object});
    return;
  }
}

#else

namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::ScalableTag<std::uint8_t>;
using Words = hn::ScalableTag<std::int16_t>;
using ByteVector = hn::Vec<Bytes>;
using WordVector = hn::Vec<Words>;
using ByteMask = hn::Mask<Bytes>;

struct Colour {
  ByteVector r, g, b;
};

template <PixelFormat format>
Colour load(const std::uint8_t* pixels) {
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

// X = R − G and Y = B − G of every other pixel: the even or the odd byte lanes as 16-bit words.
struct Opponents {
  WordVector x, y;
};

Opponents even_opponents(const Colour& c) {
  const Words w;
  const auto low = hn::Set(w, 0xFF);
  const auto even = [&](ByteVector bytes) { return hn::And(hn::BitCast(w, bytes), low); };
  return {hn::Sub(even(c.r), even(c.g)), hn::Sub(even(c.b), even(c.g))};
}

Opponents odd_opponents(const Colour& c) {
  const Words w;
  const hn::RepartitionToWide<Bytes> unsigned_words;
  const auto odd = [&](ByteVector bytes) {
    return hn::BitCast(w, hn::ShiftRight<8>(hn::BitCast(unsigned_words, bytes)));
  };
  return {hn::Sub(odd(c.r), odd(c.g)), hn::Sub(odd(c.b), odd(c.g))};
}

// Negative words lie outside the hue sector.
WordVector sector(const IntegerClass& colour, const Opponents& o) {
  const Words w;
  const auto from = hn::Add(hn::Mul(hn::Set(w, colour.from_x), o.x), hn::Mul(hn::Set(w, colour.from_y), o.y));
  const auto to = hn::Add(hn::Mul(hn::Set(w, colour.to_x), o.x), hn::Mul(hn::Set(w, colour.to_y), o.y));
  return hn::Or(from, to);  // the sign bit of either
}

ByteMask within(ByteVector value, std::uint8_t min, std::uint8_t max) {
  const Bytes d;
  return hn::And(hn::Eq(hn::Max(value, hn::Set(d, min)), value), hn::Eq(hn::Min(value, hn::Set(d, max)), value));
}

ByteMask in_class(const IntegerClass& colour, ByteVector chroma, ByteVector brightness, const Opponents& even,
                  const Opponents& odd) {
  const Words w;
  const hn::ScalableTag<std::int8_t> s;
  // The words' high bytes back to their byte lanes: the even words' into the low bytes.
  const auto low = hn::Set(w, 0xFF);
  const auto outside =
      hn::Or(hn::And(hn::ShiftRight<8>(sector(colour, even)), low), hn::AndNot(low, sector(colour, odd)));
  const auto in_sector = hn::Not(hn::Lt(hn::BitCast(s, outside), hn::Zero(s)));
  return hn::And(hn::RebindMask(Bytes(), in_sector),
                 hn::And(within(chroma, colour.chroma_min, colour.chroma_max),
                         within(brightness, colour.brightness_min, colour.brightness_max)));
}

// Classifies the first `count` of a vector's pixels, the first of which is (u, v).
template <PixelFormat format>
HWY_INLINE void classify_vector(const std::uint8_t* pixels, int u, int v, std::size_t count, const Context& context) {
  const Bytes d;
  const Colour c = load<format>(pixels);
  const auto brightness = hn::Max(hn::Max(c.r, c.g), c.b);
  const auto chroma = hn::Sub(brightness, hn::Min(hn::Min(c.r, c.g), c.b));
  if (hn::AllTrue(d, hn::Lt(chroma, hn::Set(d, context.chroma_min)))) return;
  const Opponents even = even_opponents(c);
  const Opponents odd = odd_opponents(c);
  auto open = hn::FirstN(d, count);
  for (const IntegerClass& colour : context.classes) {
    const auto mask = hn::And(open, in_class(colour, chroma, brightness, even, odd));
    if (hn::AllFalse(d, mask)) continue;
    open = hn::AndNot(mask, open);
    std::uint64_t bits = 0;
    hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
    for (; bits != 0; bits &= bits - 1) {
      const int lane = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
      context.hits.push_back({static_cast<std::uint16_t>(u + lane), static_cast<std::uint16_t>(v), colour.object});
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
  HWY_ALIGN std::uint8_t tail[kChannels * HWY_MAX_BYTES] = {};
  for (const Run& run : runs) {
    const std::uint8_t* row = image.row(run.row);
    int u = run.begin;
    for (; u + lanes <= run.end; u += lanes) {
      classify_vector<format>(row + kChannels * u, u, run.row, static_cast<std::size_t>(lanes), context);
    }
    if (u < run.end) {  // a vector's load would reach beyond the run, at the end of the image beyond its memory
      std::memcpy(tail, row + kChannels * u, static_cast<std::size_t>(kChannels) * (run.end - u));
      classify_vector<format>(tail, u, run.row, static_cast<std::size_t>(run.end - u), context);
    }
  }
}

void classify_image(const ImageView& image, const std::vector<Run>& runs, const std::vector<IntegerClass>& classes,
                    std::vector<Hit>& hits) {
  std::uint8_t chroma_min = 255;
  for (const IntegerClass& colour : classes) chroma_min = std::min(chroma_min, colour.chroma_min);
  const Context context{classes, chroma_min, hits};
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
              std::vector<Hit>& hits) {
  HWY_DYNAMIC_DISPATCH(classify_image)(image, runs, classes, hits);
}

IntegerClass to_integers(const ColourClass& colour) {
  constexpr double kScale = 74.0;
  const auto word = [](double coefficient) { return static_cast<std::int16_t>(std::lround(kScale * coefficient)); };
  const auto at_least = [](double fraction) { return static_cast<std::uint8_t>(std::ceil(255.0 * fraction - 1e-9)); };
  const auto at_most = [](double fraction) { return static_cast<std::uint8_t>(std::floor(255.0 * fraction + 1e-9)); };
  IntegerClass integers;
  if (colour.hue_width < kPi) {
    // Counter-clockwise from the border at angle h: β cos h − α sin h ≥ 0, with α = X − Y/2 and β = −√3/2 Y, so that
    // the coefficients are −sin h and sin h/2 − √3/2 cos h = sin(h − 60°).
    const double from = colour.hue_from;
    const double to = colour.hue_from + colour.hue_width;
    integers.from_x = word(-std::sin(from));
    integers.from_y = word(std::sin(from - kPi / 3.0));
    integers.to_x = word(std::sin(to));
    integers.to_y = word(-std::sin(to - kPi / 3.0));
  }
  integers.chroma_min = at_least(colour.chroma_min);
  integers.chroma_max = at_most(colour.chroma_max);
  integers.brightness_min = at_least(colour.brightness_min);
  integers.brightness_max = at_most(colour.brightness_max);
  integers.object = colour.object;
  return integers;
}

}  // namespace movis::scan
#endif
