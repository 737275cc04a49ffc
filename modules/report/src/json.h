#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>

#include "movis/core/field.h"
#include "movis/report/picture.h"

// What the JSON of every page is made of: values rounded to what a screen can show, and null where they are not finite.
namespace movis::report {

using Json = nlohmann::json;

inline constexpr int kMetreDigits = 5;
inline constexpr int kDegreeDigits = 4;
inline constexpr int kPixelDigits = 1;

Json number(double value, int digits);

inline Json degree(double angle_deg) {
  return number(angle_deg, kDegreeDigits);
}

template <int N>
Json vector(const Eigen::Matrix<double, N, 1>& value, int digits) {
  if (!value.allFinite()) return nullptr;
  Json json = Json::array();
  for (const double v : value) json.push_back(number(v, digits));
  return json;
}

// The picture as a data URL with its size; null where there is none. An Error that names the camera where it is neither
// PNG nor JPEG, or has no size.
Json picture_json(const EncodedImage& image, const std::string& camera);

Json field_json(const Field& field);

// JSON that may stand inside an HTML <script>. Bytes that are not UTF-8 are replaced.
std::string script_text(const Json& json);

}  // namespace movis::report
