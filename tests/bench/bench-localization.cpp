// The pose from two goals, with covariance. The paper's methods against the closed-form alignment of the same landmarks by
// Eigen's umeyama (four posts, rotation and translation), which gives no covariance; robust least squares on the edges'
// azimuths from a guess against Eigen's Levenberg-Marquardt on the same residuals, with numeric derivatives and neither
// robust loss nor covariance. Then robust least squares with 300 line points, and from no guess.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "localization/line_field.h"
#include "movis/core/paths.h"
#include "movis/localization/goal_silhouette.h"
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

// What three cameras see of both goals, and points on the lines.
struct Sights {
  localization::FieldMap map;
  omni::Rig rig;
  std::vector<Bearing> bearings;
  triangulation::GoalLandmarks goals;
  std::vector<LinePoint> lines;

  Sights(const char* field, int line_points) : map(read_field(data_file(field))) {
    for (const Vector2d& place : {Vector2d(-0.173, 0.1), Vector2d(0.173, 0.1), Vector2d(0.0, -0.2)}) {
      const int camera = static_cast<int>(rig.cameras.size());
      rig.cameras.emplace_back();
      rig.cameras.back().position = {place.x(), place.y(), 0.25};
      for (const ObjectClass goal : {ObjectClass::yellow_goal, ObjectClass::blue_goal}) {
        const auto seen = localization::goal_silhouette(map.field, goal, kWorldFromRobot * place);
        Bearing bearing;
        bearing.camera = camera;
        bearing.object = goal;
        bearing.left = wrap_angle(seen.left - kWorldFromRobot.beta);
        bearing.right = wrap_angle(seen.right - kWorldFromRobot.beta);
        bearing.left_variance = bearing.right_variance = 1e-7;
        bearings.push_back(bearing);
      }
    }
    if (line_points == 0) return;
    RandomStream random = make_stream(1, 0);
    lines = test::white_points(map.field, kWorldFromRobot, line_points, 3.0, 0.005, 0.05, random);
  }
  localization::Instant instant() const { return {rig, bearings, goals, lines}; }
};

const Pose2 kGuess{0.7, -0.6, 0.9};

void nls_from_guess(benchmark::State& state, int line_points) {
  const Sights sights("fields/paper.yaml", line_points);
  Fix fix;
  for (auto _ : state) {
    fix = localization::nls_from(kGuess, sights.instant(), sights.map, {});
    benchmark::DoNotOptimize(fix);
  }
  if (fix.status != FixStatus::ok || (fix.world_from_robot.translation() - kWorldFromRobot.translation()).norm() > 0.01)
    require_pose({});
}
BENCHMARK_CAPTURE(nls_from_guess, edges, 0)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(nls_from_guess, with_300_line_points, 300)->Unit(benchmark::kMicrosecond);

void nls_from_nowhere(benchmark::State& state, const char* field) {
  const Sights sights(field, 0);
  Fix fix;
  for (auto _ : state) {
    fix = localization::nls(sights.instant(), sights.map, {});
    benchmark::DoNotOptimize(fix);
  }
  require_pose(fix.world_from_robot.translation());
}
BENCHMARK_CAPTURE(nls_from_nowhere, paper, "fields/paper.yaml")->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(nls_from_nowhere, msl_12x8, "fields/msl-12x8.yaml")->Unit(benchmark::kMicrosecond);

struct EdgeResiduals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };
  const Sights& sights;

  int inputs() const { return 3; }
  int values() const { return 2 * static_cast<int>(sights.bearings.size()); }
  int operator()(const InputType& pose, ValueType& residuals) const {
    const Pose2 world_from_robot{pose[0], pose[1], pose[2]};
    int i = 0;
    for (const Bearing& bearing : sights.bearings) {
      const Vector2d at = sights.rig.cameras[bearing.camera].position.head<2>();
      const auto seen = localization::goal_silhouette(sights.map.field, bearing.object, world_from_robot * at);
      residuals[i++] = turn(seen.left - pose[2], bearing.left);
      residuals[i++] = turn(seen.right - pose[2], bearing.right);
    }
    return 0;
  }
};

void eigen_levenberg_marquardt(benchmark::State& state) {
  const Sights sights("fields/paper.yaml", 0);
  Eigen::VectorXd pose(3);
  for (auto _ : state) {
    pose << kGuess.x, kGuess.y, kGuess.beta;
    Eigen::NumericalDiff<EdgeResiduals> residuals(EdgeResiduals{sights});
    Eigen::LevenbergMarquardt<Eigen::NumericalDiff<EdgeResiduals>> solver(residuals);
    solver.minimize(pose);
    benchmark::DoNotOptimize(pose);
  }
  require_pose(pose.head<2>());
}
BENCHMARK(eigen_levenberg_marquardt)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  return movis::bench::run_and_compare(argc, argv,
                                       {{"localize/method1", "eigen_umeyama"},
                                        {"localize/method2", "eigen_umeyama"},
                                        {"localize/composed", "eigen_umeyama"},
                                        {"nls_from_guess/edges", "eigen_levenberg_marquardt"}});
}
