#include <algorithm>

#include "movis/core/error.h"
#include "movis/experiments/measurement.h"
#include "movis/experiments/measurement_summary.h"
#include "movis/triangulation/joint.h"
#include "movis/triangulation/pairs.h"
#include "movis/triangulation/single.h"
#include "movis/triangulation/vertical.h"
#include "systems.h"

namespace movis::experiments {
namespace {

constexpr double kNothing = 1.0;  // rad², of an angle that is to tell nothing

PointEstimate single(const omni::Rig& rig, const std::vector<Bearing>& bearings,
                     PointEstimate (*range)(const omni::Camera&, const Bearing&, const triangulation::SingleOptions&)) {
  if (bearings.empty()) return {};
  return range(rig.cameras.at(0), bearings.front(), {});
}

PointEstimate by_elevation(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return single(rig, bearings, triangulation::range_by_elevation);
}

PointEstimate by_contact(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return single(rig, bearings, triangulation::range_by_contact);
}

PointEstimate vertical(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulation::triangulate_vertical(rig, bearings, ObjectClass::ball);
}

PointEstimate pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulation::triangulate_pairs(rig, bearings, ObjectClass::ball);
}

PointEstimate joint(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  return triangulation::triangulate_joint(rig, bearings, ObjectClass::ball);
}

PointEstimate by_azimuths(const omni::Rig& rig, const std::vector<Bearing>& bearings) {
  std::vector<Bearing> azimuths = bearings;
  for (Bearing& bearing : azimuths) {
    bearing.covariance(0, 1) = bearing.covariance(1, 0) = 0.0;
    bearing.covariance(1, 1) = kNothing;
  }
  triangulation::JointOptions options;
  options.diameter = false;
  return triangulation::triangulate_joint(rig, azimuths, ObjectClass::ball, options);
}

constexpr std::array<Estimator, kSystems.size()> kEstimators{by_elevation, by_contact, vertical,    vertical,
                                                             joint,        pairs,      by_azimuths, joint};

}  // namespace

Estimator estimator_of(int system) {
  return kEstimators.at(static_cast<std::size_t>(system));
}

int system_index(const char* name) {
  const auto found = std::find_if(kSystems.begin(), kSystems.end(),
                                  [&](const MeasurementSystem& s) { return std::string(s.name) == name; });
  if (found == kSystems.end()) throw Error("there is no measuring system '{}'", name);
  return static_cast<int>(found - kSystems.begin());
}

const char* word(Level level) {
  return level == Level::bearings ? "bearings" : "images";
}

const char* word(Differences differences) {
  constexpr std::array<const char*, kDifferences.size()> kWords{"all",  "none",  "position",       "yaw",
                                                                "tilt", "focal", "principal_point"};
  return kWords.at(static_cast<std::size_t>(differences));
}

}  // namespace movis::experiments
