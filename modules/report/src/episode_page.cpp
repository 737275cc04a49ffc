#include "movis/report/episode_page.h"

#include <ostream>

#include "episode_json.h"
#include "template.h"

namespace movis::report {

void write_episode_page(const EpisodePage& page, const std::filesystem::path& file) {
  write_page(
      "episodes/page.html", {page.title, page.version, page.command},
      [&page](std::ostream& out) { write_json(page, out); }, file);
}

}  // namespace movis::report
