#include "movis/localization/nls.h"

namespace movis::localization {

NlsOptions read_nls_options(const YamlMap& map) {
  map.allow({});
  return {};
}

Fix nls(const Instant&, const FieldMap&, const NlsOptions&) {
  return {};
}

Fix nls_from(const Pose2&, const Instant&, const FieldMap&, const NlsOptions&) {
  return {};
}

}  // namespace movis::localization
