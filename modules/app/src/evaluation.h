#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "movis/core/pose.h"
#include "movis/grab/truth.h"
#include "movis/pipeline/pipeline.h"

namespace movis::app {

// How estimates compare with the truth, after the fact.
struct BallError {
  double distance = 0.0;   // measured minus true distance from the robot's origin, metres
  double direction = 0.0;  // measured minus true azimuth in the robot frame, radians
  double position = 0.0;   // on the floor plane, metres
};

struct PoseError {
  double x = 0.0, y = 0.0;  // field frame, metres
  double beta = 0.0;        // radians
  double nees = 0.0;        // eᵀ C⁻¹ e / 3: 1 in the mean where the covariances are honest
};

Eigen::Vector2d true_ball_in_robot(const grab::Truth& truth);
BallError ball_error(const Eigen::Vector2d& ball_in_robot, const grab::Truth& truth);
PoseError pose_error(const Fix& measured, const grab::Truth& truth);

// Collects errors and says what came of them, in tables for standard output.
class Evaluation {
 public:
  void add(const pipeline::Estimate& estimate, const grab::Truth& truth);
  std::string table() const;

 private:
  // The frames of one label.
  struct Poses {
    int frames = 0;
    std::vector<PoseError> errors;  // of the fixes that are ok
  };
  int frames_ = 0;
  int poses_sought_ = 0;
  bool symmetric_ = false;
  std::vector<BallError> balls_;
  std::map<std::string, Poses> poses_;
};

}  // namespace movis::app
