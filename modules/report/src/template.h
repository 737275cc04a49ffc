#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string_view>

namespace movis::report {

// What every page says of itself.
struct PageText {
  std::string_view title;
  std::string_view version;  // of the program
  std::string_view command;  // that made the page
};

// Writes the embedded template to `file`, with every {{part}} of it filled in: title, version and command with the
// text, escaped; data with what `write_data` writes; any other with the embedded file of that name, which is itself a
// template where it is HTML. Throws an Error where the file cannot be written; nothing is left behind where anything
// throws.
void write_page(std::string_view template_name, const PageText& text,
                const std::function<void(std::ostream&)>& write_data, const std::filesystem::path& file);

}  // namespace movis::report
