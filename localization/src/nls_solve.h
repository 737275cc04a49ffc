#pragma once

#include <Eigen/Core>
#include <array>

#include "goal_edges.h"

// One local solution of nls.
namespace movis::localization {

// Unknowns: x, y, β, and the biases of the yellow and the blue goal's edges.
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

inline constexpr int kMostLinePoints = 2048;  // more are not used

struct Problem {
  const GoalEdges& edges;
  const std::vector<LinePoint>& lines;
  const FieldMap& map;
  const NlsOptions& options;
};

struct Candidate {
  Pose2 world_from_robot;
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
  double edge_scale = 1.0;  // by how much the residuals spread more than their sigmas tell
  double line_scale = 1.0;
  int agreeing = 0;                              // edges within the loss's width
  std::array<int, 2> clean{}, clean_agreeing{};  // of the yellow and the blue goal
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

// From a place and heading that may be off by as much as `start_width` radians in an edge's azimuth.
Candidate solve_from(const Pose2& guess, double start_width, const Problem& problem);

// Whether what is seen beside speaks against a pose: lines against one by the edges, edges against one by the lines.
enum class LineVerdict { silent, in_favour, against };
LineVerdict verdict_of_lines(const Candidate& candidate, const Problem& problem);
bool edges_contradict(const Candidate& candidate, const Problem& problem);

// How badly a candidate fits, in the same scales as another one that it is compared with.
double cost_of(const Candidate& candidate, double edge_scale, double line_scale, const Problem& problem);

}  // namespace movis::localization
