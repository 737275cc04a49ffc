#include "movis/localization/localizer.h"

#include "movis/core/error.h"
#include "movis/core/names.h"
#include "movis/localization/composed.h"
#include "movis/localization/method1.h"
#include "movis/localization/method2.h"

namespace movis::localization {
namespace {

Fix by_method1(const Instant& instant, const FieldMap& map, const Options& /*options*/) {
  return method1(instant.goals, map.field);
}

Fix by_method2(const Instant& instant, const FieldMap& map, const Options& /*options*/) {
  return method2(instant.goals, map.field);
}

Fix by_composition(const Instant& instant, const FieldMap& map, const Options& /*options*/) {
  return composed(instant.goals, map.field);
}

Fix by_nls(const Instant& instant, const FieldMap& map, const Options& options) {
  return nls(instant, map, options.nls);
}

void require_coloured_goals(const Field& field) {
  if (field.goals == Field::Goals::coloured) return;
  throw Error("the field's goals are white; the paper's methods need a yellow and a blue one: use the localizer nls");
}

struct Entry {
  std::string_view name;
  Localizer localizer;
};

constexpr Entry kLocalizers[] = {{"method1", {by_method1, require_coloured_goals}},
                                 {"method2", {by_method2, require_coloured_goals}},
                                 {"composed", {by_composition, require_coloured_goals}},
                                 {"nls", {by_nls}}};

}  // namespace

Options read_options(const YamlMap& map) {
  map.allow({"nls"});
  Options options;
  if (map.has("nls")) options.nls = read_nls_options(map.map("nls"));
  return options;
}

std::vector<std::string_view> localizer_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kLocalizers) names.push_back(entry.name);
  return names;
}

Localizer find_localizer(std::string_view name) {
  for (const Entry& entry : kLocalizers) {
    if (entry.name == name) return entry.localizer;
  }
  const auto known = localizer_names();
  throw Error("there is no localizer '{}'{}", name, suggestion(name, {known.begin(), known.end()}));
}

}  // namespace movis::localization
