#include "movis/report/track_page.h"

#include <ostream>

#include "template.h"
#include "track_json.h"

namespace movis::report {

void write_track_page(const TrackPage& page, const std::filesystem::path& file) {
  const auto write_frames = [&page](std::ostream& out) {
    out << '[';
    for (std::size_t i = 0; i < page.frames.size(); ++i) out << (i == 0 ? "\n" : ",\n") << to_json(page.frames[i]);
    out << "\n]";
  };
  write_page("track/page.html", {page.title, page.version, page.command}, write_frames, file);
}

}  // namespace movis::report
