#pragma once

#include <string_view>

namespace movis::report {

// The content of a file of modules/report/page, or of D3, embedded by embed.cmake.
std::string_view page_file(std::string_view name);

}  // namespace movis::report
