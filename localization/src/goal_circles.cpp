#include "goal_circles.h"

#include <algorithm>
#include <cmath>

namespace movis::localization {
namespace {

using triangulation::GoalPoints;

// Circles are held to coincide while the distance between their centres, the denominator of (18), lies within three
// standard deviations of zero: there its sign is open, and first-order propagation through a quotient is void.
constexpr double kCoincidenceSigmas = 3.0;
// And below this distance in metres however exact the bearings: goals are put up by hand, to about a centimetre.
constexpr double kCoincidenceDistance = 0.01;

// The angle from the right to the left edge at the robot's origin, in (−π, π]; 0 where an edge is the origin itself.
double subtended_angle(const GoalPoints& goal) {
  const Eigen::Vector2d& l = goal.left;
  const Eigen::Vector2d& r = goal.right;
  return std::atan2(r.x() * l.y() - r.y() * l.x(), r.dot(l));
}

// `side` is +1 for the yellow goal at +Fd, −1 for the blue one at −Fd.
GoalCircle circle_of(const GoalPoints& goal, double theta, double side, const Field& field) {
  const double w = silhouette_half_width(field);
  const double sine = std::sin(theta);
  GoalCircle circle;
  circle.radius = w / sine;                                          // (12), (13)
  circle.centre_y = side * (field.Fd - w * std::cos(theta) / sine);  // (15), (16)
  const double centre_y_by_theta = side * w / (sine * sine);
  circle.gradient.segment<2>(kLeft) = centre_y_by_theta * azimuth_gradient(goal.left);
  circle.gradient.segment<2>(kRight) = -centre_y_by_theta * azimuth_gradient(goal.right);
  return circle;
}

double variance(const GoalGradient& gradient, const GoalPoints& goal) {
  return (gradient * goal.covariance).dot(gradient);
}

}  // namespace

GoalCircles meet_circles(const triangulation::GoalLandmarks& landmarks, const Field& field) {
  const auto& [yellow, blue] = landmarks;
  GoalCircles circles;
  const double theta_p = subtended_angle(yellow);
  const double theta_q = subtended_angle(blue);
  if (!(theta_p > 0.0 && theta_p < kPi && theta_q > 0.0 && theta_q < kPi)) return circles;

  circles.p = circle_of(yellow, theta_p, 1.0, field);
  circles.q = circle_of(blue, theta_q, -1.0, field);
  const double r_p = circles.p.radius;
  const double r_q = circles.q.radius;
  const double y_pc = circles.p.centre_y;
  const double y_qc = circles.q.centre_y;

  const double apart = y_qc - y_pc;
  const double sigma = std::sqrt(variance(circles.p.gradient, yellow) + variance(circles.q.gradient, blue));
  if (std::abs(apart) < std::max(kCoincidenceDistance, kCoincidenceSigmas * sigma)) {
    circles.status = FixStatus::coinciding_circles;
    return circles;
  }

  circles.y_r = ((r_p * r_p - y_pc * y_pc) - (r_q * r_q - y_qc * y_qc)) / (2.0 * apart);  // (18), (20)
  // As r_P² = w² + (Fd − Y_Pc)² and r_Q² = w² + (Fd + Y_Qc)², (18) is −Fd (Y_Pc + Y_Qc) / (Y_Qc − Y_Pc).
  circles.y_by_yellow = -2.0 * field.Fd * y_qc / (apart * apart) * circles.p.gradient;
  circles.y_by_blue = 2.0 * field.Fd * y_pc / (apart * apart) * circles.q.gradient;
  circles.status = FixStatus::ok;
  return circles;
}

}  // namespace movis::localization
