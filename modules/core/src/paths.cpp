#include "movis/core/paths.h"

#include <cstdlib>
#include <string>
#include <vector>

#include "movis/core/error.h"

namespace movis {
namespace fs = std::filesystem;

fs::path data_directory() {
  if (const char* chosen = std::getenv("MOVIS_DATA"); chosen != nullptr && *chosen != '\0') {
    if (!fs::is_directory(chosen))
      throw Error("MOVIS_DATA names '{}', which is no folder: correct or unset it", chosen);
    return chosen;
  }
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const std::vector<fs::path> places{program.parent_path().parent_path() / "share/movis/data", MOVIS_INSTALL_DATA,
                                     MOVIS_SOURCE_DATA};
  std::string tried;
  for (const fs::path& place : places) {
    if (fs::is_directory(place, ignored)) return place;
    tried += "\n  " + place.string();
  }
  throw Error("the data folder of MOVIS was not found; set MOVIS_DATA to it. Looked for:{}", tried);
}

fs::path data_file(const fs::path& relative) {
  const fs::path file = data_directory() / relative;
  if (!fs::exists(file))
    throw Error("{}: not found; is MOVIS_DATA right, is the installation complete?", file.string());
  return file;
}

}  // namespace movis
