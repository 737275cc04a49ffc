#pragma once

#include <filesystem>

namespace movis {

// The folder with robots, rigs, fields, colours, images: the environment's MOVIS_DATA, else the one beside the
// running program's install prefix, else that of the library's prefix, else the source tree.
std::filesystem::path data_directory();

// A file or folder below data_directory(); an Error says where it was looked for when it is not there.
std::filesystem::path data_file(const std::filesystem::path& relative);

}  // namespace movis
