#pragma once

#include <vector>

#include "movis/core/pose.h"
#include "movis/localization/line_match.h"

// The parts of line_match.h: minimization of the error, and what is told of its minimum.
namespace movis::localization {

using LineSample = LineMatchScratch::Point;

// The minimum of E near `start` for a given s (metres) and f.
Pose2 descend(const std::vector<LineSample>& points, const LineMap& map, const Pose2& start, double s, double f);

// f at a pose, at least 1. `sizes` is scratch.
double excess_spread(const std::vector<LineSample>& points, const LineMap& map, const Pose2& pose,
                     std::vector<double>& sizes);

// From s = 0.25 m to s = 0.
Pose2 settle(const std::vector<LineSample>& points, const LineMap& map, const Pose2& start, std::vector<double>& sizes);

// False where the points leave a direction of the pose free.
bool line_covariance(const std::vector<LineSample>& points, const LineMap& map, const Pose2& pose, double f,
                     Eigen::Matrix3d& covariance);

}  // namespace movis::localization
