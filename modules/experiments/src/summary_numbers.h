#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "movis/experiments/statistics.h"

// How summaries write numbers, which need not be finite.
namespace movis::experiments {

using Json = nlohmann::json;

Json number(double value);                   // null where it is not finite
std::string text(double value, int digits);  // a dash where it is not finite
Json statistics_json(const ErrorStatistics& statistics, double unit);

}  // namespace movis::experiments
