#include "movis/triangulation/bound_map.h"

#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

constexpr int kMostSteps = 500;  // from the middle to the border: a million cells

void check(const BoundMapOptions& options) {
  if (!(options.half_width > 0.0) || !std::isfinite(options.half_width)) {
    throw Error("the map's half width is {} m; give one above 0", options.half_width);
  }
  if (!(options.step > 0.0) || options.step > options.half_width) {
    throw Error("the map's step is {} m; give one above 0 and at most the half width, {} m", options.step,
                options.half_width);
  }
  if (options.half_width / options.step > kMostSteps) {
    throw Error("a step of {} m cuts {} m into more than {} pieces; give a coarser one", options.step,
                options.half_width, kMostSteps);
  }
  if (!(options.height >= 0.0) || !std::isfinite(options.height)) {
    throw Error("the height of the ball's centre is {} m; give one of 0 or more", options.height);
  }
  if (!(options.floor_sigma >= 0.0)) {
    throw Error("the floor's sigma is {} m; give one of 0 or more", options.floor_sigma);
  }
}

BoundCell::Sigma sigma_at(const omni::Rig& rig, const Eigen::Vector3d& point, const std::vector<Bearing>& bearings,
                          double ball_radius, double floor_sigma) {
  BoundCell::Sigma result;
  if (bearings.empty()) return result;
  result.status = BoundStatus::unobservable;
  if (point.head<2>().norm() < 1e-9) return result;
  const Eigen::Matrix3d bound = position_bound(rig, point, bearings, ball_radius, floor_sigma);
  if (!bound.allFinite()) return result;
  return {BoundStatus::ok, floor_sigma_of(bound, point)};
}

}  // namespace

const char* word(BoundStatus status) {
  switch (status) {
    case BoundStatus::ok:
      return "ok";
    case BoundStatus::not_seen:
      return "not_seen";
    case BoundStatus::unobservable:
      return "unobservable";
  }
  return "?";
}

BoundCell bound_at(const omni::Rig& rig, const Eigen::Vector2d& place, const BoundMapOptions& options) {
  const Eigen::Vector3d point(place.x(), place.y(), options.height);
  std::vector<Bearing> bearings;
  for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
    const Eigen::Matrix3d bound = bearing_bound(rig.cameras[camera], point, options.ball_radius, options.picture);
    if (!bound.allFinite()) continue;
    Bearing bearing;
    bearing.camera = camera;
    bearing.covariance = bound.topLeftCorner<2, 2>();
    if (options.diameter) {
      bearing.radius_variance = bound(2, 2);
      bearing.radius_covariance = bound.block<2, 1>(0, 2);
    }
    bearings.push_back(bearing);
  }
  BoundCell cell;
  cell.place = place;
  cell.cameras = static_cast<int>(bearings.size());
  cell.floor = sigma_at(rig, point, bearings, options.ball_radius, options.floor_sigma);
  cell.free = sigma_at(rig, point, bearings, options.ball_radius, -1.0);
  return cell;
}

int bound_map_rows(const BoundMapOptions& options) {
  check(options);
  constexpr double kRounding = 1e-9;
  return 2 * static_cast<int>(options.half_width / options.step + kRounding) + 1;
}

std::vector<BoundCell> bound_map(const omni::Rig& rig, const BoundMapOptions& options,
                                 const std::function<void()>& after_each_row) {
  const int rows = bound_map_rows(options);
  const int steps = rows / 2;
  std::vector<BoundCell> cells;
  cells.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(rows));
  for (int j = -steps; j <= steps; ++j) {
    for (int i = -steps; i <= steps; ++i) cells.push_back(bound_at(rig, {i * options.step, j * options.step}, options));
    if (after_each_row) after_each_row();
  }
  return cells;
}

std::vector<BoundCell> bound_ring(const omni::Rig& rig, double distance, int directions,
                                  const BoundMapOptions& options) {
  std::vector<BoundCell> cells;
  cells.reserve(static_cast<std::size_t>(directions));
  for (int i = 0; i < directions; ++i) {
    const double azimuth = 2.0 * kPi * (i + 0.5) / directions;
    cells.push_back(bound_at(rig, distance * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)), options));
  }
  return cells;
}

}  // namespace movis::triangulation
