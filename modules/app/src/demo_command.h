#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "movis/localization/localizer.h"

namespace movis::app {

struct DemoArguments {
  std::filesystem::path out = "movis-demo.html";
  std::optional<std::filesystem::path> rows;
  std::optional<std::filesystem::path> scenario;
  std::vector<std::string> controllers = {"fuzzy", "pbvs"};
  std::string localizer{localization::kDefaultLocalizer};
  int episodes = 6;
  std::int64_t seed = 1;  // of the first episode; the others count on from it
};

// `movis demo`: plays episodes of approach-and-shoot on rendered images, every controller from the same starts, and
// writes one self-contained HTML page about them. Throws an Error, and then leaves no file behind.
void demo(const DemoArguments& arguments);

}  // namespace movis::app
