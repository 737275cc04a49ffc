// Compiled once for every vector instruction set by Highway's foreach_target; the best that the processor has is
// chosen at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "backdrop.cpp"
#include <hwy/foreach_target.h>
// foreach_target comes first.
#include <hwy/highway.h>

#include "backdrop.h"

HWY_BEFORE_NAMESPACE();
namespace movis::sim::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Places = hn::RebindToSigned<Floats>;
using FloatVector = hn::Vec<Floats>;
using PlaceVector = hn::Vec<Places>;
using FloatMask = hn::Mask<Floats>;

HWY_INLINE FloatVector set(float value) {
  return hn::Set(Floats(), value);
}

struct Point {
  FloatVector x, y;
};

struct Cells {
  PlaceVector place;  // in the planes; 0 outside the grid
  FloatMask inside;
};

HWY_INLINE Cells cells_of(const Hall::Grid& grid, const Point& point) {
  const Floats d;
  const Places places;
  const FloatVector column = hn::Floor(hn::Mul(hn::Sub(point.x, set(grid.left)), set(grid.cells_per_metre)));
  const FloatVector row = hn::Floor(hn::Mul(hn::Sub(point.y, set(grid.bottom)), set(grid.cells_per_metre)));
  const FloatMask above = hn::And(hn::Ge(column, hn::Zero(d)), hn::Ge(row, hn::Zero(d)));
  const FloatMask below =
      hn::And(hn::Lt(column, set(static_cast<float>(grid.columns))), hn::Lt(row, set(static_cast<float>(grid.rows))));
  const FloatMask inside = hn::And(above, below);
  const PlaceVector u = hn::ConvertTo(places, hn::IfThenElseZero(inside, column));
  const PlaceVector v = hn::ConvertTo(places, hn::IfThenElseZero(inside, row));
  const PlaceVector first = hn::Set(places, grid.first);
  return {hn::Add(hn::Add(hn::Mul(v, hn::Set(places, grid.columns)), u), first), inside};
}

HWY_INLINE FloatVector upper_half(PlaceVector words) {
  const auto halves = hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<Places>(), words));
  return hn::ConvertTo(Floats(), hn::BitCast(Places(), halves));
}
HWY_INLINE FloatVector lower_half(PlaceVector words) {
  return hn::ConvertTo(Floats(), hn::And(words, hn::Set(Places(), 0xFFFF)));
}

// The part of the light that shadows leave.
HWY_INLINE FloatVector left_by(const std::vector<Shadow>& shadows, const Point& point) {
  FloatVector light = set(1.0F);
  for (const Shadow& shadow : shadows) {
    const FloatVector x = hn::Sub(point.x, set(shadow.centre.x()));
    const FloatVector y = hn::Sub(point.y, set(shadow.centre.y()));
    const FloatVector squared = hn::MulAdd(x, x, hn::Mul(y, y));
    const FloatVector off = hn::Mul(squared, set(1.0F / (shadow.reach * shadow.reach)));
    const FloatVector inside = hn::Max(hn::Sub(set(1.0F), off), hn::Zero(Floats()));
    light = hn::Mul(light, hn::NegMulAdd(hn::Mul(inside, inside), set(shadow.strength), set(1.0F)));
  }
  return light;
}

struct Rays {
  FloatVector x, y, z;  // field frame
};

// A plane's value for a ray, or the sum over the four corners of a pixel.
template <bool kBetween>
HWY_INLINE FloatVector component(const float* plane, int stride) {
  const Floats d;
  if (!kBetween) return hn::LoadU(d, plane);
  const FloatVector above = hn::Add(hn::LoadU(d, plane), hn::LoadU(d, plane + 1));
  return hn::Add(above, hn::Add(hn::LoadU(d, plane + stride), hn::LoadU(d, plane + stride + 1)));
}

template <bool kBetween>
HWY_INLINE Rays to_field(const Standpoint& standpoint, const RayPlanes& rays, int stride, int i) {
  const FloatVector x = component<kBetween>(rays.x + i, stride);
  const FloatVector y = component<kBetween>(rays.y + i, stride);
  const FloatVector cosine = set(standpoint.cosine);
  const FloatVector sine = set(standpoint.sine);
  return {hn::NegMulAdd(sine, y, hn::Mul(cosine, x)), hn::MulAdd(sine, x, hn::Mul(cosine, y)),
          component<kBetween>(rays.z + i, stride)};
}

// The light on the walls, times their colour's brightness of 1. A wall's normal points at the opposite wall, so n·l is
// the half width over the distance to the lamp.
HWY_INLINE FloatVector light_on_walls(const Hall& hall, const Standpoint& standpoint, const Rays& ray) {
  const FloatVector half = set(hall.half_width());
  const FloatVector to_x = hn::Div(hn::Sub(hn::CopySign(half, ray.x), set(standpoint.origin.x())), ray.x);
  const FloatVector to_y = hn::Div(hn::Sub(hn::CopySign(half, ray.y), set(standpoint.origin.y())), ray.y);
  const FloatVector distance = hn::Min(to_x, to_y);
  const FloatVector x = hn::MulAdd(distance, ray.x, set(standpoint.origin.x()));
  const FloatVector y = hn::MulAdd(distance, ray.y, set(standpoint.origin.y()));
  const FloatVector z = hn::MulAdd(distance, ray.z, set(standpoint.origin.z() - hall.light().lamp_height));
  const FloatVector squared = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  const FloatVector towards_lamp = hn::Div(half, hn::Sqrt(squared));
  return hn::MulAdd(set(hall.light().lamp), towards_lamp, set(hall.light().ambient));
}

template <bool kBetween>
HWY_INLINE void see(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint,
                    const RayPlanes& rays, int stride, int count, const LightPlanes& light) {
  const Floats d;
  float* const out[3] = {light.red, light.green, light.blue};
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(d))) {
    const Rays ray = to_field<kBetween>(standpoint, rays, stride, i);
    const FloatVector distance = hn::Div(set(-standpoint.origin.z()), ray.z);
    const Point point{hn::MulAdd(distance, ray.x, set(standpoint.origin.x())),
                      hn::MulAdd(distance, ray.y, set(standpoint.origin.y()))};
    const Cells around = cells_of(hall.around(), point);
    const FloatMask floor = hn::And(around.inside, hn::Lt(ray.z, hn::Zero(d)));
    FloatVector colours[3] = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
    if (!hn::AllTrue(d, floor)) {
      const FloatVector walls = light_on_walls(hall, standpoint, ray);
      for (int channel = 0; channel < 3; ++channel) {
        colours[channel] = hn::Mul(walls, set(hall.wall_colour()[channel]));
      }
    }
    if (!hn::AllFalse(d, floor)) {
      const Cells field = cells_of(hall.field(), point);
      const auto fine = hn::RebindMask(Places(), field.inside);
      const PlaceVector place = hn::IfThenElse(fine, field.place, around.place);
      const FloatVector left = left_by(shadows, point);
      const PlaceVector red_green = hn::GatherIndex(Places(), hall.red_green(), place);
      const FloatVector scale = hn::Mul(left, set(Hall::kFullLight / 65535.0F));
      const FloatVector cells[3] = {hn::Mul(scale, upper_half(red_green)), hn::Mul(scale, lower_half(red_green)),
                                    hn::Mul(left, hn::GatherIndex(d, hall.blue(), place))};
      const bool all = hn::AllTrue(d, floor);
      for (int channel = 0; channel < 3; ++channel) {
        colours[channel] = all ? cells[channel] : hn::IfThenElse(floor, cells[channel], colours[channel]);
      }
    }
    for (int channel = 0; channel < 3; ++channel) hn::StoreU(colours[channel], d, out[channel] + i);
  }
}

void see_along_rays(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint,
                    const RayPlanes& rays, int count, const LightPlanes& light) {
  see<false>(hall, shadows, standpoint, rays, 0, count, light);
}

void see_between_corners(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint,
                         const RayPlanes& corners, int stride, int count, const LightPlanes& light) {
  see<true>(hall, shadows, standpoint, corners, stride, count, light);
}

}  // namespace movis::sim::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace movis::sim {

HWY_EXPORT(see_along_rays);
HWY_EXPORT(see_between_corners);

void see_hall(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint, const RayPlanes& rays,
              int count, const LightPlanes& light) {
  HWY_DYNAMIC_DISPATCH(see_along_rays)(hall, shadows, standpoint, rays, count, light);
}

void see_hall_between(const Hall& hall, const std::vector<Shadow>& shadows, const Standpoint& standpoint,
                      const RayPlanes& corners, int stride, int count, const LightPlanes& light) {
  HWY_DYNAMIC_DISPATCH(see_between_corners)(hall, shadows, standpoint, corners, stride, count, light);
}

}  // namespace movis::sim
#endif
