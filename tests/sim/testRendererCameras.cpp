// Cameras other than those of the ray-traced sets, and a ball in the air: the directions that are measured in the
// picture are the true ones.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "movis/core/angle.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "render_scene.h"

namespace movis {
namespace {

using Eigen::Vector3d;
using test::RenderScene;

// The sphere model of the same camera (omni/hyperboloid.h).
omni::UnifiedSphere sphere_of(const omni::Hyperboloid& mirror) {
  const double c2 = mirror.a * mirror.a + mirror.b * mirror.b;
  const double sum = mirror.a * mirror.a + c2;
  const double scale = mirror.b * mirror.b / sum;
  omni::UnifiedSphere sphere;
  sphere.xi = 2.0 * mirror.a * std::sqrt(c2) / sum;
  sphere.fu = mirror.fu * scale;
  sphere.fv = mirror.fv * scale;
  sphere.u0 = mirror.u0;
  sphere.v0 = mirror.v0;
  const double rim_height = mirror.a * std::hypot(1.0, mirror.rim_radius / mirror.b) - std::sqrt(c2);
  sphere.max_elevation = std::atan2(rim_height, mirror.rim_radius);
  return sphere;
}

TEST(RendererCameras, UnifiedSphereSeesTheSame) {
  RenderScene scene;
  scene.arena.field = read_field(data_file("fields/paper.yaml"));
  const cv::Mat by_mirror = scene.images().memory[0];
  scene.rig.cameras[0].model = sphere_of(std::get<omni::Hyperboloid>(scene.rig.cameras[0].model));
  const cv::Mat by_sphere = scene.images().memory[0];
  cv::Mat difference;
  cv::absdiff(by_mirror, by_sphere, difference);
  EXPECT_LT(cv::mean(difference)[1], 0.02);  // rounding moves a few rays across an edge
  EXPECT_LT(cv::countNonZero(difference.reshape(1) > 2), static_cast<int>(difference.total()) / 1000);
}

// The ball at many places, measured by the pipeline. What the detector itself leaves of its clean bearings: 0.03° in
// azimuth, 0.2° in elevation (tests/scan/testPovImages.cpp).
void expect_true_directions(RenderScene& scene, const std::vector<Vector3d>& balls, int fewest) {
  pipeline::Pipeline pipeline(scene.rig, std::nullopt, scan::read_colours(data_file("colours/default.yaml")), {},
                              localization::find_localizer("composed"));
  sim::Renderer renderer(scene.rig, scene.arena, scene.robot, scene.look);
  const Pose2 robot_from_world = inverse(scene.state.world_from_robot);
  grab::FrameSet images;
  int seen = 0;
  for (const Vector3d& ball : balls) {
    scene.state.ball_in_field = ball;
    renderer.render(scene.state, 1, images);
    Vector3d in_robot = ball;
    in_robot.head<2>() = robot_from_world * Eigen::Vector2d(ball.head<2>());
    for (const Bearing& bearing : step(pipeline, images).bearings) {
      if (bearing.object != ObjectClass::ball || !bearing.clean()) continue;
      const Vector3d ray = in_robot - scene.rig.cameras[bearing.camera].position;
      const double azimuth = std::atan2(ray.y(), ray.x());
      const double elevation = std::atan2(ray.z(), ray.head<2>().norm());
      EXPECT_LT(degrees(std::abs(turn(azimuth, bearing.azimuth))), 0.03) << ball.transpose();
      EXPECT_LT(degrees(std::abs(bearing.elevation - elevation)), 0.2) << ball.transpose();
      ++seen;
    }
  }
  EXPECT_GE(seen, fewest);
}

TEST(RendererCameras, TiltedRig) {
  RenderScene scene;
  scene.state.world_from_robot = {0.3, -0.2, 0.6};
  double sign = 1.0;
  for (omni::Camera& camera : scene.rig.cameras) {
    camera.tilt_x = radians(sign * 3.0);
    camera.tilt_y = radians(-2.0);
    camera.yaw += radians(5.0);
    sign = -sign;
  }
  std::vector<Vector3d> balls;
  for (int i = 0; i < 12; ++i) {
    const double azimuth = radians(30.0 * i + 7.0);
    const double distance = 1.0 + 0.15 * i;
    balls.emplace_back(distance * std::cos(azimuth), distance * std::sin(azimuth), sim::kBallRadius);
  }
  expect_true_directions(scene, balls, 30);
}

TEST(RendererCameras, BallInTheAir) {
  RenderScene scene;
  std::vector<Vector3d> balls;
  for (int i = 0; i < 8; ++i) {
    const double azimuth = radians(45.0 * i + 7.0);
    balls.emplace_back(1.6 * std::cos(azimuth), 1.6 * std::sin(azimuth), 0.15 + 0.03 * i);
  }
  expect_true_directions(scene, balls, 20);
}

}  // namespace
}  // namespace movis
