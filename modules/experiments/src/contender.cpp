#include "movis/experiments/contender.h"

#include <array>
#include <filesystem>
#include <optional>

#include "movis/core/error.h"
#include "movis/core/paths.h"
#include "movis/fuzzy/hierarchy.h"
#include "movis/servo/position_based.h"

namespace movis::experiments {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<control::Controller> make_fuzzy(const fs::path& file, const control::Task& task) {
  return std::make_unique<fuzzy::Hierarchy>(file, task);
}
std::unique_ptr<control::Controller> make_pbvs(const fs::path& file, const control::Task& task) {
  return std::make_unique<servo::PositionBased>(task, servo::read_pbvs_options(file));
}

struct Kind {
  const char* name;
  const char* default_file;  // in data/
  std::unique_ptr<control::Controller> (*make)(const fs::path& file, const control::Task& task);
};
constexpr std::array<Kind, 2> kKinds = {
    {{"fuzzy", "fuzzy/approach-and-shoot/controller.yaml", make_fuzzy}, {"pbvs", "servo/pbvs.yaml", make_pbvs}}};

}  // namespace

std::vector<std::string> controller_names() {
  std::vector<std::string> names;
  names.reserve(kKinds.size());
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

std::unique_ptr<control::Controller> make_controller(const std::string& name, const control::Task& task) {
  const std::size_t colon = name.find(':');
  std::string known;
  for (const Kind& kind : kKinds) {
    if (name.substr(0, colon) == kind.name) {
      const fs::path file =
          colon == std::string::npos ? data_file(kind.default_file) : fs::path(name.substr(colon + 1));
      return kind.make(file, task);
    }
    known += (known.empty() ? "" : ", ") + std::string(kind.name) + "[:FILE]";
  }
  throw Error("there is no controller '{}'; there are: {}", name, known);
}

}  // namespace movis::experiments
