#include "template.h"

#include <string>

#include "movis/core/output_file.h"
#include "page_files.h"

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

struct Page {
  PageText text;
  const std::function<void(std::ostream&)>& write_data;
  std::ostream& out;
};

bool is_template(std::string_view name) {
  constexpr std::string_view kExtension = ".html";
  return name.size() > kExtension.size() && name.substr(name.size() - kExtension.size()) == kExtension;
}

void fill(std::string_view rest, const Page& page);

void write_part(std::string_view name, const Page& page) {
  if (name == "title") {
    page.out << escape_html(page.text.title);
  } else if (name == "version") {
    page.out << escape_html(page.text.version);
  } else if (name == "command") {
    page.out << escape_html(page.text.command);
  } else if (name == "data") {
    page.write_data(page.out);
  } else if (is_template(name)) {
    fill(page_file(name), page);
  } else {
    page.out << page_file(name);
  }
}

void fill(std::string_view rest, const Page& page) {
  for (auto open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const auto close = rest.find("}}", open);
    page.out << rest.substr(0, open);
    write_part(rest.substr(open + 2, close - open - 2), page);
    rest = rest.substr(close + 2);
  }
  page.out << rest;
}

}  // namespace

void write_page(std::string_view template_name, const PageText& text,
                const std::function<void(std::ostream&)>& write_data, const std::filesystem::path& file) {
  OutputFile output(file);
  fill(page_file(template_name), {text, write_data, output.stream()});
  output.commit();
}

}  // namespace movis::report
