#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "movis/core/field.h"
#include "movis/core/pose.h"

namespace movis::sim {

// A black cylinder with a coloured band around it: another robot.
struct Obstacle {
  enum class Band { none, cyan, magenta };
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  // field frame, metres
  double radius = 0.2;                                 // metres
  double height = 0.6;
  Band band = Band::none;
  double band_bottom = 0.35, band_top = 0.45;  // heights, metres
};

// A wall around the field, parallel to its lines.
struct Wall {
  double distance = 0.5;  // from the lines' outer edges, metres
  double height = 0.3;
};

// What stands still in the world.
struct Arena {
  std::optional<Field> field;  // without one: a bare green floor
  std::optional<Wall> wall;
  std::vector<Obstacle> obstacles;
};

// What moves.
struct State {
  double time_s = 0.0;
  Pose2 world_from_robot;
  Eigen::Vector3d ball_in_field = Eigen::Vector3d::Zero();  // of its centre
};

inline constexpr double kBallRadius = 0.11;  // metres
inline constexpr double kBackPanel = 0.02;   // thickness of a goal's back, metres; it lies centred on the goal's depth

}  // namespace movis::sim
