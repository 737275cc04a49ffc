#pragma once

#include <string>

#include "movis/report/track_page.h"

namespace movis::report {

// One frame as JSON that may stand inside an HTML <script>, with everything that the page only has to format and
// draw: errors, standard deviations, the ball in the field. Numbers that are not finite become null.
std::string to_json(const TrackFrame& frame);

}  // namespace movis::report
