#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "movis/core/yaml.h"
#include "movis/omni/deviation.h"

// What the files of all experiments are read with.
namespace movis::experiments {

// FNV-1a, 64 bits (G. Fowler, L. C. Noll, K.-P. Vo), of what settings were read from.
class Digest {
 public:
  void add(const std::string& bytes);
  void add_file(const std::filesystem::path& file);
  std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

// The file that a key names, relative to the experiment's; it is added to the digest. An Error where there is none.
std::filesystem::path named_file(const YamlMap& map, const char* key, Digest& digest);

// The keys of the map `differences` that are there, into one sigma of cameras' individual differences.
void read_differences(const YamlMap& map, omni::Deviation& sigma);

inline constexpr Range kDraws{0, 10000};

}  // namespace movis::experiments
