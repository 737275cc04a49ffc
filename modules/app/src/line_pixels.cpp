#include "line_pixels.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <string_view>

#include "movis/core/error.h"

namespace movis::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBlank = " \t\r";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // some editors begin a UTF-8 file with it

std::string_view next_word(std::string_view& text) {
  const auto first = std::min(text.find_first_not_of(kBlank), text.size());
  text.remove_prefix(first);
  const auto length = std::min(text.find_first_of(kBlank), text.size());
  const std::string_view found = text.substr(0, length);
  text.remove_prefix(length);
  return found;
}

std::optional<double> number(std::string_view word) {
  double value = 0.0;
  const auto [stopped, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || stopped != word.data() + word.size()) return std::nullopt;
  return value;
}

// Written so that what is no number is outside.
bool inside(const omni::Camera& camera, const Eigen::Vector2d& pixel) {
  return pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() <= camera.width - 0.5 && pixel.y() <= camera.height - 0.5;
}

}  // namespace

int choose_camera(const omni::Rig& rig, const std::optional<std::string>& name, const fs::path& rig_file) {
  std::string names;
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    if (name && rig.cameras[i].name == *name) return static_cast<int>(i);
    names += (i > 0 ? ", " : "") + rig.cameras[i].name;
  }
  if (name) throw Error("{}: has no camera '{}'; there is {}", rig_file.string(), *name, names);
  if (rig.cameras.size() > 1)
    throw Error("{}: has several cameras; say by --camera which one saw the pixels: {}", rig_file.string(), names);
  return 0;
}

std::vector<Eigen::Vector2d> read_line_pixels(const fs::path& file, const omni::Camera& camera) {
  std::ifstream stream(file);
  if (!stream) throw Error("{}: cannot be opened; check that it exists and may be read", file.string());
  std::vector<Eigen::Vector2d> pixels;
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (line == 1 && text.rfind(kByteOrderMark, 0) == 0) text.erase(0, kByteOrderMark.size());
    std::string_view rest = std::string_view(text).substr(0, text.find('#'));
    const std::string_view column = next_word(rest);
    const std::string_view row = next_word(rest);
    if (column.empty()) continue;
    const auto u = number(column);
    const auto v = number(row);
    if (!u || !v || !next_word(rest).empty()) {
      throw Error("{}:{}: '{}' is not a pixel; expected two numbers, column and row", file.string(), line, text);
    }
    pixels.emplace_back(*u, *v);
    if (!inside(camera, pixels.back())) {
      throw Error("{}:{}: pixel {} {} lies outside the {} × {} image of camera {}; is it another camera's?",
                  file.string(), line, *u, *v, camera.width, camera.height, camera.name);
    }
  }
  if (stream.bad()) throw Error("{}: cannot be read to its end", file.string());
  if (pixels.empty()) throw Error("{}: has no pixels; expected `column row` a line", file.string());
  return pixels;
}

}  // namespace movis::app
