#include "nls_start.h"

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/localization/goal_silhouette.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

constexpr double kLattice = 0.25;        // metres
const double kEdgeSigma = radians(3.0);  // of an edge, on a lattice that coarse

struct Guess {
  Pose2 pose;
  double cost = 0.0;
};

// The heading that the edges imply at a place, their weighted circular mean, and how badly they agree with it.
// `heading` tells where the cameras stand.
Guess guess_heading(const GoalEdges& edges, const Field& field, const Vector2d& place, double heading) {
  const double c = std::cos(heading);
  const double s = std::sin(heading);
  std::array<double, kMostEdges> implied{};
  std::array<double, kMostEdges> weight{};
  Vector2d sum = Vector2d::Zero();
  Silhouette silhouette;
  int sight = -1;
  for (int i = 0; i < edges.count; ++i) {
    const GoalEdge& edge = edges.edge[i];
    if (edge.sight != sight) {
      sight = edge.sight;
      const Vector2d& at = edge.viewpoint_in_robot;
      silhouette =
          goal_silhouette(field, edge.goal, place + Vector2d(c * at.x() - s * at.y(), s * at.x() + c * at.y()));
    }
    implied[i] = (edge.is_left ? silhouette.left : silhouette.right) - edge.azimuth;
    weight[i] = 1.0 / (edge.sigma * edge.sigma + kEdgeSigma * kEdgeSigma);
    sum += weight[i] * Vector2d(std::cos(implied[i]), std::sin(implied[i]));
  }
  Guess guess{{place.x(), place.y(), std::atan2(sum.y(), sum.x())}, 0.0};
  constexpr double kSquaredWidth = 4.0;  // of the Geman–McClure loss
  for (int i = 0; i < edges.count; ++i) {
    const double off = turn(guess.pose.beta, implied[i]);
    const double squared = off * off * weight[i];
    guess.cost += squared * kSquaredWidth / (kSquaredWidth + squared);
  }
  return guess;
}

bool inside_a_goal(const Field& field, const Vector2d& place) {
  constexpr double kMargin = 0.05;  // metres
  const double y = std::abs(place.y());
  return std::abs(place.x()) < field.Fw + field.goal_thickness + kMargin && y > field.Fd - kMargin &&
         y < field.Fd + field.goal_depth + field.goal_thickness + kMargin;
}

}  // namespace

void Starts::offer(const Pose2& candidate, double candidate_cost) {
  constexpr double kApart = 0.6;  // metres
  const double kTurned = radians(40.0);
  int place = count;
  for (int i = 0; i < count; ++i) {
    const bool near = (pose[i].translation() - candidate.translation()).norm() < kApart &&
                      std::abs(turn(pose[i].beta, candidate.beta)) < kTurned;
    if (!near) continue;
    if (cost[i] <= candidate_cost) return;
    place = i;
    break;
  }
  if (place == kMostStarts) {
    const auto worst = std::max_element(cost.begin(), cost.end());
    if (*worst <= candidate_cost) return;
    place = static_cast<int>(worst - cost.begin());
  }
  pose[place] = candidate;
  cost[place] = candidate_cost;
  count = std::max(count, place + 1);
}

void offer_by_edges(const GoalEdges& edges, const Field& field, Starts& starts) {
  if (edges.count == 0) return;
  const int columns = static_cast<int>(std::ceil((field.half_width + kBeyond) / kLattice));
  const int rows = static_cast<int>(std::ceil((field.half_length + kBeyond) / kLattice));
  for (int row = -rows; row <= rows; ++row) {
    for (int column = -columns; column <= columns; ++column) {
      const Vector2d place(column * kLattice, row * kLattice);
      if (inside_a_goal(field, place)) continue;
      // The cameras stand off the robot's origin: first the heading without, then with that.
      const Guess rough = guess_heading(edges, field, place, 0.0);
      const Guess guess = guess_heading(edges, field, place, rough.pose.beta);
      starts.offer(guess.pose, guess.cost);
    }
  }
}

}  // namespace movis::localization
