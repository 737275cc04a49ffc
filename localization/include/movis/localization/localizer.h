#pragma once

#include <string_view>
#include <vector>

#include "movis/core/field.h"
#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/localization/instant.h"
#include "movis/localization/nls.h"

namespace movis::localization {

struct Options {
  NlsOptions nls;
};

// Strict: the map `nls`, optional.
Options read_options(const YamlMap& map);

// How an instant becomes a pose: method1, method2, composed or nls. All have one shape, so that comparing them is a
// table.
struct Localizer {
  Fix (*fix)(const Instant& instant, const FieldMap& map, const Options& options);
  void (*require)(const Field& field) = nullptr;  // throws an Error where the field has not what it needs
};

// What a program uses that is not told otherwise.
inline constexpr std::string_view kDefaultLocalizer = "nls";

std::vector<std::string_view> localizer_names();       // in the order of the paper, then ours
Localizer find_localizer(std::string_view name);  // throws an Error naming what there is

// A fix farther than this beyond the lines or the goals' backs is not believed, but outside_field. The margin leaves
// room for noise and for a robot that was pushed off the field; metres.
inline constexpr double kOutsideMargin = 1.0;

}  // namespace movis::localization
