#pragma once

#include <memory>
#include <vector>

#include "movis/core/bearing.h"
#include "movis/core/random.h"
#include "movis/experiments/measurement.h"

namespace movis::experiments {

// The cameras of a true rig, and rigs that are believed of them.
class Eyes {
 public:
  virtual ~Eyes() = default;

  // Adds a believed rig; returns its number.
  virtual int believe(const omni::Rig& rig) = 0;

  // Looks at a ball on the floor. The same noise seed gives the same noise in cameras of the same number.
  virtual void look_at(const Eigen::Vector2d& ball, std::uint64_t noise_seed) = 0;

  // What a believed rig makes of it, appended: bearings of the ball.
  virtual void bearings(int believed, std::vector<Bearing>& bearings) = 0;
};

std::unique_ptr<Eyes> make_bearing_eyes(const MeasurementSettings& settings, const omni::Rig& truth);
std::unique_ptr<Eyes> make_image_eyes(const omni::Rig& truth, const control::RobotModel& robot, const sim::Look& look,
                                      const scan::Colours& colours);

}  // namespace movis::experiments
