#pragma once

#include "movis/core/paths.h"
#include "movis/experiments/measurement.h"

namespace movis::experiments {

// The shipped experiment, as small as one likes: 8 places, 1 m and 1.4 m away.
inline MeasurementSettings small_settings() {
  MeasurementSettings settings = read_measurement(data_file("experiments/measurement.yaml"), true);
  settings.half_width = 1.0;
  settings.step = 1.0;
  settings.alone_step = 1.0;
  settings.calibration_points = 12;
  settings.bearing_draws = 2;
  settings.image_draws = 0;
  settings.alone_draws = 1;
  return settings;
}

}  // namespace movis::experiments
