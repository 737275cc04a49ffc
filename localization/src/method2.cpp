#include "movis/localization/method2.h"

#include <array>
#include <cmath>

#include "goal_circles.h"

namespace movis::localization {
namespace {

// An edge of a goal, where it stands and where it was measured.
struct Edge {
  Eigen::Vector2d in_world;
  Eigen::Vector2d in_robot;
  GoalJacobian* by_goal;  // the derivatives by the points of the edge's goal
  int column;             // of the edge in it
};

// The circular mean of the headings that the edges imply at the solution's position, and its derivatives.
void add_heading(const std::array<Edge, 4>& edges, Solution& solution) {
  const Eigen::Vector2d position = solution.world_from_robot.translation();
  std::array<double, 4> headings{};
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Eigen::Vector2d sight = edges[i].in_world - position;
    headings[i] = std::atan2(sight.y(), sight.x()) - std::atan2(edges[i].in_robot.y(), edges[i].in_robot.x());
    sum += Eigen::Vector2d(std::cos(headings[i]), std::sin(headings[i]));
  }
  const double mean = std::atan2(sum.y(), sum.x());
  solution.world_from_robot.beta = wrap_angle(mean);

  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double weight = std::cos(headings[i] - mean) / sum.norm();
    const Eigen::RowVector2d by_position = -weight * azimuth_gradient(edges[i].in_world - position);
    solution.by_yellow.row(kBeta) += by_position * solution.by_yellow.topRows<2>();
    solution.by_blue.row(kBeta) += by_position * solution.by_blue.topRows<2>();
    edges[i].by_goal->block<1, 2>(kBeta, edges[i].column) -= weight * azimuth_gradient(edges[i].in_robot);
  }
}

}  // namespace

Fix method2(const triangulation::GoalLandmarks& landmarks, const Field& field) {
  if (const FixStatus status = landmark_status(landmarks, Needs::edges); status != FixStatus::ok) return failed(status);
  const auto& [yellow, blue] = landmarks;
  const GoalCircles circles = meet_circles(landmarks, field);  // (12)–(16), (18)
  if (circles.status != FixStatus::ok) return failed(circles.status);
  const double y_r = circles.y_r;
  const double r_p = circles.p.radius;
  const double y_pc = circles.p.centre_y;

  const double radicand = r_p * r_p - (y_r - y_pc) * (y_r - y_pc);
  if (radicand <= 0.0) return failed(FixStatus::negative_radicand);
  const bool p1_is_nearer = yellow.left.squaredNorm() <= yellow.right.squaredNorm();
  const double x_r = p1_is_nearer ? -std::sqrt(radicand) : std::sqrt(radicand);  // (17)

  Solution solution;
  solution.world_from_robot = {x_r, y_r, 0.0};
  // With r_P² = w² + (Fd − Y_Pc)², (17) gives X_R dX_R = (Y_R − Fd) dY_Pc − (Y_R − Y_Pc) dY_R.
  solution.by_yellow.row(kX) = ((y_r - field.Fd) * circles.p.gradient - (y_r - y_pc) * circles.y_by_yellow) / x_r;
  solution.by_blue.row(kX) = -(y_r - y_pc) * circles.y_by_blue / x_r;
  solution.by_yellow.row(kY) = circles.y_by_yellow;
  solution.by_blue.row(kY) = circles.y_by_blue;

  const double w = silhouette_half_width(field);
  add_heading({{{{-w, field.Fd}, yellow.left, &solution.by_yellow, kLeft},   // P1
                {{w, field.Fd}, yellow.right, &solution.by_yellow, kRight},  // P2
                {{-w, -field.Fd}, blue.right, &solution.by_blue, kRight},    // Q1
                {{w, -field.Fd}, blue.left, &solution.by_blue, kLeft}}},     // Q2
              solution);
  return fix_from(solution, landmarks, field);
}

}  // namespace movis::localization
