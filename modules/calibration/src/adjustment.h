#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

// Least squares over blocks of unknowns that share terms (Ceres is behind it). A term is what one camera, or a tape,
// measured in one frame; its residual is in standard deviations of what it expects, so that lengths of different terms
// compare.
namespace movis::calibration {

struct Unknown {
  Eigen::VectorXd value;
  bool expected = false;  // has a prior: zero ± 1 in every component
};

enum class TermKind { ball, left_edge, right_edge, place };

struct Term {
  int frame = 0;   // index into the frames
  int camera = 0;  // of a place: −1
  TermKind kind = TermKind::ball;
  std::vector<int> unknowns;                                                      // indices into Adjustment::unknowns
  int size = 0;                                                                   // of its residual
  std::function<bool(const double* const* unknowns, double* residual)> residual;  // false: not defined there

  Eigen::Matrix2d root =
      Eigen::Matrix2d::Zero();  // of one sigma, radians; of a place metres: root · residual is what it measures

  bool used = true;
  Eigen::Vector2d at_solution = Eigen::Vector2d::Zero();  // its residual; in the first `size` components
  double length() const { return at_solution.norm(); }
};

struct Adjustment {
  std::vector<Unknown> unknowns;
  std::vector<Term> terms;

  int add_expected(int size);                        // starts at its prior
  int add_free(const Eigen::VectorXd& first_value);  // of one frame alone: no term may have two of them
};

// Minimizes over the terms that are used, then evaluates all terms. With `outlier_scale` > 0, in standard deviations,
// what lies far beyond it hardly counts (Cauchy's loss); with 0 the least squares count.
void solve(Adjustment& adjustment, double outlier_scale);

// From nothing known of outliers to their absence: solves with falling outlier scales, each from where the last ended.
void solve_robustly(Adjustment& adjustment);

// How much larger the residuals of a kind are than was expected: a robust factor of at least 1 and at most `most`.
double spread(const Adjustment& adjustment, TermKind kind, double most);

// The root of the weighted sum of squares over the degrees of freedom: about 1 where all was as expected.
double unit_weight_error(const Adjustment& adjustment);

// Standard deviations of the expected unknowns' components at the solution, from the normal equations.
std::vector<Eigen::VectorXd> sigmas(const Adjustment& adjustment);

}  // namespace movis::calibration
