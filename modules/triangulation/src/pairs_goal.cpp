#include <cmath>

#include "movis/triangulation/pairs.h"
#include "owning_pair.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix2d;

// One of a goal's landmarks: which azimuth of the bearing it is, and how that follows from its (left, right) edges.
struct Landmark {
  double Bearing::*azimuth;
  Eigen::RowVector2d by_edges;
  int row;  // of GoalPoints::covariance
};

// Where each bearing's two edges stand in the derivative's columns: a camera has at most one bearing of a goal, so a
// landmark's two cameras are found by their index in `bearings`.
using ByEdges = Eigen::Matrix<double, 2, 4>;

ByEdges derivative_by_edges(const OwningPair& pair, const Landmark& landmark) {
  ByEdges by_edges;
  by_edges.leftCols<2>() = pair.intersection.point_by_azimuths.col(0) * landmark.by_edges;
  by_edges.rightCols<2>() = pair.intersection.point_by_azimuths.col(1) * landmark.by_edges;
  return by_edges;
}

Eigen::Vector2d edge_variances(const Bearing& bearing) {
  return {bearing.left_variance, bearing.right_variance};
}

// Covariance of two landmarks, through the edges of the bearings that they share.
Matrix2d cross_covariance(const OwningPair& a, const ByEdges& a_by_edges, const OwningPair& b,
                          const ByEdges& b_by_edges) {
  Matrix2d covariance = Matrix2d::Zero();
  const Bearing* const of_a[] = {a.first, a.second};
  const Bearing* const of_b[] = {b.first, b.second};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      if (of_a[i] != of_b[j]) continue;
      covariance += a_by_edges.middleCols<2>(2 * i) * edge_variances(*of_a[i]).asDiagonal() *
                    b_by_edges.middleCols<2>(2 * j).transpose();
    }
  }
  return covariance;
}

}  // namespace

GoalPoints triangulate_goal_pairs(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass goal,
                                  const PairsOptions& options) {
  const Landmark landmarks[] = {
      {&Bearing::azimuth, {0.5, 0.5}, 0}, {&Bearing::left, {1.0, 0.0}, 2}, {&Bearing::right, {0.0, 1.0}, 4}};
  OwningPair pairs[3];
  ByEdges by_edges[3];
  for (int i = 0; i < 3; ++i) {
    const auto azimuth = [&](const Bearing& bearing) { return bearing.*landmarks[i].azimuth; };
    pairs[i] = find_owning_pair(rig, bearings, goal, azimuth, options);
    by_edges[i] = derivative_by_edges(pairs[i], landmarks[i]);
  }

  GoalPoints points;
  points.centre_status = pairs[0].status;
  points.edges_status = pairs[1].status != PointStatus::ok ? pairs[1].status : pairs[2].status;
  points.centre = pairs[0].intersection.point;
  points.left = pairs[1].intersection.point;
  points.right = pairs[2].intersection.point;
  const bool solved[] = {points.centre_status == PointStatus::ok, points.edges_status == PointStatus::ok,
                         points.edges_status == PointStatus::ok};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (!solved[i] || !solved[j]) continue;
      points.covariance.block<2, 2>(landmarks[i].row, landmarks[j].row) =
          cross_covariance(pairs[i], by_edges[i], pairs[j], by_edges[j]);
    }
  }
  return points;
}

}  // namespace movis::triangulation
