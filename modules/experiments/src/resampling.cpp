#include "resampling.h"

#include <algorithm>

#include "movis/core/random.h"

namespace movis::experiments {
namespace {

constexpr int kResamples = 2000;
constexpr std::uint64_t kBootstrap = 1;  // seed: the same interval for the same rows

Interval middle95(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return !std::isfinite(v); }), values.end());
  if (values.empty()) return {kUnknown, kUnknown};
  std::sort(values.begin(), values.end());
  const std::size_t cut = values.size() / 40;
  return {values[cut], values[values.size() - 1 - cut]};
}

}  // namespace

Interval bootstrap(std::size_t draws, const std::function<double(const std::vector<std::size_t>& picked)>& statistic) {
  if (draws < 2) return {kUnknown, kUnknown};
  RandomStream random = make_stream(kBootstrap, 0);
  std::uniform_int_distribution<std::size_t> pick(0, draws - 1);
  std::vector<double> values;
  std::vector<std::size_t> picked(draws);
  for (int i = 0; i < kResamples; ++i) {
    for (std::size_t& draw : picked) draw = pick(random);
    values.push_back(statistic(picked));
  }
  return middle95(std::move(values));
}

Ratio ratio_of(const std::vector<std::pair<Sum, Sum>>& draws) {
  const auto ratio = [&](const std::vector<std::size_t>& picked) {
    Sum above, below;
    for (const std::size_t i : picked) {
      above.add(draws[i].first);
      below.add(draws[i].second);
    }
    return above.mean() / below.mean();
  };
  std::vector<std::size_t> all(draws.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  if (all.empty()) return {kUnknown, {kUnknown, kUnknown}};
  return {ratio(all), bootstrap(draws.size(), ratio)};
}

ErrorStatistics statistics_of(std::vector<double> magnitudes, const std::vector<Sum>& by_draw) {
  ErrorStatistics result{kUnknown, {kUnknown, kUnknown}, kUnknown, kUnknown, kUnknown, kUnknown};
  if (magnitudes.empty()) return result;
  std::sort(magnitudes.begin(), magnitudes.end());
  const std::size_t n = magnitudes.size();
  double sum = 0.0;
  double squares = 0.0;
  for (const double magnitude : magnitudes) {
    sum += magnitude;
    squares += magnitude * magnitude;
  }
  result.mean = sum / static_cast<double>(n);
  result.rms = std::sqrt(squares / static_cast<double>(n));
  result.median = n % 2 == 1 ? magnitudes[n / 2] : 0.5 * (magnitudes[n / 2 - 1] + magnitudes[n / 2]);
  result.percentile95 = magnitudes[static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(n))) - 1];
  result.largest = magnitudes.back();
  result.mean_interval = bootstrap(by_draw.size(), [&](const std::vector<std::size_t>& picked) {
    Sum resampled;
    for (const std::size_t draw : picked) resampled.add(by_draw[draw]);
    return resampled.mean();
  });
  return result;
}

}  // namespace movis::experiments
