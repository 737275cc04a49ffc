#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "movis/sim/look.h"

namespace movis::sim {

// The part of a surface's colour that the light brings out, see Light. Point and unit normal in the field frame.
inline float shade(const Light& light, const Eigen::Vector3f& point, const Eigen::Vector3f& normal) {
  const Eigen::Vector3f to_lamp(-point.x(), -point.y(), light.lamp_height - point.z());
  const float towards_lamp = normal.dot(to_lamp) / to_lamp.norm();
  return std::max(0.05F, light.ambient + light.sky * normal.z() + light.lamp * towards_lamp);
}

// What a glossy surface adds: the lamps hang in a ring, some 35° up, so it is brightest where a ray is mirrored to
// that elevation.
inline float glossy(const Light& light, const Eigen::Vector3f& direction, const Eigen::Vector3f& normal) {
  constexpr float kLampsSine = 0.58F;
  constexpr float kWidth = 0.37F;
  const float mirrored = direction.z() - 2.0F * direction.dot(normal) * normal.z();
  const float off = (mirrored - kLampsSine) / kWidth;
  return light.gloss * std::exp(-0.5F * off * off);
}

}  // namespace movis::sim
