// The pose from two goals, with covariance, against the closed-form alignment of the same landmarks by Eigen's umeyama
// (four posts, rotation and translation), which gives no covariance.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>

#include "movis/core/paths.h"
#include "movis/localization/localizer.h"
#include "ratio_table.h"

namespace {

using namespace movis;
using Eigen::Vector2d;

const Pose2 kWorldFromRobot{0.4, -0.3, 0.7};

struct Scene {
  Field field = read_field(data_file("fields/paper.yaml"));
  triangulation::GoalLandmarks landmarks;
  omni::Rig rig;
  std::vector<Bearing> bearings;
  std::vector<LinePoint> lines;

  Scene() {
    const double w = field.Fw + field.goal_thickness;
    landmarks.yellow = goal({0.0, field.Fd}, {-w, field.Fd}, {w, field.Fd});
    landmarks.blue = goal({0.0, -field.Fd}, {w, -field.Fd}, {-w, -field.Fd});
  }

  static triangulation::GoalPoints goal(const Vector2d& centre, const Vector2d& left, const Vector2d& right) {
    const Pose2 robot_from_world = inverse(kWorldFromRobot);
    triangulation::GoalPoints points;
    points.centre_status = points.edges_status = PointStatus::ok;
    points.centre = robot_from_world * centre;
    points.left = robot_from_world * left;
    points.right = robot_from_world * right;
    points.covariance = 1e-6 * triangulation::GoalPoints::Covariance::Identity();
    return points;
  }
};

void require_pose(const Vector2d& position) {
  if ((position - kWorldFromRobot.translation()).norm() < 1e-6) return;
  std::fprintf(stderr, "bench-localization: a contender is wrong\n");
  std::exit(1);
}

void localize(benchmark::State& state, const char* name) {
  const Scene scene;
  const localization::Localizer localizer = localization::find_localizer(name);
  const localization::FieldMap map(scene.field);
  const localization::Instant instant{scene.rig, scene.bearings, scene.landmarks, scene.lines};
  require_pose(localizer.fix(instant, map, {}).world_from_robot.translation());
  for (auto _ : state) benchmark::DoNotOptimize(localizer.fix(instant, map, {}));
}
BENCHMARK_CAPTURE(localize, method1, "method1")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(localize, method2, "method2")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(localize, composed, "composed")->Unit(benchmark::kMicrosecond);

void eigen_umeyama(benchmark::State& state) {
  const Scene scene;
  const double w = scene.field.Fw + scene.field.goal_thickness;
  Eigen::Matrix2Xd in_robot(2, 4), in_world(2, 4);
  in_robot << scene.landmarks.yellow.left, scene.landmarks.yellow.right, scene.landmarks.blue.left,
      scene.landmarks.blue.right;
  in_world << -w, w, w, -w, scene.field.Fd, scene.field.Fd, -scene.field.Fd, -scene.field.Fd;
  Eigen::Matrix3d world_from_robot;
  for (auto _ : state) {
    world_from_robot = Eigen::umeyama(in_robot, in_world, false);
    benchmark::DoNotOptimize(world_from_robot);
  }
  require_pose(world_from_robot.topRightCorner<2, 1>());
}
BENCHMARK(eigen_umeyama)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  return movis::bench::run_and_compare(argc, argv,
                                       {{"localize/method1", "eigen_umeyama"},
                                        {"localize/method2", "eigen_umeyama"},
                                        {"localize/composed", "eigen_umeyama"}});
}
