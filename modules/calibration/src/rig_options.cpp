#include "movis/calibration/rig_calibration.h"
#include "movis/core/angle.h"

namespace movis::calibration {
namespace {

constexpr Range kSigmaDeg{1e-4, 30.0};
constexpr Range kFloorDeg{0.0, 10.0};

void read_prior(const YamlMap& map, omni::Deviation& prior) {
  map.allow({"position", "yaw_deg", "tilt_deg", "focal", "principal_point_px"});
  double position = prior[0];
  double yaw_deg = degrees(prior[3]);
  double tilt_deg = degrees(prior[4]);
  double principal_point = prior[7];
  map.read_number("position", {1e-6, 1.0}, position);
  map.read_number("yaw_deg", kSigmaDeg, yaw_deg);
  map.read_number("tilt_deg", kSigmaDeg, tilt_deg);
  map.read_number("focal", {1e-6, 0.5}, prior[6]);
  map.read_number("principal_point_px", {1e-3, 1000.0}, principal_point);
  prior.head<3>().setConstant(position);
  prior[3] = radians(yaw_deg);
  prior.segment<2>(4).setConstant(radians(tilt_deg));
  prior.tail<2>().setConstant(principal_point);
}

}  // namespace

RigOptions read_rig_options(const YamlMap& map) {
  map.allow({"prior", "place_sigma", "azimuth_floor_deg", "elevation_floor_deg", "elevation_bias_deg", "edge_floor_deg",
             "edge_bias_deg", "ball_radius"});
  RigOptions options;
  if (map.has("prior")) read_prior(map.map("prior"), options.prior);
  map.read_number("place_sigma", {0.0, 0.1}, options.place_sigma);
  map.read_number("azimuth_floor_deg", kFloorDeg, options.azimuth_floor_deg);
  map.read_number("elevation_floor_deg", kFloorDeg, options.elevation_floor_deg);
  map.read_number("elevation_bias_deg", kFloorDeg, options.elevation_bias_deg);
  map.read_number("edge_floor_deg", kFloorDeg, options.edge_floor_deg);
  map.read_number("edge_bias_deg", kFloorDeg, options.edge_bias_deg);
  map.read_number("ball_radius", {0.01, 1.0}, options.ball_radius);
  return options;
}

}  // namespace movis::calibration
