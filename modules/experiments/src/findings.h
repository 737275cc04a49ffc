#pragma once

#include <string>
#include <vector>

#include "movis/experiments/measurement_summary.h"

namespace movis::experiments {

// What the numbers say, in sentences: the order of the systems, how far each is from its bound, what makes vertical
// stereo and MOVIS differ, which individual difference costs what. Each sentence is made from the cells and rows at
// hand, and left out where they are not there.
std::vector<Finding> findings_of(const MeasurementSummary& summary, const std::vector<MeasurementRow>& rows);

}  // namespace movis::experiments
