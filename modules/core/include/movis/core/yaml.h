#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace YAML {  // NOLINT(readability-identifier-naming): yaml-cpp's name
class Node;
}

namespace movis {

struct Range {
  double min;
  double max;
};

// Strict reading of a YAML map. `allow` names every key that may stand in it, so that a misspelt key is an Error and
// not a silent default. Every Error names file, line and key and says what was expected.
class YamlMap {
 public:
  static YamlMap read(const std::filesystem::path& file);
  ~YamlMap();
  YamlMap(YamlMap&&) noexcept;
  YamlMap& operator=(YamlMap&&) noexcept;

  void allow(std::initializer_list<const char*> keys) const;
  bool has(const char* key) const;

  // The value must be there.
  double number(const char* key, Range range) const;
  int integer(const char* key, Range range) const;
  std::string text(const char* key) const;
  std::string one_of(const char* key, std::initializer_list<const char*> words) const;
  YamlMap map(const char* key) const;
  std::vector<YamlMap> list_of_maps(const char* key) const;
  std::vector<double> numbers(const char* key, Range range) const;
  std::vector<double> numbers(const char* key, std::size_t count, Range range) const;

  // The value replaces `target` where the key is there; this is how option structs keep the only copy of a default.
  void read_number(const char* key, Range range, double& target) const;
  void read_integer(const char* key, Range range, int& target) const;

  // An Error about this map, or about one of its keys.
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail(const char* key, const std::string& what) const;

  const std::filesystem::path& file() const { return file_; }

 private:
  YamlMap(std::filesystem::path file, std::string path, const YAML::Node& node);
  YAML::Node value(const char* key) const;
  std::string where(const char* key) const;

  std::filesystem::path file_;
  std::string path_;  // of this map in the file, e.g. cameras[2].pinhole; empty at the top
  std::unique_ptr<const YAML::Node> node_;
};

}  // namespace movis
