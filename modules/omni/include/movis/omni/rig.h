#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "movis/core/image_view.h"
#include "movis/omni/camera_model.h"

namespace movis::omni {

// One camera of the rig. The robot frame has its origin on the floor, x right, y forward, z up.
struct Camera {
  std::string name;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the viewpoint in the robot frame, metres
  double yaw = 0.0;                                    // radians
  double tilt_x = 0.0, tilt_y = 0.0;                   // radians
  int width = 0, height = 0;                           // of the image, pixels
  std::optional<PixelFormat> format;                   // where the rig file insists on one
  CameraModel model;
  std::filesystem::path mask;  // an image, black where the camera sees nothing of the world; empty: none

  // Rz(yaw)·Ry(tilt_y)·Rx(tilt_x)
  Eigen::Matrix3d robot_from_camera() const;
};

struct Rig {
  std::vector<Camera> cameras;
};

// The pixel at which a camera sees a point of the robot frame; nothing where it does not.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& point_in_robot);

// The unit ray of a pixel in the robot's axes, starting at camera.position.
std::optional<Eigen::Vector3d> unproject(const Camera& camera, const Eigen::Vector2d& pixel);

// Reads rig.yaml strictly: an unknown or missing key, or a value out of range, is an Error naming file, line, key.
// Paths of masks are relative to the file.
Rig read_rig(const std::filesystem::path& file);

// Writes a rig.yaml that read_rig reads back: every number exactly, but for angles that no number of degrees gives to
// the last bit. A mask below the file's folder is written relative to it, another with its full path. `comments` head
// the file, one line each.
void write_rig(const Rig& rig, const std::filesystem::path& file, const std::vector<std::string>& comments = {});

}  // namespace movis::omni
