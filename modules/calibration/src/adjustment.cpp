#include "adjustment.h"

#include <ceres/ceres.h>
#include <ceres/normal_prior.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "movis/core/error.h"
#include "movis/core/median.h"

namespace movis::calibration {
namespace {

// Central differences with a step that suits unknowns of order 1: Ceres's own would vanish at their start, zero.
class TermCost final : public ceres::CostFunction {
 public:
  TermCost(const Term& term, const std::vector<Unknown>& unknowns) : term_(term) {
    set_num_residuals(term.size);
    for (const int i : term.unknowns)
      mutable_parameter_block_sizes()->push_back(static_cast<int>(unknowns[i].value.size()));
  }

  bool Evaluate(const double* const* parameters, double* residuals, double** jacobians) const override {
    if (!term_.residual(parameters, residuals)) return false;
    if (jacobians == nullptr) return true;
    for (std::size_t block = 0; block < parameter_block_sizes().size(); ++block) {
      if (jacobians[block] != nullptr && !differentiate(parameters, block, jacobians[block])) return false;
    }
    return true;
  }

 private:
  bool differentiate(const double* const* parameters, std::size_t block, double* jacobian) const {
    constexpr double kStep = 1e-5;
    const int size = parameter_block_sizes()[block];
    std::vector<const double*> moved(parameters, parameters + parameter_block_sizes().size());
    Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(parameters[block], size);
    moved[block] = values.data();
    Eigen::Vector2d ahead, behind;
    for (int i = 0; i < size; ++i) {
      const double value = values[i];
      values[i] = value + kStep;
      if (!term_.residual(moved.data(), ahead.data())) return false;
      values[i] = value - kStep;
      if (!term_.residual(moved.data(), behind.data())) return false;
      values[i] = value;
      for (int row = 0; row < term_.size; ++row) jacobian[row * size + i] = (ahead[row] - behind[row]) / (2.0 * kStep);
    }
    return true;
  }

  const Term& term_;
};

// The used terms and the priors as a problem of Ceres. Ceres orders blocks by their addresses, so that all lie in one
// array, in the unknowns' order: the same problem gives the same bits.
class Problem {
 public:
  Problem(const Adjustment& adjustment, double outlier_scale) : unknowns_(adjustment.unknowns) {
    std::size_t size = 0;
    for (const Unknown& unknown : unknowns_) size += static_cast<std::size_t>(unknown.value.size());
    values_.resize(size);
    double* next = values_.data();
    for (const Unknown& unknown : unknowns_) {
      block_.push_back(next);
      next = std::copy(unknown.value.begin(), unknown.value.end(), next);
    }
    in_use_.assign(unknowns_.size(), false);
    add_terms(adjustment, outlier_scale);
    add_priors();
  }

  // Where a camera's sightings are all wrong, its unknowns would run away to where nothing is defined.
  void keep_near() {
    constexpr double kFarthest = 15.0;  // sigmas
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (!unknowns_[i].expected) continue;
      for (int component = 0; component < unknowns_[i].value.size(); ++component) {
        problem_.SetParameterLowerBound(block_[i], component, -kFarthest);
        problem_.SetParameterUpperBound(block_[i], component, kFarthest);
      }
    }
  }

  void copy_solution(std::vector<Unknown>& unknowns) const {
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      unknowns[i].value = Eigen::Map<const Eigen::VectorXd>(block_[i], unknowns[i].value.size());
    }
  }

  ceres::Problem& ceres() { return problem_; }
  double* block(std::size_t unknown) { return block_[unknown]; }
  bool in_use(std::size_t unknown) const { return in_use_[unknown]; }

 private:
  void add_terms(const Adjustment& adjustment, double outlier_scale) {
    for (const Term& term : adjustment.terms) {
      if (!term.used) continue;
      std::vector<double*> blocks;
      for (const int i : term.unknowns) {
        blocks.push_back(block_[i]);
        in_use_[i] = true;
      }
      ceres::LossFunction* loss = outlier_scale > 0.0 ? new ceres::CauchyLoss(outlier_scale) : nullptr;
      problem_.AddResidualBlock(new TermCost(term, unknowns_), loss, blocks);
    }
  }

  void add_priors() {
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (!unknowns_[i].expected) continue;
      const auto size = unknowns_[i].value.size();
      in_use_[i] = true;
      problem_.AddResidualBlock(
          new ceres::NormalPrior(Eigen::MatrixXd::Identity(size, size), Eigen::VectorXd::Zero(size)), nullptr,
          block_[i]);
    }
  }

  const std::vector<Unknown>& unknowns_;
  std::vector<double> values_;
  std::vector<double*> block_;  // of each unknown, in values_
  std::vector<bool> in_use_;
  ceres::Problem problem_;
};

void evaluate(Adjustment& adjustment) {
  for (Term& term : adjustment.terms) {
    std::vector<const double*> blocks;
    for (const int i : term.unknowns) blocks.push_back(adjustment.unknowns[i].value.data());
    if (!term.residual(blocks.data(), term.at_solution.data())) term.at_solution.setConstant(HUGE_VAL);
  }
}

}  // namespace

int Adjustment::add_expected(int size) {
  unknowns.push_back({Eigen::VectorXd::Zero(size), true});
  return static_cast<int>(unknowns.size()) - 1;
}

int Adjustment::add_free(const Eigen::VectorXd& first_value) {
  unknowns.push_back({first_value, false});
  return static_cast<int>(unknowns.size()) - 1;
}

void solve(Adjustment& adjustment, double outlier_scale) {
  Problem problem(adjustment, outlier_scale);
  problem.keep_near();
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = 40;
  options.function_tolerance = outlier_scale > 0.0 ? 1e-5 : 1e-10;
  options.linear_solver_type = ceres::DENSE_QR;
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t i = 0; i < adjustment.unknowns.size(); ++i) {
    if (!problem.in_use(i)) continue;
    const bool expected = adjustment.unknowns[i].expected;
    if (!expected) options.linear_solver_type = ceres::DENSE_SCHUR;
    ordering->AddElementToGroup(problem.block(i), expected ? 1 : 0);
  }
  options.linear_solver_ordering = ordering;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem.ceres(), &summary);
  if (!summary.IsSolutionUsable()) {
    throw Error(
        "no rig near the nominal one explains what was seen ({}); are images, places, field and rig those of one "
        "robot, and of the same instants?",
        summary.message);
  }
  problem.copy_solution(adjustment.unknowns);
  evaluate(adjustment);
}

void solve_robustly(Adjustment& adjustment) {
  // From some degrees down to what good bearings may be off by.
  for (const double scale : {300.0, 60.0, 15.0, 4.0}) solve(adjustment, scale);
}

double spread(const Adjustment& adjustment, TermKind kind, double most) {
  std::vector<double> lengths;
  int size = 1;
  for (const Term& term : adjustment.terms) {
    if (term.kind != kind) continue;
    lengths.push_back(term.length());
    size = term.size;
  }
  if (lengths.empty()) return 1.0;
  const double expected = size == 1 ? 0.6745 : 1.1774;  // median of the length of 1 or 2 normal numbers
  return std::clamp(median(std::move(lengths)) / expected, 1.0, most);
}

double unit_weight_error(const Adjustment& adjustment) {
  double sum = 0.0;
  std::ptrdiff_t freedom = 0;
  std::vector<bool> in_use(adjustment.unknowns.size(), false);
  for (const Term& term : adjustment.terms) {
    if (!term.used) continue;
    sum += term.at_solution.squaredNorm();
    freedom += term.size;
    for (const int i : term.unknowns) in_use[i] = true;
  }
  for (std::size_t i = 0; i < in_use.size(); ++i) {
    const Unknown& unknown = adjustment.unknowns[i];
    if (unknown.expected) sum += unknown.value.squaredNorm();  // a prior measures as much as it determines
    if (!unknown.expected && in_use[i]) freedom -= unknown.value.size();
  }
  return freedom > 0 ? std::sqrt(sum / static_cast<double>(freedom)) : 1.0;
}

std::vector<Eigen::VectorXd> sigmas(const Adjustment& adjustment) {
  Problem problem(adjustment, 0.0);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  ceres::Covariance covariance(options);
  std::vector<std::pair<const double*, const double*>> wanted;
  for (std::size_t i = 0; i < adjustment.unknowns.size(); ++i) {
    if (adjustment.unknowns[i].expected) wanted.emplace_back(problem.block(i), problem.block(i));
  }
  if (!covariance.Compute(wanted, &problem.ceres())) {
    throw Error("the calibration's normal equations are singular: some frame tells nothing of its own place");
  }
  std::vector<Eigen::VectorXd> result;
  for (const auto& [block, same] : wanted) {
    const auto size = problem.ceres().ParameterBlockSize(block);
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> variances(size, size);
    covariance.GetCovarianceBlock(block, same, variances.data());
    result.push_back(variances.diagonal().cwiseSqrt());
  }
  return result;
}

}  // namespace movis::calibration
