#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>

#include "movis/core/paths.h"
#include "movis/sim/renderer.h"

namespace movis::test {

// What the renderer is given. The look is the shipped one without blur and noise.
struct RenderScene {
  omni::Rig rig = omni::read_rig(data_file("rigs/movis.yaml"));
  sim::Arena arena;
  control::RobotModel robot = control::read_robot(data_file("robots/miniature.yaml"));
  sim::Look look = clean_look();
  sim::State state{0.0, {}, {1.5, 0.0, sim::kBallRadius}};

  grab::FrameSet images(std::uint64_t noise_seed = 1) const {
    sim::Renderer renderer(rig, arena, robot, look);
    grab::FrameSet images;
    renderer.render(state, noise_seed, images);
    return images;
  }

 private:
  static sim::Look clean_look() {
    sim::Look look = sim::read_look(data_file("looks/hall.yaml"));
    look.sensor = {};
    return look;
  }
};

// The sRGB curve of IEC 61966-2-1, 8 bits, and back to linear light.
inline double srgb_byte(double linear) {
  const double bounded = std::clamp(linear, 0.0, 1.0);
  return 255.0 * (bounded <= 0.0031308 ? 12.92 * bounded : 1.055 * std::pow(bounded, 1.0 / 2.4) - 0.055);
}
inline double linear_of(std::uint8_t byte) {
  const double value = byte / 255.0;
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// Linear red, green, blue of the pixel that shows a point of the field frame, in the camera nearest to it: nothing of
// the robot stands between them.
inline Eigen::Array3d light_of(const RenderScene& scene, const grab::FrameSet& images, const Eigen::Vector3d& point) {
  Eigen::Vector3d in_robot = point;
  in_robot.head<2>() = inverse(scene.state.world_from_robot) * Eigen::Vector2d(point.head<2>());
  std::size_t nearest = 0;
  const auto distance = [&](std::size_t i) { return (scene.rig.cameras[i].position - in_robot).norm(); };
  for (std::size_t i = 1; i < scene.rig.cameras.size(); ++i) nearest = distance(i) < distance(nearest) ? i : nearest;
  const Eigen::Vector2d pixel = project(scene.rig.cameras[nearest], in_robot).value();
  const auto bgr = images.memory[nearest].at<cv::Vec3b>(static_cast<int>(std::lround(pixel.y())),
                                                        static_cast<int>(std::lround(pixel.x())));
  return {linear_of(bgr[2]), linear_of(bgr[1]), linear_of(bgr[0])};
}

// Is it a surface of that colour, from a third of its full light to a little more than it?
inline bool shows(const Eigen::Array3d& light, const sim::Colour& colour) {
  const Eigen::Array3d surface = colour.head<3>().cast<double>();
  const double brightness = light.sum() / surface.sum();
  if (brightness < 0.33 || brightness > 1.15) return false;
  return (light / light.sum() - surface / surface.sum()).abs().maxCoeff() < 0.05;
}

}  // namespace movis::test
