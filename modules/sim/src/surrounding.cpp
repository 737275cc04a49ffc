#include "surrounding.h"

#include <algorithm>
#include <array>

#include "sensor.h"

namespace movis::sim {
namespace {

constexpr int kOffsets = 4096;

}  // namespace

Surrounding::Surrounding(const Colour& colour, const Sensor& sensor, int width) {
  const int count = kOffsets + width;
  const SensorRow row = make_sensor_row(sensor, count);
  LightRows light;
  std::array<std::vector<float>, 3> planes;
  for (int channel = 0; channel < 3; ++channel) {
    planes[channel].assign(static_cast<std::size_t>(row.row_floats), colour[channel]);
    light[channel].assign(std::size_t{2} * static_cast<std::size_t>(row.radius()) + 1, planes[channel].data());
  }
  std::vector<float> scratch(static_cast<std::size_t>(3) * row.row_floats);
  bgr_.resize(std::size_t{3} * static_cast<std::size_t>(count));
  expose(light, row, 0, count, 0, scratch.data(), bgr_.data());
}

void Surrounding::copy(std::uint32_t noise_key, int begin, int end, std::uint8_t* bgr) const {
  if (begin >= end) return;
  const std::uint8_t* row = bgr_.data() + 3 * (noise_key % kOffsets);
  std::copy(row + 3 * begin, row + 3 * end, bgr + 3 * begin);
}

}  // namespace movis::sim
