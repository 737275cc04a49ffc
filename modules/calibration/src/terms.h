#pragma once

#include <vector>

#include "adjustment.h"
#include "candidate.h"
#include "movis/calibration/rig_calibration.h"
#include "movis/core/pose.h"

// What the bearings say of the unknowns. A bearing is turned back into its pixel by the rig that was believed when it
// was found; through the candidate rig the pixel has a direction, and that is compared with where the thing is.
namespace movis::calibration {

// Unknowns of every calibration: one block of nine deviations a camera, and the biases, in units of their sigmas.
struct RigUnknowns {
  std::vector<int> cameras;
  int elevation_bias = -1;
  int edge_bias = -1;
};

// What all terms share.
struct Drawing {
  Drawing(const omni::Rig& nominal, const omni::Rig& believed, const RigOptions& options);

  std::vector<omni::Camera> cameras;   // nominal
  std::vector<omni::Camera> believed;  // of the sightings
  RigOptions options;
};

// Is a bearing of the ball of use? One that is cut is a part of the ball alone.
bool useful_ball(const Bearing& bearing);
// A goal's edges are of use where nothing hides any part of the goal.
bool useful_goal(const Bearing& bearing);

// By what a written place is off on the floor: an unknown (x, y) in units of `place_sigma`, and the term that says so.
// −1 where that is 0: such a place is exact.
int add_slip(Adjustment& adjustment, int frame, double place_sigma);

// A ball's direction, azimuth and elevation, at a known place in the robot frame (with its slip or −1) or at an unknown
// one on the floor. The unknown (azimuth, log distance) from the robot's origin keeps far places as tame as near ones.
// Nothing is added where the bearing lies outside the camera's domain; the term's index otherwise, or −1.
int add_known_ball(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
                   const Bearing& bearing, const Eigen::Vector3d& ball_in_robot, int slip);
int add_floor_ball(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
                   const Bearing& bearing, int ball);
Eigen::Vector2d floor_place(const Eigen::VectorXd& ball);  // metres, of its unknown

// The two edges of a goal, azimuth alone, seen from an unknown pose (x, y, β).
void add_goal(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
              const Bearing& bearing, const Field& field, int pose);

// The covariance of a ball's (azimuth, elevation) that a term expects, rad².
Eigen::Matrix2d expected_covariance(const Bearing& bearing, const RigOptions& options);

}  // namespace movis::calibration
