#include "summary_numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace movis::experiments {

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

std::string text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : std::string("–");
}

Json statistics_json(const ErrorStatistics& s, double unit) {
  return {{"mean", number(unit * s.mean)},
          {"mean_low", number(unit * s.mean_interval.low)},
          {"mean_high", number(unit * s.mean_interval.high)},
          {"median", number(unit * s.median)},
          {"rms", number(unit * s.rms)},
          {"percentile95", number(unit * s.percentile95)},
          {"largest", number(unit * s.largest)}};
}

}  // namespace movis::experiments
