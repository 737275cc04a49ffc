#include <cmath>
#include <vector>

#include "sensor.h"

namespace movis::sim {
namespace {

// A Gaussian's samples from its middle outwards, without those below a thousandth of it, scaled to a whole sum of 1.
std::vector<float> gaussian_taps(double sigma) {
  constexpr double kLeast = 1e-3;
  std::vector<double> taps{1.0};
  double sum = 1.0;
  for (int k = 1; k <= kMostRadius && sigma > 0.0; ++k) {
    const double tap = std::exp(-0.5 * k * k / (sigma * sigma));
    if (tap < kLeast) break;
    taps.push_back(tap);
    sum += 2.0 * tap;
  }
  std::vector<float> scaled;
  scaled.reserve(taps.size());
  for (const double tap : taps) scaled.push_back(static_cast<float>(tap / sum));
  return scaled;
}

}  // namespace

SensorRow make_sensor_row(const Sensor& sensor, int width) {
  SensorRow row;
  row.taps = gaussian_taps(sensor.blur_px);
  row.gains = {static_cast<float>(sensor.exposure * sensor.red_gain), static_cast<float>(sensor.exposure),
               static_cast<float>(sensor.exposure * sensor.blue_gain)};
  row.width = width;
  row.row_floats = (width + 2 * row.radius() + 2 * kMostLanes - 1) / kMostLanes * kMostLanes;
  if (sensor.full_well > 0.0) {
    const double read = sensor.read_noise / sensor.full_well;
    row.read_variance = static_cast<float>(read * read);
    row.shot_variance = static_cast<float>(1.0 / sensor.full_well);
  }
  return row;
}

}  // namespace movis::sim
