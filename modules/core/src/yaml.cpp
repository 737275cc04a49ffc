#include "movis/core/yaml.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "movis/core/error.h"
#include "movis/core/names.h"

namespace movis {
namespace {

std::string location(const std::filesystem::path& file, const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  return mark.is_null() ? file.string() : fmt::format("{}:{}", file.string(), mark.line + 1);
}

double to_number(const YAML::Node& node, const std::string& where, Range range) {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value)) {
    throw Error("{} must be a number from {} to {}", where, range.min, range.max);
  }
  if (!(value >= range.min && value <= range.max)) {
    throw Error("{} is {}, which is out of range: it must lie from {} to {} (SI units; angles in degrees)", where,
                value, range.min, range.max);
  }
  return value;
}

}  // namespace

YamlMap::YamlMap(std::filesystem::path file, std::string path, const YAML::Node& node)
    : file_(std::move(file)), path_(std::move(path)), node_(std::make_unique<const YAML::Node>(node)) {
  if (node.IsMap()) {
    // yaml-cpp keeps the first of two equal keys: say so instead.
    std::vector<std::string> keys;
    for (const auto& entry : node) {
      keys.push_back(entry.first.Scalar());
      if (std::count(keys.begin(), keys.end(), keys.back()) > 1) {
        throw Error("{}: key '{}' stands twice", location(file_, entry.first), keys.back());
      }
    }
    return;
  }
  throw Error("{}: {} must be a map of `key: value` lines", location(file_, node),
              path_.empty() ? "the file" : "'" + path_ + "'");
}

YamlMap::~YamlMap() = default;
YamlMap::YamlMap(YamlMap&&) noexcept = default;
YamlMap& YamlMap::operator=(YamlMap&&) noexcept = default;

YamlMap YamlMap::read(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw Error("{}: is a folder; name a YAML file", file.string());
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAllFromFile(file.string());
    if (documents.size() > 1)
      throw Error("{}: holds {} YAML documents; it must be one", file.string(), documents.size());
    return {file, "", documents.empty() ? YAML::Node() : documents.front()};
  } catch (const YAML::BadFile&) {
    throw Error("{}: cannot be opened; check that it exists and may be read", file.string());
  } catch (const YAML::ParserException& error) {
    throw Error("{}:{}: is not valid YAML: {}", file.string(), error.mark.line + 1, error.msg);
  }
}

void YamlMap::allow(std::initializer_list<const char*> keys) const {
  for (const auto& entry : *node_) {
    const std::string key = entry.first.Scalar();
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    throw Error("{}: unknown key '{}'{}{}", location(file_, entry.first), key,
                path_.empty() ? "" : " in '" + path_ + "'", suggestion(key, {keys.begin(), keys.end()}));
  }
}

bool YamlMap::has(const char* key) const {
  return (*node_)[key].IsDefined();
}

std::string YamlMap::where(const char* key) const {
  const YAML::Node found = (*node_)[key];
  return fmt::format("{}: key '{}{}{}'", location(file_, found.IsDefined() ? found : *node_), path_,
                     path_.empty() ? "" : ".", key);
}

YAML::Node YamlMap::value(const char* key) const {
  const YAML::Node found = (*node_)[key];
  if (!found.IsDefined()) fail(key, "is missing");
  if (found.IsNull()) fail(key, "has no value");
  return found;
}

void YamlMap::fail(const std::string& what) const {
  throw Error("{}: {}{}", location(file_, *node_), path_.empty() ? "" : "'" + path_ + "': ", what);
}

void YamlMap::fail(const char* key, const std::string& what) const {
  throw Error("{}: {}", where(key), what);
}

double YamlMap::number(const char* key, Range range) const {
  return to_number(value(key), where(key), range);
}

int YamlMap::integer(const char* key, Range range) const {
  const double number_read = number(key, range);
  if (number_read != std::floor(number_read)) fail(key, "must be a whole number");
  return static_cast<int>(number_read);
}

std::string YamlMap::text(const char* key) const {
  const YAML::Node found = value(key);
  if (!found.IsScalar() || found.Scalar().empty()) fail(key, "must be a word or text");
  return found.Scalar();
}

std::string YamlMap::one_of(const char* key, std::initializer_list<const char*> words) const {
  std::string read = text(key);
  if (std::find(words.begin(), words.end(), read) == words.end()) {
    fail(key, fmt::format("is '{}'; it must be one of: {}", read, joined({words.begin(), words.end()})));
  }
  return read;
}

YamlMap YamlMap::map(const char* key) const {
  return {file_, path_.empty() ? key : path_ + "." + key, value(key)};
}

std::vector<YamlMap> YamlMap::list_of_maps(const char* key) const {
  const YAML::Node list = value(key);
  if (!list.IsSequence()) fail(key, "must be a list");
  std::vector<YamlMap> maps;
  for (std::size_t i = 0; i < list.size(); ++i) {
    maps.push_back(YamlMap(file_, fmt::format("{}{}{}[{}]", path_, path_.empty() ? "" : ".", key, i), list[i]));
  }
  return maps;
}

std::vector<double> YamlMap::numbers(const char* key, Range range) const {
  const YAML::Node list = value(key);
  if (!list.IsSequence()) fail(key, "must be a list of numbers");
  std::vector<double> values;
  for (const auto& item : list) values.push_back(to_number(item, where(key), range));
  return values;
}

std::vector<double> YamlMap::numbers(const char* key, std::size_t count, Range range) const {
  const YAML::Node list = value(key);
  if (!list.IsSequence() || list.size() != count) fail(key, fmt::format("must be a list of {} numbers", count));
  return numbers(key, range);
}

void YamlMap::read_number(const char* key, Range range, double& target) const {
  if (has(key)) target = number(key, range);
}

void YamlMap::read_integer(const char* key, Range range, int& target) const {
  if (has(key)) target = integer(key, range);
}

}  // namespace movis
