#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "movis/core/pose.h"

namespace movis::grab {

// Where robot and ball really were, in the field frame (metres, radians). It is for judging estimates, never for
// making them: that is why a Dataset does not hold it.
struct Truth {
  double time_s = 0.0;
  Pose2 world_from_robot;
  Eigen::Vector3d ball_in_field = Eigen::Vector3d::Zero();
  std::string label;  // may be empty
};

// Reads truth.csv, by frame number. Its header is exactly
//   frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z,label
// Errors name file, line and column: another header, a cell that is no number, a frame number that stands twice, no
// row.
std::map<std::int64_t, Truth> read_truth(const std::filesystem::path& file);

}  // namespace movis::grab
