#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "support/shared_data.h"

// Real middle-size robots' white-line pixels with their teams' calibration, outside the project.
namespace movis::test {

inline std::filesystem::path nubot_folder(int robot) {
  return shared_data() / "real" / "nubot-msl-lines" / ("robot" + std::to_string(robot));
}

// A robot's mirror_calib.xml as a rig.yaml. The height, which it does not tell, only takes part in the rays' steepness.
inline std::string nubot_rig(int robot) {
  std::ifstream stream(nubot_folder(robot) / "mirror_calib.xml");
  const std::string xml{std::istreambuf_iterator<char>(stream), {}};
  const auto number = [&](const std::string& tag) {
    const auto at = xml.find("<" + tag + ">");
    if (at == std::string::npos) throw std::runtime_error("no " + tag + " in mirror_calib.xml");
    return std::stod(xml.substr(at + tag.size() + 2));
  };
  return fmt::format(
      "cameras:\n- name: omni\n  position: [0, 0, 0.8]\n  yaw_deg: 0\n  tilt_deg: [0, 0]\n"
      "  image: {{width: 640, height: 480}}\n  model: radial\n"
      "  radial: {{a: {}, b: {}, u0: {}, v0: {}, max_radius_px: {}}}\n",
      number("para_a"), number("para_b"), number("center_coloum"), number("center_row"), number("max_radius"));
}

}  // namespace movis::test
