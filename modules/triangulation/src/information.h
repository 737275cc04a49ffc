#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <limits>

namespace movis::triangulation {

// The sine of the angle to the vertical below which a direction has no azimuth.
inline constexpr double kNoAzimuth = 1e-6;

template <int N>
Eigen::Matrix<double, N, N> unobservable() {
  return Eigen::Matrix<double, N, 1>::Constant(std::numeric_limits<double>::infinity()).asDiagonal();
}

// The inverse of a Fisher information. Something is not observable where, in units that make the diagonal 1, a
// direction has less than 1e-12 of information: that is rounding.
template <int N>
Eigen::Matrix<double, N, N> inverse_information(const Eigen::Matrix<double, N, N>& information) {
  using Matrix = Eigen::Matrix<double, N, N>;
  using Vector = Eigen::Matrix<double, N, 1>;
  constexpr double kRounding = 1e-12;
  if (!(information.diagonal().minCoeff() > 0.0)) return unobservable<N>();
  const Vector scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(scale.asDiagonal() * information * scale.asDiagonal());
  if (!(eigen.eigenvalues().minCoeff() > kRounding)) return unobservable<N>();
  const Matrix inverse =
      eigen.eigenvectors() * eigen.eigenvalues().cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

}  // namespace movis::triangulation
