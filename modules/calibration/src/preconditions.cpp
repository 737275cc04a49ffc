#include "preconditions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/median.h"
#include "planar_rays.h"

namespace movis::calibration {
namespace {

using Order = std::vector<int>;  // by column of the data: the camera whose images are taken to stand there

std::size_t moved(const Order& order) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) count += order[i] != static_cast<int>(i) ? 1 : 0;
  return count;
}

// All orders of a few cameras; of many, those with two exchanged.
std::vector<Order> orders(std::size_t cameras) {
  constexpr std::size_t kFew = 5;
  Order order(cameras);
  std::iota(order.begin(), order.end(), 0);
  std::vector<Order> result;
  if (cameras <= kFew) {
    do result.push_back(order);
    while (std::next_permutation(order.begin(), order.end()));
  } else {
    result.push_back(order);
    for (std::size_t i = 0; i < cameras; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        result.push_back(order);
        std::swap(result.back()[i], result.back()[j]);
      }
    }
  }
  std::stable_sort(result.begin(), result.end(), [](const Order& a, const Order& b) { return moved(a) < moved(b); });
  return result;
}

// `misfit` of an order is a typical error in azimuth, radians. Without known places a symmetric rig looks alike in
// several orders: `example` says that one of them is named.
void check_order(const Drawing& drawing, const omni::Rig& believed, bool example,
                 const std::function<double(const Order&)>& misfit) {
  constexpr double kFits = radians(6.0);  // individual differences leave a degree or two
  constexpr double kFarBetter = 0.3;
  constexpr double kHardlyBetter = 0.8;  // of orders that fit alike, that which moves least is named
  const std::vector<Order> all = orders(drawing.cameras.size());
  const double as_listed = misfit(all.front());
  const Order* best = &all.front();
  double least = as_listed;
  for (const Order& order : all) {
    const double error = misfit(order);
    if (error < (best == &all.front() ? kFarBetter : kHardlyBetter) * least) {
      best = &order;
      least = error;
    }
  }
  if (best == &all.front() || least > kFits) return;
  std::string pairs;
  for (std::size_t i = 0; i < best->size(); ++i) {
    if ((*best)[i] == static_cast<int>(i)) continue;
    pairs += fmt::format("{}those listed as {} look like {}'s", pairs.empty() ? "" : ", ", believed.cameras[i].name,
                         believed.cameras[(*best)[i]].name);
  }
  throw Error(
      "the images are those of the cameras in another order: {}{} (azimuths then fit to {:.1f}° instead of {:.1f}°); "
      "check the columns of frames.csv",
      example ? "for example, " : "", pairs, degrees(least), degrees(as_listed));
}

// The azimuth of a bearing, had its image come from the camera `k`.
std::optional<double> azimuth_through(const Drawing& drawing, const Bearing& bearing, int k) {
  const auto pixel = pixel_of(drawing.believed[bearing.camera], {bearing.azimuth, bearing.elevation});
  if (!pixel) return std::nullopt;
  const auto direction = direction_of(drawing.cameras[k], *pixel);
  if (!direction) return std::nullopt;
  return direction->azimuth;
}

}  // namespace

void check_rigs(const omni::Rig& nominal, const Sightings& sightings, const RigOptions& options) {
  const std::size_t cameras = nominal.cameras.size();
  if (cameras == 0) throw Error("a rig without cameras cannot be calibrated");
  if (sightings.rig.cameras.size() != cameras) {
    throw Error("sightings of {} cameras came to a rig of {}", sightings.rig.cameras.size(), cameras);
  }
  for (const Sighting& sighting : sightings.frames) {
    for (const Bearing& bearing : sighting.bearings) {
      if (bearing.camera >= 0 && bearing.camera < static_cast<int>(cameras)) continue;
      throw Error("frame {} has a bearing of camera {}; the rig has {}", sighting.frame, bearing.camera, cameras);
    }
  }
  if (!(options.prior.minCoeff() > 0.0)) throw Error("every sigma of a calibration's prior must be larger than 0");
}

void check_directions(std::vector<double> azimuths, const char* what) {
  constexpr double kNarrow = radians(60.0);
  std::sort(azimuths.begin(), azimuths.end());
  double gap = azimuths.front() + 2.0 * kPi - azimuths.back();
  for (std::size_t i = 1; i < azimuths.size(); ++i) gap = std::max(gap, azimuths[i] - azimuths[i - 1]);
  const double sector = 2.0 * kPi - gap;
  if (sector > kNarrow) return;
  throw Error(
      "all {} lie in one direction, within {:.0f}° around the robot: a calibration would hold there alone; spread them "
      "all around it",
      what, degrees(sector));
}

void check_camera_order_by_places(const Drawing& drawing, const Sightings& sightings) {
  check_order(drawing, sightings.rig, false, [&](const Order& order) {
    std::vector<double> errors;
    for (const Sighting& sighting : sightings.frames) {
      if (!sighting.ball_in_robot) continue;
      for (const Bearing& bearing : sighting.bearings) {
        if (!useful_ball(bearing)) continue;
        const int k = order[bearing.camera];
        const auto azimuth = azimuth_through(drawing, bearing, k);
        if (!azimuth) continue;
        const Direction place = direction_of(*sighting.ball_in_robot - drawing.cameras[k].position);
        errors.push_back(std::abs(turn(place.azimuth, *azimuth)));
      }
    }
    return errors.empty() ? kPi : median(errors);
  });
}

void check_camera_order_by_balls(const Drawing& drawing, const Sightings& sightings) {
  check_order(drawing, sightings.rig, true, [&](const Order& order) {
    std::vector<double> errors;
    for (const Sighting& sighting : sightings.frames) {
      std::vector<PlanarRay> rays;
      for (const Bearing& bearing : sighting.bearings) {
        if (!useful_ball(bearing)) continue;
        const int k = order[bearing.camera];
        const auto azimuth = azimuth_through(drawing, bearing, k);
        if (azimuth) rays.push_back({drawing.cameras[k].position.head<2>(), *azimuth});
      }
      if (rays.size() >= 3) errors.push_back(largest_error(rays));
    }
    return errors.empty() ? kPi : median(errors);
  });
}

}  // namespace movis::calibration
