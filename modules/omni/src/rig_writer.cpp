#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "movis/core/angle.h"
#include "movis/core/output_file.h"
#include "movis/omni/rig.h"

namespace movis::omni {
namespace {

namespace fs = std::filesystem;

// A name that YAML reads as what it is; anything uncommon is quoted.
std::string quoted(const std::string& text) {
  const auto plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.' || c == '/';
  };
  const bool starts_plainly = !text.empty() && text.front() != '-' && text.front() != '.';
  if (starts_plainly && std::all_of(text.begin(), text.end(), plain) && text != "null" && text != "Null" &&
      text != "NULL") {
    return text;
  }
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + "\"";
}

// Of the numbers of degrees that are read as this angle to the last bit the shortest; the nearest where there is none.
std::string in_degrees(double angle) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double candidate = degrees(angle);
  std::string best;
  for (int i = 0; i < 3; ++i) candidate = std::nextafter(candidate, -kInfinity);
  for (int i = 0; i < 7; ++i, candidate = std::nextafter(candidate, kInfinity)) {
    if (radians(candidate) != angle) continue;
    const std::string text = fmt::format("{}", candidate + 0.0);  // no −0
    if (best.empty() || text.size() < best.size()) best = text;
  }
  return best.empty() ? fmt::format("{}", degrees(angle)) : best;
}

std::string text(const Hyperboloid& model, double /*height*/) {
  return fmt::format(
      "  hyperboloid: {{a: {}, b: {}, rim_radius: {}}}\n"
      "  pinhole: {{fu: {}, fv: {}, u0: {}, v0: {}}}\n",
      model.a, model.b, model.rim_radius, model.fu, model.fv, model.u0, model.v0);
}

std::string text(const UnifiedSphere& model, double /*height*/) {
  return fmt::format(
      "  unified: {{xi: {}, fu: {}, fv: {}, u0: {}, v0: {},\n"
      "            k1: {}, k2: {}, p1: {}, p2: {}, skew: {}, max_elevation_deg: {}}}\n",
      model.xi, model.fu, model.fv, model.u0, model.v0, model.k1, model.k2, model.p1, model.p2, model.skew,
      in_degrees(model.max_elevation));
}

std::string text(const Radial& model, double height) {
  const std::string limit =
      std::isfinite(model.max_radius_px) ? fmt::format(", max_radius_px: {}", model.max_radius_px) : "";
  // For the camera's own height: what belongs to the mirror is a over the height it was measured at.
  return fmt::format("  radial: {{a: {}, b: {}, u0: {}, v0: {}{}}}\n", model.a * (height / model.height), model.b,
                     model.u0, model.v0, limit);
}

std::string mask_text(const fs::path& mask, const fs::path& rig_file) {
  const fs::path folder = fs::absolute(rig_file).lexically_normal().parent_path();
  const fs::path whole = fs::absolute(mask).lexically_normal();
  const fs::path relative = whole.lexically_relative(folder);
  const bool below = !relative.empty() && *relative.begin() != "..";
  return quoted((below ? relative : whole).string());
}

std::string text(const Camera& camera, const fs::path& file) {
  std::string result = fmt::format("- name: {}\n  position: [{}, {}, {}]\n  yaw_deg: {}\n  tilt_deg: [{}, {}]\n",
                                   quoted(camera.name), camera.position.x(), camera.position.y(), camera.position.z(),
                                   in_degrees(camera.yaw), in_degrees(camera.tilt_x), in_degrees(camera.tilt_y));
  result += fmt::format("  image: {{width: {}, height: {}{}}}\n", camera.width, camera.height,
                        camera.format ? fmt::format(", format: {}", name(*camera.format)) : "");
  result += fmt::format("  model: {}\n", name(camera.model));
  result += std::visit([&](const auto& model) { return text(model, camera.position.z()); }, camera.model);
  if (!camera.mask.empty()) result += fmt::format("  mask: {}\n", mask_text(camera.mask, file));
  return result;
}

}  // namespace

void write_rig(const Rig& rig, const fs::path& file, const std::vector<std::string>& comments) {
  OutputFile output(file);
  for (const std::string& line : comments) output.stream() << (line.empty() ? "#" : "# " + line) << '\n';
  output.stream() << "cameras:\n";
  for (const Camera& camera : rig.cameras) output.stream() << text(camera, file);
  output.commit();
}

}  // namespace movis::omni
