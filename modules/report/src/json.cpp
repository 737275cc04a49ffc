#include "json.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "movis/core/error.h"

namespace movis::report {
namespace {

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t taken = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < taken ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= taken ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

const char* media_type(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() > 8 && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G') return "image/png";
  if (bytes.size() > 4 && bytes[0] == 0xff && bytes[1] == 0xd8) return "image/jpeg";
  return nullptr;
}

Json area_json(const Field::Area& area) {
  return {{"depth", number(area.depth, kMetreDigits)}, {"width", number(area.width, kMetreDigits)}};
}

// "<" would let "</script" or "<!--" end or change the element that the JSON stands in.
std::string escape_for_script(const std::string& json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

}  // namespace

Json number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

Json picture_json(const EncodedImage& image, const std::string& camera) {
  if (image.bytes.empty()) return nullptr;
  const char* type = media_type(image.bytes);
  if (type == nullptr) throw Error("report: a picture of camera {} is neither PNG nor JPEG; encode it first", camera);
  if (image.width <= 0 || image.height <= 0) {
    throw Error("report: a picture of camera {} has the size {}×{}; set its width and height", camera, image.width,
                image.height);
  }
  return {{"src", std::string("data:") + type + ";base64," + base64(image.bytes)},
          {"width", image.width},
          {"height", image.height}};
}

Json field_json(const Field& field) {
  return {{"half_width", number(field.half_width, kMetreDigits)},
          {"half_length", number(field.half_length, kMetreDigits)},
          {"circle", number(field.circle, kMetreDigits)},
          {"line", number(field.line, kMetreDigits)},
          {"Fd", number(field.Fd, kMetreDigits)},
          {"Fw", number(field.Fw, kMetreDigits)},
          {"goal_depth", number(field.goal_depth, kMetreDigits)},
          {"goal_thickness", number(field.goal_thickness, kMetreDigits)},
          {"white_goals", field.goals == Field::Goals::white},
          {"penalty_area", area_json(field.penalty_area)},
          {"goal_area", area_json(field.goal_area)},
          {"corner_arc", number(field.corner_arc, kMetreDigits)}};
}

std::string script_text(const Json& json) {
  return escape_for_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace movis::report
