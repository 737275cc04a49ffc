#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "movis/core/line_point.h"
#include "movis/omni/rig.h"

// What the commands that take white-line pixels share.
namespace movis::app {

// The index of the camera of that name; without a name of the only one. An Error where there is none, or a choice.
int choose_camera(const omni::Rig& rig, const std::optional<std::string>& name, const std::filesystem::path& rig_file);

// Reads white-line pixels: `column row` a line, separated by blanks or tabs; what follows a # is a comment. Anything
// else (but a byte order mark at the file's begin), a pixel outside the camera's image, and a file without pixels are an Error that names file and line.
std::vector<Eigen::Vector2d> read_line_pixels(const std::filesystem::path& file, const omni::Camera& camera);

}  // namespace movis::app
