#pragma once

#include "movis/core/status.h"
#include "movis/core/yaml.h"
#include "movis/localization/instant.h"

namespace movis::localization {

struct NlsOptions {
};

NlsOptions read_nls_options(const YamlMap& map);

// Robust least squares on the goals' edges and the line points, from no guess.
Fix nls(const Instant& instant, const FieldMap& map, const NlsOptions& options);

// The same from a guess of the pose.
Fix nls_from(const Pose2& guess, const Instant& instant, const FieldMap& map, const NlsOptions& options);

}  // namespace movis::localization
