#pragma once

#include <Eigen/Core>
#include <vector>

#include "movis/triangulation/correction.h"

namespace movis::calibration {

// One point at which one of the two functions of a camera's correction is known.
struct SmoothSample {
  triangulation::CorrectionBasis basis = triangulation::CorrectionBasis::Zero();
  double value = 0.0;     // radians
  double variance = 0.0;  // rad²
  int fold = 0;           // of the cross-validation
};

// value = Σ c_i basis_i over the first `order` terms, by weighted least squares with a prior around zero: about 6° for
// what the first-order effects need (far above what a camera can be off by), 0.3° for terms beyond the first `free`,
// which stand for products of such effects. It matters where the samples leave a term undetermined. `sigma` is added to
// every sample's own standard deviation, in squares.
Eigen::VectorXd fit_smooth(const std::vector<SmoothSample>& samples, int order, int free, double sigma);

// The covariance of those coefficients.
Eigen::MatrixXd smooth_covariance(const std::vector<SmoothSample>& samples, int order, int free, double sigma);

double predict(const SmoothSample& sample, const Eigen::VectorXd& coefficients);

// By what the coefficients' errors put the function off: root mean square over the samples.
double prediction_sigma(const std::vector<SmoothSample>& samples, int order, int free, double sigma);

// What of each sample a fit to the other folds leaves, radians.
std::vector<double> cross_validate(const std::vector<SmoothSample>& samples, int order, int free, double sigma);

struct SmoothFit {
  Eigen::VectorXd coefficients;
  std::vector<double> left;  // of each sample, cross-validated
  double sigma = 0.0;        // of what the function leaves beyond what the samples' variances say
};

// The smallest of the nested orders whose cross-validated error is within one standard error of the best order's
// (Hastie, Tibshirani, Friedman, The Elements of Statistical Learning, §7.10). The standard error is that of the
// difference of the two, sample by sample: both have the same noise. An order is not tried with less than two samples a
// coefficient. Samples are weighted by their variances and by what the function leaves beyond them, which comes out of
// the fit: it is repeated until they agree, from `sigma`.
SmoothFit fit_smooth_order(const std::vector<SmoothSample>& samples, const std::vector<int>& orders, int free,
                           double sigma);

// The standard deviation s for which Σ left²/(variance + s²) is the number of samples; 0 where the variances alone
// explain it (J. Mandel, R. C. Paule, Analytical Chemistry 42, 1970).
double excess_sigma(const std::vector<double>& left, const std::vector<SmoothSample>& samples);

}  // namespace movis::calibration
