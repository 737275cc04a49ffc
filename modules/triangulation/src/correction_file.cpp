#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "movis/core/names.h"
#include "movis/core/output_file.h"
#include "movis/core/yaml.h"
#include "movis/triangulation/correction.h"

namespace movis::triangulation {
namespace {

constexpr const char* kBasis = "harmonics";
constexpr Range kCoefficient{-1000.0, 1000.0};  // degrees; terms may cancel, and the sum is what is limited
constexpr double kMost = radians(10.0);         // of what is corrected
constexpr Range kSigma{0.0, 10.0};
constexpr Range kElevation{-85.0, 85.0};
constexpr Range kAngle{-1e4, 1e4};
constexpr Range kPosition{-10.0, 10.0};         // metres
constexpr double kSamePosition = 1e-6;          // metres
constexpr double kSameAngle = radians(0.0001);  // files are written with fewer digits than numbers have

template <std::size_t n>
std::vector<double> read_coefficients(const YamlMap& map, const char* key, const std::array<int, n>& orders) {
  std::vector<double> coefficients = map.numbers(key, kCoefficient);
  if (std::find(orders.begin(), orders.end(), static_cast<int>(coefficients.size())) == orders.end()) {
    std::vector<std::string> sizes;
    sizes.reserve(n);
    for (const int order : orders) sizes.push_back(std::to_string(order));
    map.fail(key, fmt::format("has {} coefficients; the basis '{}' has one of: {}", coefficients.size(), kBasis,
                              joined(sizes)));
  }
  for (double& coefficient : coefficients) coefficient = radians(coefficient);
  return coefficients;
}

double sum(const std::vector<double>& coefficients, const CorrectionBasis& basis) {
  double value = 0.0;
  for (std::size_t i = 0; i < coefficients.size(); ++i) value += coefficients[i] * basis[static_cast<int>(i)];
  return value;
}

// What makes it no correction that can be read, or nothing.
std::string flaw_of(const CameraCorrection& camera) {
  constexpr int kAzimuths = 36, kElevations = 8;
  const auto within = [](double angle, Range range) {
    return degrees(angle) >= range.min && degrees(angle) <= range.max;
  };
  if (!within(camera.min_elevation, kElevation) || !within(camera.max_elevation, kElevation)) {
    return fmt::format("has elevations_deg [{:.1f}, {:.1f}], beyond ±{}", degrees(camera.min_elevation),
                       degrees(camera.max_elevation), kElevation.max);
  }
  if (!within(camera.azimuth_sigma, kSigma) || !within(camera.elevation_sigma, kSigma)) {
    return fmt::format("has a sigma above {}°", kSigma.max);
  }
  for (const auto* coefficients : {&camera.azimuth, &camera.elevation}) {
    for (const double coefficient : *coefficients) {
      if (!within(coefficient, kCoefficient)) {
        return fmt::format("has the coefficient {:.1f}°, beyond ±{}°", degrees(coefficient), kCoefficient.max);
      }
    }
  }
  double most = 0.0;
  for (int i = 0; i < kAzimuths; ++i) {
    for (int j = 0; j <= kElevations; ++j) {
      const double azimuth = 2.0 * kPi * i / kAzimuths;
      const double elevation = camera.min_elevation + (camera.max_elevation - camera.min_elevation) * j / kElevations;
      most = std::max({most, std::abs(sum(camera.azimuth, azimuth_basis(azimuth, elevation))),
                       std::abs(sum(camera.elevation, elevation_basis(azimuth, elevation)))});
    }
  }
  if (most <= kMost) return {};
  return fmt::format("corrects by up to {:.1f}°, more than {:.0f}°, which is no individual difference", degrees(most),
                     degrees(kMost));
}

CameraCorrection read_camera(const YamlMap& map) {
  map.allow({"name", "lens", "position", "yaw_deg", "tilt_deg", "elevations_deg", "azimuth_deg", "elevation_deg",
             "azimuth_sigma_deg", "elevation_sigma_deg"});
  CameraCorrection camera;
  camera.camera = map.text("name");
  camera.lens = map.text("lens");
  const std::vector<double> position = map.numbers("position", 3, kPosition);
  camera.position = {position[0], position[1], position[2]};
  camera.yaw = wrap_angle(radians(map.number("yaw_deg", kAngle)));
  const std::vector<double> tilt = map.numbers("tilt_deg", 2, kAngle);
  camera.tilt_x = radians(tilt[0]);
  camera.tilt_y = radians(tilt[1]);
  const std::vector<double> elevations = map.numbers("elevations_deg", 2, kElevation);
  if (!(elevations[0] < elevations[1])) map.fail("elevations_deg", "must be [from, to] with from < to");
  camera.min_elevation = radians(elevations[0]);
  camera.max_elevation = radians(elevations[1]);
  camera.azimuth = read_coefficients(map, "azimuth_deg", kAzimuthOrders);
  camera.elevation = read_coefficients(map, "elevation_deg", kElevationOrders);
  camera.azimuth_sigma = radians(map.number("azimuth_sigma_deg", kSigma));
  camera.elevation_sigma = radians(map.number("elevation_sigma_deg", kSigma));
  if (const std::string flaw = flaw_of(camera); !flaw.empty()) map.fail(flaw + "; fit it again");
  return camera;
}

bool stands_as(const CameraCorrection& correction, const omni::Camera& camera) {
  const auto same = [](double a, double b) { return std::abs(turn(a, b)) <= kSameAngle; };
  return (correction.position - camera.position).norm() <= kSamePosition && same(correction.yaw, camera.yaw) &&
         same(correction.tilt_x, camera.tilt_x) && same(correction.tilt_y, camera.tilt_y);
}

std::string quoted(const std::string& name) {
  std::string text;
  for (const char c : name) text += c == '\'' ? "''" : std::string(1, c);
  return "'" + text + "'";
}

// Twelve digits are a millionth of an arc second: no measurement tells more.
std::string in_degrees(double angle) {
  return fmt::format("{:.12g}", degrees(angle));
}

std::string list(const std::vector<double>& values) {  // radians, to degrees
  std::string text;
  for (const double value : values) text += fmt::format("{}{}", text.empty() ? "" : ", ", in_degrees(value));
  return text;
}

}  // namespace

Correction read_correction(const std::filesystem::path& file, const omni::Rig& rig) {
  const YamlMap map = YamlMap::read(file);
  map.allow({"basis", "cameras"});
  map.one_of("basis", {kBasis});
  std::vector<std::string> names;
  for (const omni::Camera& camera : rig.cameras) names.push_back(camera.name);
  Correction correction;
  correction.cameras.resize(rig.cameras.size());
  for (const YamlMap& entry : map.list_of_maps("cameras")) {
    CameraCorrection camera = read_camera(entry);
    const auto found = std::find(names.begin(), names.end(), camera.camera);
    if (found == names.end()) {
      entry.fail("name", fmt::format("is '{}', which is no camera of the rig{}", camera.camera,
                                     suggestion(camera.camera, names)));
    }
    const auto index = static_cast<std::size_t>(found - names.begin());
    if (!correction.cameras[index].camera.empty()) entry.fail("name", "is that of an earlier camera");
    if (!stands_as(camera, rig.cameras[index])) {
      entry.fail(
          fmt::format("was fitted to another rig, whose {} has another position, yaw or tilt; use the rig.yaml "
                      "that it was fitted with, or fit it again: movis calibrate correction",
                      camera.camera));
    }
    if (camera.lens != lens_digest(rig.cameras[index])) {
      entry.fail("lens", fmt::format("is that of another lens than {} has in the rig; use the rig.yaml that it was "
                                     "fitted with, or fit it again: movis calibrate correction",
                                     camera.camera));
    }
    correction.cameras[index] = std::move(camera);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!correction.cameras[i].camera.empty()) continue;
    map.fail("cameras", fmt::format("has no entry of the rig's camera '{}'", names[i]));
  }
  return correction;
}

void write_correction(const Correction& correction, const std::filesystem::path& file) {
  for (const CameraCorrection& camera : correction.cameras) {
    const std::string flaw = flaw_of(camera);
    if (flaw.empty()) continue;
    throw Error("{}: is not written: the correction of {} {}; look at the places and the rig", file.string(),
                camera.camera, flaw);
  }
  OutputFile output(file);
  std::ostream& stream = output.stream();
  stream << "# Error correction of the bearings of one rig. The basis stands in docs/files.md.\nbasis: " << kBasis
         << "\ncameras:\n";
  for (const CameraCorrection& camera : correction.cameras) {
    stream << fmt::format("- name: {}\n  lens: '{}'\n  position: [{}, {}, {}]\n  yaw_deg: {}\n  tilt_deg: [{}, {}]\n",
                          quoted(camera.camera), camera.lens, camera.position.x(), camera.position.y(),
                          camera.position.z(), in_degrees(camera.yaw), in_degrees(camera.tilt_x),
                          in_degrees(camera.tilt_y));
    stream << fmt::format("  elevations_deg: [{}, {}]\n", in_degrees(camera.min_elevation),
                          in_degrees(camera.max_elevation));
    stream << fmt::format("  azimuth_deg: [{}]\n  elevation_deg: [{}]\n", list(camera.azimuth), list(camera.elevation));
    stream << fmt::format("  azimuth_sigma_deg: {}\n  elevation_sigma_deg: {}\n", in_degrees(camera.azimuth_sigma),
                          in_degrees(camera.elevation_sigma));
  }
  output.commit();
}

}  // namespace movis::triangulation
