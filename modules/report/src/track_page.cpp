#include "movis/report/track_page.h"

#include <string_view>

#include "movis/core/error.h"
#include "movis/core/output_file.h"
#include "page_files.h"
#include "track_json.h"

namespace movis::report {
namespace {

std::string escape_html(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

void write_frames(const std::vector<TrackFrame>& frames, std::ostream& out) {
  out << '[';
  for (std::size_t i = 0; i < frames.size(); ++i) out << (i == 0 ? "\n" : ",\n") << to_json(frames[i]);
  out << "\n]";
}

// What stands in the template as {{name}}: a value of the page, or an embedded file.
void write_part(std::string_view name, const TrackPage& page, std::ostream& out) {
  if (name == "title") {
    out << escape_html(page.title);
  } else if (name == "version") {
    out << escape_html(page.version);
  } else if (name == "command") {
    out << escape_html(page.command);
  } else if (name == "frames") {
    write_frames(page.frames, out);
  } else {
    out << page_file(name);
  }
}

}  // namespace

void write_track_page(const TrackPage& page, const std::filesystem::path& file) {
  OutputFile output(file);
  std::string_view rest = page_file("page.html");
  for (auto open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const auto close = rest.find("}}", open);
    output.stream() << rest.substr(0, open);
    write_part(rest.substr(open + 2, close - open - 2), page, output.stream());
    rest = rest.substr(close + 2);
  }
  output.stream() << rest;
  output.commit();
}

}  // namespace movis::report
