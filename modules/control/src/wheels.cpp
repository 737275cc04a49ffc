#include "movis/control/wheels.h"

#include <Eigen/QR>
#include <cmath>

#include "movis/core/error.h"

namespace movis::control {

double wheel_rate(const OmniWheels& wheels, double azimuth, const Twist2& twist) {
  return (-std::sin(azimuth) * twist.vx + std::cos(azimuth) * twist.vy + wheels.distance * twist.omega) / wheels.radius;
}

Eigen::MatrixX3d rates_by_twist(const OmniWheels& wheels) {
  Eigen::MatrixX3d matrix(wheels.azimuths.size(), 3);
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const double azimuth = wheels.azimuths[i];
    matrix.row(i) << wheel_rate(wheels, azimuth, {1.0, 0.0, 0.0}), wheel_rate(wheels, azimuth, {0.0, 1.0, 0.0}),
        wheel_rate(wheels, azimuth, {0.0, 0.0, 1.0});
  }
  return matrix;
}

Eigen::VectorXd wheel_rates(const OmniWheels& wheels, const Twist2& twist) {
  return rates_by_twist(wheels) * Eigen::Vector3d(twist.vx, twist.vy, twist.omega);
}

Twist2 twist_of(const OmniWheels& wheels, const Eigen::VectorXd& rates) {
  if (rates.size() != static_cast<Eigen::Index>(wheels.azimuths.size())) {
    throw Error("{} wheel rates were given for {} wheels; one for each is needed", rates.size(),
                wheels.azimuths.size());
  }
  const Eigen::Vector3d twist = rates_by_twist(wheels).colPivHouseholderQr().solve(rates);
  return {twist.x(), twist.y(), twist.z()};
}

}  // namespace movis::control
