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
};

Eigen::Vector2d true_ball_in_robot(const grab::Truth& truth);
BallError ball_error(const Eigen::Vector2d& ball_in_robot, const grab::Truth& truth);
PoseError pose_error(const Pose2& world_from_robot, const grab::Truth& truth);

// Collects errors and says what came of them, in tables for standard output.
class Evaluation {
 public:
  void add(const pipeline::Estimate& estimate, const grab::Truth& truth);
  std::string table() const;

 private:
  struct LabelledPose {
    std::string label;
    PoseError error;
  };
  int frames_ = 0;
  int poses_sought_ = 0;
  std::vector<BallError> balls_;
  std::vector<LabelledPose> poses_;
};

}  // namespace movis::app
