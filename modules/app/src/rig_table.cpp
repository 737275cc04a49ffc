#include "rig_table.h"

#include <fmt/format.h>

#include <array>

#include "movis/core/angle.h"

namespace movis::app {
namespace {

constexpr double kToMillimetres = 1e3;
constexpr double kToDegrees = degrees(1.0);
constexpr double kToPercent = 1e2;

// As people read a deviation.
struct Unit {
  const char* name;
  double factor;
  int digits;
};

constexpr std::array<Unit, omni::kDeviations> kUnits{{{"mm", kToMillimetres, 2},
                                                      {"mm", kToMillimetres, 2},
                                                      {"mm", kToMillimetres, 2},
                                                      {"°", kToDegrees, 3},
                                                      {"°", kToDegrees, 3},
                                                      {"°", kToDegrees, 3},
                                                      {"%", kToPercent, 3},
                                                      {"px", 1.0, 3},
                                                      {"px", 1.0, 3}}};

std::string cell(const calibration::RigCalibration& result, int camera, int i) {
  if (!result.determined(camera, i)) return "not determined";
  return fmt::format("{:.{}f} ± {:.{}f}", kUnits[i].factor * result.deviation[camera][i], kUnits[i].digits,
                     kUnits[i].factor * result.sigma[camera][i], kUnits[i].digits);
}

}  // namespace

std::string rig_table(const calibration::RigCalibration& result) {
  const int cameras = static_cast<int>(result.rig.cameras.size());
  std::string text = "  deviation   ";
  for (const omni::Camera& camera : result.rig.cameras) text += fmt::format("{:>18}", camera.name);
  text += "    expected\n";
  for (int i = 0; i < omni::kDeviations; ++i) {
    text += fmt::format("  {:<9}{:<3}", omni::kDeviationNames[i], kUnits[i].name);
    for (int k = 0; k < cameras; ++k) text += fmt::format("{:>18}", cell(result, k, i));
    text += fmt::format("      ± {:.{}f}\n", kUnits[i].factor * result.prior[i], kUnits[i].digits);
  }
  text += fmt::format(
      "  balls' residuals, rms: azimuth {:.3f}°, elevation {:.3f}°; they appear {:.3f} ± {:.3f}° too high\n",
      degrees(result.azimuth_rms), degrees(result.elevation_rms), degrees(result.elevation_bias),
      degrees(result.elevation_bias_sigma));
  if (result.place_rms > 0.0) text += fmt::format("  known places, off by rms: {:.1f} mm\n", 1e3 * result.place_rms);
  if (result.goals > 0) text += fmt::format("  goals' edges, rms: {:.3f}°\n", degrees(result.edge_rms));
  for (const calibration::RejectedSighting& rejected : result.rejected) {
    const std::string who = rejected.camera < 0 ? "" : ", " + result.rig.cameras[rejected.camera].name;
    text += fmt::format("  left out: frame {}{}: {}\n", rejected.frame, who, rejected.reason);
  }
  return text;
}

std::vector<std::string> rig_comments(const calibration::RigCalibration& result) {
  std::vector<std::string> lines{"Deviations from the nominal rig ± one standard deviation:"};
  for (int k = 0; k < static_cast<int>(result.rig.cameras.size()); ++k) {
    std::string line = result.rig.cameras[k].name + ":";
    for (int i = 0; i < omni::kDeviations; ++i) {
      const bool known = result.determined(k, i);
      line += fmt::format("{} {} {}{}{}", i == 0 ? "" : ",", omni::kDeviationNames[i], cell(result, k, i),
                          known ? " " : "", known ? kUnits[i].name : "");
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace movis::app
