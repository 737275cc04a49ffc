#pragma once

#include <ostream>

#include "movis/report/episode_page.h"

namespace movis::report {

// The page's data as JSON that may stand inside an HTML <script>. Ticks are written by column, one array for each
// quantity, with the errors of the estimates among them. Numbers that are not finite become null. Throws an Error where
// the parts of an episode do not fit together.
void write_json(const EpisodePage& page, std::ostream& out);

}  // namespace movis::report
