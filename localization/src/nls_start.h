#pragma once

#include <array>

#include "goal_edges.h"

// Where nls may start when nobody has a guess.
namespace movis::localization {

inline constexpr int kMostStarts = 8;

// How far beyond the lines the robot is sought, metres. Farther out a goal seen from behind mirrors one seen from the front.
inline constexpr double kBeyond = 0.5;

struct Starts {
  std::array<Pose2, kMostStarts> pose;
  std::array<double, kMostStarts> cost{};
  int count = 0;

  // Keeps the best, one of those that are close to each other.
  void offer(const Pose2& candidate, double candidate_cost);
};

// Places on a lattice over the field, the heading of each from the edges.
void offer_by_edges(const GoalEdges& edges, const Field& field, Starts& starts);

}  // namespace movis::localization
