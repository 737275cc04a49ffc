#include "smooth_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace movis::calibration {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kFreePrior = 0.1;       // radians
constexpr double kProductPrior = 0.005;  // radians
constexpr int kSamplesACoefficient = 2;

struct NormalEquations {
  MatrixXd information;
  VectorXd moment;
};

// Without the samples of one fold; −1: with all.
NormalEquations normal_equations(const std::vector<SmoothSample>& samples, int order, int free, double sigma,
                                 int fold) {
  NormalEquations normal{MatrixXd::Zero(order, order), VectorXd::Zero(order)};
  for (int i = 0; i < order; ++i) {
    const double prior = i < free ? kFreePrior : kProductPrior;
    normal.information(i, i) = 1.0 / (prior * prior);
  }
  for (const SmoothSample& sample : samples) {
    if (sample.fold == fold) continue;
    const auto basis = sample.basis.head(order);
    const double variance = sample.variance + sigma * sigma;
    normal.information.noalias() += basis * basis.transpose() / variance;
    normal.moment += basis * (sample.value / variance);
  }
  return normal;
}

VectorXd fit_without(const std::vector<SmoothSample>& samples, int order, int free, double sigma, int fold) {
  const NormalEquations normal = normal_equations(samples, order, free, sigma, fold);
  return normal.information.ldlt().solve(normal.moment);
}

// Mean of a − b, and its standard error.
struct Difference {
  double mean = 0.0;
  double standard_error = 0.0;
};

Difference difference(const std::vector<double>& a, const std::vector<double>& b,
                      const std::vector<SmoothSample>& samples, double sigma) {
  const auto n = static_cast<double>(samples.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double d = (a[i] * a[i] - b[i] * b[i]) / (samples[i].variance + sigma * sigma);
    sum += d;
    squares += d * d;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(std::max(squares / n - mean * mean, 0.0) / (n - 1.0))};
}

}  // namespace

VectorXd fit_smooth(const std::vector<SmoothSample>& samples, int order, int free, double sigma) {
  return fit_without(samples, order, free, sigma, -1);
}

MatrixXd smooth_covariance(const std::vector<SmoothSample>& samples, int order, int free, double sigma) {
  return normal_equations(samples, order, free, sigma, -1).information.ldlt().solve(MatrixXd::Identity(order, order));
}

double predict(const SmoothSample& sample, const VectorXd& coefficients) {
  return sample.basis.head(coefficients.size()).dot(coefficients);
}

double prediction_sigma(const std::vector<SmoothSample>& samples, int order, int free, double sigma) {
  const MatrixXd covariance = smooth_covariance(samples, order, free, sigma);
  double sum = 0.0;
  for (const SmoothSample& sample : samples) sum += sample.basis.head(order).dot(covariance * sample.basis.head(order));
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

std::vector<double> cross_validate(const std::vector<SmoothSample>& samples, int order, int free, double sigma) {
  std::vector<double> left(samples.size());
  int folds = 0;
  for (const SmoothSample& sample : samples) folds = std::max(folds, sample.fold + 1);
  for (int fold = 0; fold < folds; ++fold) {
    const VectorXd coefficients = fit_without(samples, order, free, sigma, fold);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (samples[i].fold == fold) left[i] = samples[i].value - predict(samples[i], coefficients);
    }
  }
  return left;
}

double excess_sigma(const std::vector<double>& left, const std::vector<SmoothSample>& samples) {
  const auto mean_square = [&](double variance) {
    double sum = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) sum += left[i] * left[i] / (samples[i].variance + variance);
    return sum / static_cast<double>(left.size());
  };
  if (mean_square(0.0) <= 1.0) return 0.0;
  double low = 0.0, high = 0.0;
  for (const double l : left) high = std::max(high, std::abs(l));  // with it the mean square is below 1
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (mean_square(middle * middle) > 1.0 ? low : high) = middle;
  }
  return high;
}

namespace {

SmoothFit choose_order(const std::vector<SmoothSample>& samples, const std::vector<int>& orders, int free,
                       double sigma) {
  std::vector<std::vector<double>> left;
  for (const int order : orders) {
    if (!left.empty() && static_cast<int>(samples.size()) < kSamplesACoefficient * order) break;
    left.push_back(cross_validate(samples, order, free, sigma));
  }
  std::size_t best = 0;
  for (std::size_t i = 1; i < left.size(); ++i) {
    if (difference(left[i], left[best], samples, sigma).mean < 0.0) best = i;
  }
  std::size_t chosen = 0;
  for (; chosen < best; ++chosen) {
    const Difference worse = difference(left[chosen], left[best], samples, sigma);
    if (worse.mean <= worse.standard_error) break;
  }
  return {fit_smooth(samples, orders[chosen], free, sigma), left[chosen], excess_sigma(left[chosen], samples)};
}

}  // namespace

SmoothFit fit_smooth_order(const std::vector<SmoothSample>& samples, const std::vector<int>& orders, int free,
                           double sigma) {
  constexpr int kRounds = 4;
  SmoothFit fit;
  for (int round = 0; round < kRounds; ++round) {
    fit = choose_order(samples, orders, free, sigma);
    sigma = fit.sigma;
  }
  return fit;
}

}  // namespace movis::calibration
