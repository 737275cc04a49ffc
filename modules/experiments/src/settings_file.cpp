#include "settings_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "movis/core/angle.h"

namespace movis::experiments {

namespace fs = std::filesystem;

void Digest::add(const std::string& bytes) {
  for (const char byte : bytes) value_ = (value_ ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
}

void Digest::add_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  add(std::string(std::istreambuf_iterator<char>(stream), {}));
}

std::string Digest::text() const {
  return fmt::format("{:016x}", value_);
}

fs::path named_file(const YamlMap& map, const char* key, Digest& digest) {
  fs::path file = map.file().parent_path() / map.text(key);
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) {
    map.fail(key, fmt::format("names {}, which is a folder; name a YAML file", file.string()));
  }
  if (!fs::exists(file, ignored)) {
    map.fail(key, fmt::format("names {}, which does not exist; paths are relative to the experiment's folder",
                              file.string()));
  }
  digest.add_file(file);
  return file;
}

void read_differences(const YamlMap& map, omni::Deviation& sigma) {
  map.allow({"position", "yaw_deg", "tilt_deg", "focal", "principal_point_px"});
  const auto read = [&](const char* key, Range range, double unit, int first, int count) {
    if (map.has(key)) sigma.segment(first, count).setConstant(unit * map.number(key, range));
  };
  read("position", {0.0, 0.05}, 1.0, 0, 3);
  read("yaw_deg", {0.0, 10.0}, radians(1.0), 3, 1);
  read("tilt_deg", {0.0, 5.0}, radians(1.0), 4, 2);
  read("focal", {0.0, 0.1}, 1.0, 6, 1);
  read("principal_point_px", {0.0, 20.0}, 1.0, 7, 2);
}

}  // namespace movis::experiments
