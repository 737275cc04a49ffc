#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace movis {

// For messages about a name that is not among those known: `; did you mean 'near'?` where one is close, and what is
// known.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

std::string joined(const std::vector<std::string>& words);  // by commas

}  // namespace movis
