#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "movis/triangulation/cramer_rao.h"

namespace movis::triangulation {

// The bound all over the floor: how well a rig can measure a ball at best, to design rigs with.
struct BoundMapOptions {
  Picture picture;
  double half_width = 4.0;    // metres; the floor is a square around the robot
  double step = 0.25;         // metres
  double ball_radius = 0.11;  // metres
  double height = 0.11;       // of the ball's centre above the floor, metres
  double floor_sigma = 0.0;   // of that height where it is known, metres; 0: exactly
  bool diameter = false;      // the ball's apparent size tells its distance too
};

enum class BoundStatus : std::uint8_t {
  ok,
  not_seen,      // by no camera
  unobservable,  // by too few cameras, or from places too much alike, to tell where it is
};
const char* word(BoundStatus status);

struct BoundCell {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // robot frame, metres
  int cameras = 0;                                  // that see the ball, at least in part

  struct Sigma {
    BoundStatus status = BoundStatus::not_seen;
    FloorSigma sigma;  // means nothing with a status other than ok
  };
  Sigma floor;  // the ball's height is known
  Sigma free;   // it is not
};

BoundCell bound_at(const omni::Rig& rig, const Eigen::Vector2d& place, const BoundMapOptions& options);

// Row by row, y ascending, then x: (2n + 1)² cells around the origin with n = half_width/step, rounded down. The
// robot's own place is not observable: it has no direction. An Error where the options make no sense: a step that is
// not above 0, wider than half_width or finer than a five-hundredth of it, a negative height, a radius, contrast, noise
// not above 0. `after_each_row` is called after every row: for progress, and to end the work by an exception.
std::vector<BoundCell> bound_map(const omni::Rig& rig, const BoundMapOptions& options,
                                 const std::function<void()>& after_each_row = {});

// Of that map: 2n + 1. The same Error where half width, step, height or floor_sigma make no sense.
int bound_map_rows(const BoundMapOptions& options);

// All around the robot at one distance, at the azimuths 2π (i + ½)/directions.
std::vector<BoundCell> bound_ring(const omni::Rig& rig, double distance, int directions,
                                  const BoundMapOptions& options);

}  // namespace movis::triangulation
