#include "movis/localization/localizer.h"

#include "movis/localization/composed.h"
#include "movis/localization/method1.h"
#include "movis/localization/method2.h"

namespace movis::localization {
namespace {

struct Entry {
  std::string_view name;
  Localizer localizer;
};

constexpr Entry kLocalizers[] = {{"method1", method1}, {"method2", method2}, {"composed", composed}};

}  // namespace

Localizer find_localizer(std::string_view name) {
  for (const Entry& entry : kLocalizers) {
    if (entry.name == name) return entry.localizer;
  }
  return nullptr;
}

std::vector<std::string_view> localizer_names() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kLocalizers) names.push_back(entry.name);
  return names;
}

}  // namespace movis::localization
