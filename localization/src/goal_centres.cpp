#include "goal_centres.h"

#include <cmath>

namespace movis::localization {

Solution solve_centres(const triangulation::GoalLandmarks& landmarks) {
  const Eigen::Vector2d& p = landmarks.yellow.centre;
  const Eigen::Vector2d& q = landmarks.blue.centre;
  const Eigen::Vector2d d = p - q;
  const Eigen::Vector2d m = 0.5 * (p + q);

  const double beta = std::atan2(d.x(), d.y());  // (11)
  const double c = std::cos(beta);
  const double s = std::sin(beta);
  const double x_r = m.y() * s - m.x() * c;   // the mean of (7) and (9), which is (19)
  const double y_r = -m.x() * s - m.y() * c;  // the mean of (8) and (10): +Fd and −Fd cancel

  // As (X_R, Y_R) = −R(β) m, its derivative by β is (−Y_R, X_R).
  Eigen::Matrix<double, 3, 2> by_m;
  by_m << -c, s,  //
      -s, -c,     //
      0.0, 0.0;
  const Eigen::RowVector2d beta_by_d = Eigen::RowVector2d(d.y(), -d.x()) / d.squaredNorm();
  const Eigen::Matrix<double, 3, 2> by_d = Eigen::Vector3d(-y_r, x_r, 1.0) * beta_by_d;

  Solution solution;
  solution.world_from_robot = {x_r, y_r, wrap_angle(beta)};
  solution.by_yellow.middleCols<2>(kCentre) = 0.5 * by_m + by_d;
  solution.by_blue.middleCols<2>(kCentre) = 0.5 * by_m - by_d;
  return solution;
}

bool centres_contradict(const triangulation::GoalLandmarks& landmarks, const Field& field) {
  constexpr double kSigmas = 5.0;
  constexpr double kShare = 0.25;
  const Eigen::Vector2d d = landmarks.yellow.centre - landmarks.blue.centre;
  if (!(d.norm() > 0.0)) return false;  // one point: no direction, and so no pose
  const Eigen::Vector2d along = d.normalized();
  const Eigen::Matrix2d covariance =
      landmarks.yellow.covariance.topLeftCorner<2, 2>() + landmarks.blue.covariance.topLeftCorner<2, 2>();
  const double deviation = std::sqrt(std::max(0.0, along.dot(covariance * along)));
  const double expected = 2.0 * field.Fd;
  return std::abs(d.norm() - expected) > kSigmas * deviation + kShare * expected;
}

}  // namespace movis::localization
