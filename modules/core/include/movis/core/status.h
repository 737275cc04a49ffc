#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "movis/core/pose.h"

namespace movis {

// A geometry that cannot be solved is a status, never a NaN and never an exception.

// What became of the measurement of a point. The words are those of the estimates' CSV.
enum class PointStatus : std::uint8_t {
  ok,
  not_seen,       // no camera saw it
  one_camera,     // one bearing gives a direction, no distance
  parallel_rays,  // the rays do not intersect within the range that is measured
  behind_camera,  // the lines intersect, but behind a camera: the bearings are not of one point
  contradiction,  // the bearings are not of one point, and nothing tells which of them is wrong
};

// What became of a fix of the robot's pose.
enum class FixStatus : std::uint8_t {
  ok,
  no_field,            // there is no field file: no pose was sought
  no_goal,             // neither goal was seen
  one_goal,            // one goal gives no pose
  no_distance,         // the goals were seen, but their landmarks could not be triangulated
  contradiction,       // the goals' measured distance from each other is not that of the field file
  coinciding_circles,  // (18) is 0/0: the robot stands on the circle through all four posts
  negative_radicand,   // (17): the two circles do not meet
  outside_field,       // the solution lies far outside the field: it is not believed
  no_landmark,         // neither goals nor lines enough for a pose were seen
  ambiguous,           // another pose explains what was seen as well, or nearly so
  bad_fit,             // no pose explains what was seen
};

const char* word(PointStatus status);
const char* word(FixStatus status);

// A measured point. With a status other than ok, point and covariance mean nothing.
struct PointEstimate {
  PointStatus status = PointStatus::not_seen;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       // metres
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // m²
  bool on_floor = false;  // that it lies on the floor is part of the measurement; else its height was measured
};

// The robot's pose, of one instant. Pose and covariance mean nothing but with ok, and ambiguous where symmetric.
struct Fix {
  FixStatus status = FixStatus::no_field;
  Pose2 world_from_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  // of (x, y, beta): m², m·rad, rad²

  // What was seen fits the pose turned by half a turn about the centre spot as well: a field with white goals looks the
  // same from there.
  bool symmetric = false;
};

// The other pose of a symmetric fix. The signs of x and y change together, so the covariance's entries with β do.
Fix half_turned(const Fix& fix);

// Of a symmetric fix the pose that is at most a quarter of a turn off the truth; any other fix as it is.
Fix nearer_half(const Fix& fix, const Pose2& truth);

}  // namespace movis
