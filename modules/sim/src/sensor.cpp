// Compiled once for every vector instruction set by Highway's foreach_target; the best that the processor has is
// chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sensor.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include <cstring>

#include "sensor.h"

HWY_BEFORE_NAMESPACE();
namespace movis::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, kMostLanes>;
using Words = hn::RebindToUnsigned<Floats>;
using Signed = hn::RebindToSigned<Floats>;
using Bytes = hn::Rebind<std::uint8_t, Floats>;
using FloatVector = hn::Vec<Floats>;
using WordVector = hn::Vec<Words>;
using ByteVector = hn::Vec<Bytes>;

// Σ taps[|k|] rows[k][i] over k = −kRadius…kRadius, for the vector that begins at i.
template <int kRadius>
HWY_INLINE FloatVector blurred_down(const float* const* middle, const float* taps, int i) {
  const Floats d;
  FloatVector sum = hn::Mul(hn::Set(d, taps[0]), hn::LoadU(d, middle[0] + i));
  for (int k = 1; k <= kRadius; ++k) {
    const FloatVector pair = hn::Add(hn::LoadU(d, middle[-k] + i), hn::LoadU(d, middle[k] + i));
    sum = hn::MulAdd(hn::Set(d, taps[k]), pair, sum);
  }
  return sum;
}

// The same along a row.
template <int kRadius>
HWY_INLINE FloatVector blurred_along(const float* middle, const float* taps) {
  const Floats d;
  FloatVector sum = hn::Mul(hn::Set(d, taps[0]), hn::LoadU(d, middle));
  for (int k = 1; k <= kRadius; ++k) {
    const FloatVector pair = hn::Add(hn::LoadU(d, middle - k), hn::LoadU(d, middle + k));
    sum = hn::MulAdd(hn::Set(d, taps[k]), pair, sum);
  }
  return sum;
}

HWY_INLINE WordVector mixed(WordVector value) {
  const Words words;
  value = hn::Mul(value, hn::Set(words, 0x9E3779B1U));
  value = hn::Xor(value, hn::ShiftRight<15>(value));
  value = hn::Mul(value, hn::Set(words, 0x85EBCA77U));
  return hn::Xor(value, hn::ShiftRight<13>(value));
}

// Numbers of mean 0 and variance 1, one for each counter: the sum of four bytes of a mixed counter, which is close to a
// normal distribution (kurtosis 2.7, no value beyond 3.5 sigma) and needs no table.
HWY_INLINE FloatVector normals(WordVector counter) {
  const Floats d;
  const Words words;
  constexpr float kMean = 510.0F;          // 4 · 255/2
  constexpr float kScale = 0.0067658751F;  // 1/√(4 · (256² − 1)/12)
  const WordVector even_bytes = hn::Set(words, 0x00FF00FFU);
  const WordVector bits = mixed(counter);
  const WordVector pairs = hn::Add(hn::And(bits, even_bytes), hn::And(hn::ShiftRight<8>(bits), even_bytes));
  const WordVector sum = hn::And(hn::Add(pairs, hn::ShiftRight<16>(pairs)), hn::Set(words, 0xFFFFU));
  const FloatVector value = hn::ConvertTo(d, hn::BitCast(Signed(), sum));
  return hn::Mul(hn::Sub(value, hn::Set(d, kMean)), hn::Set(d, kScale));
}

// 255 times the sRGB curve for x in 0…1. Above its linear part it is a polynomial of √x, fitted to be at most 0.04 off.
HWY_INLINE FloatVector tone(FloatVector x) {
  const Floats d;
  constexpr float kLinearEnd = 0.0031308F;
  constexpr float kSlope = 255.0F * 12.92F;
  constexpr float kPolynomial[] = {-10.770079F,   401.713145F, -484.501249F, 994.542289F,
                                   -1276.530508F, 872.345641F, -241.837391F};
  const FloatVector root = hn::Sqrt(x);
  FloatVector curve = hn::Set(d, kPolynomial[6]);
  for (int i = 5; i >= 0; --i) curve = hn::MulAdd(curve, root, hn::Set(d, kPolynomial[i]));
  return hn::IfThenElse(hn::Lt(x, hn::Set(d, kLinearEnd)), hn::Mul(x, hn::Set(d, kSlope)), curve);
}

// Noise, gain and the sRGB curve.
HWY_INLINE ByteVector digitize(FloatVector signal, const SensorRow& sensor, float gain, WordVector counter) {
  const Floats d;
  const FloatVector zero = hn::Zero(d);
  if (sensor.shot_variance > 0.0F) {
    const FloatVector light = hn::Max(signal, zero);
    const FloatVector variance = hn::MulAdd(hn::Set(d, sensor.shot_variance), light, hn::Set(d, sensor.read_variance));
    signal = hn::MulAdd(hn::Sqrt(variance), normals(counter), signal);
  }
  const FloatVector bounded = hn::Min(hn::Max(hn::Mul(signal, hn::Set(d, gain)), zero), hn::Set(d, 1.0F));
  return hn::DemoteTo(Bytes(), hn::NearestInt(tone(bounded)));
}

template <int kRadius>
HWY_INLINE void expose_pixels(const LightRows& rows, const SensorRow& sensor, int begin, int end, std::uint32_t key,
                              float* scratch, std::uint8_t* bgr) {
  const Floats d;
  const Words words;
  const Bytes bytes;
  const float* taps = sensor.taps.data();
  const int lanes = static_cast<int>(hn::Lanes(d));
  const float* planes[3];
  for (int channel = 0; channel < 3; ++channel) {
    planes[channel] = rows[channel][kRadius];
    if (kRadius == 0) continue;
    float* down = scratch + channel * sensor.row_floats;
    for (int i = begin; i < end + 2 * kRadius; i += lanes) {
      hn::StoreU(blurred_down<kRadius>(rows[channel].data() + kRadius, taps, i), d, down + i);
    }
    planes[channel] = down;
  }
  for (int u = begin; u < end; u += lanes) {
    ByteVector values[3] = {hn::Zero(bytes), hn::Zero(bytes), hn::Zero(bytes)};
    for (int channel = 0; channel < 3; ++channel) {
      const FloatVector signal = blurred_along<kRadius>(planes[channel] + kRadius + u, taps);
      const auto first = key + static_cast<std::uint32_t>(channel * kChannelStride + u);
      values[channel] = digitize(signal, sensor, sensor.gains[channel], hn::Iota(words, first));
    }
    if (u + lanes <= end) {
      hn::StoreInterleaved3(values[2], values[1], values[0], bytes, bgr + 3 * u);
    } else {
      std::uint8_t last[3 * kMostLanes];
      hn::StoreInterleaved3(values[2], values[1], values[0], bytes, last);
      std::memcpy(bgr + 3 * u, last, std::size_t{3} * static_cast<std::size_t>(end - u));
    }
  }
}

void expose_pixels_of_row(const LightRows& rows, const SensorRow& sensor, int begin, int end, std::uint32_t key,
                          float* scratch, std::uint8_t* bgr) {
  static_assert(kMostRadius == 3);
  switch (sensor.radius()) {
    case 0:
      return expose_pixels<0>(rows, sensor, begin, end, key, scratch, bgr);
    case 1:
      return expose_pixels<1>(rows, sensor, begin, end, key, scratch, bgr);
    case 2:
      return expose_pixels<2>(rows, sensor, begin, end, key, scratch, bgr);
    default:
      return expose_pixels<3>(rows, sensor, begin, end, key, scratch, bgr);
  }
}

}  // namespace movis::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace movis::sim {

HWY_EXPORT(expose_pixels_of_row);

void expose(const LightRows& rows, const SensorRow& sensor, int begin, int end, std::uint32_t noise_key, float* scratch,
            std::uint8_t* bgr) {
  HWY_DYNAMIC_DISPATCH(expose_pixels_of_row)(rows, sensor, begin, end, noise_key, scratch, bgr);
}

}  // namespace movis::sim
#endif
