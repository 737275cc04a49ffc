// One ball from the bearings of three cameras, by pairs and jointly, with covariance, against the usual two-view
// triangulation of one pair: OpenCV's triangulatePoints and the same linear method (DLT) with Eigen's SVD. The peers
// get two views of the same ball in virtual perspective cameras that look along the robot's y; they give no covariance.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cstdio>
#include <cstdlib>
#include <opencv2/calib3d.hpp>

#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "movis/triangulation/joint.h"
#include "movis/triangulation/pairs.h"
#include "ratio_table.h"

namespace {

using namespace movis;
using Eigen::Vector3d;

const Vector3d kBall(0.3, 2.0, 0.11);

struct Scene {
  omni::Rig rig = omni::read_rig(data_file("rigs/movis.yaml"));
  std::vector<Bearing> bearings;

  Scene() {
    for (int i = 0; i < static_cast<int>(rig.cameras.size()); ++i) {
      const Vector3d ray = kBall - rig.cameras[i].position;
      Bearing bearing;
      bearing.camera = i;
      bearing.azimuth = std::atan2(ray.y(), ray.x());
      bearing.elevation = std::atan2(ray.z(), ray.head<2>().norm());
      bearing.covariance = std::pow(radians(0.01), 2) * Eigen::Matrix2d::Identity();
      bearings.push_back(bearing);
    }
  }
};

// The view of camera i with its z axis along the robot's y, x along x, y down.
struct View {
  Eigen::Matrix<double, 3, 4> projection;
  Eigen::Vector2d image;
};

View view_of(const Scene& scene, int i) {
  Eigen::Matrix3d view_from_robot;
  view_from_robot << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  View view;
  view.projection << view_from_robot, -view_from_robot * scene.rig.cameras[i].position;
  const Vector3d seen = view_from_robot * (kBall - scene.rig.cameras[i].position);
  view.image = seen.hnormalized();
  return view;
}

void require_ball(const Vector3d& point) {
  if ((point - kBall).norm() < 1e-6) return;
  std::fprintf(stderr, "bench-triangulation: a contender finds the ball %.3g m off\n", (point - kBall).norm());
  std::exit(1);
}

void triangulate_pairs(benchmark::State& state) {
  const Scene scene;
  require_ball(triangulation::triangulate_pairs(scene.rig, scene.bearings, ObjectClass::ball).point);
  for (auto _ : state) {
    benchmark::DoNotOptimize(triangulation::triangulate_pairs(scene.rig, scene.bearings, ObjectClass::ball));
  }
}
BENCHMARK(triangulate_pairs)->Unit(benchmark::kMicrosecond);

void triangulate_joint(benchmark::State& state) {
  const Scene scene;
  require_ball(triangulation::triangulate_joint(scene.rig, scene.bearings, ObjectClass::ball).point);
  for (auto _ : state) {
    benchmark::DoNotOptimize(triangulation::triangulate_joint(scene.rig, scene.bearings, ObjectClass::ball));
  }
}
BENCHMARK(triangulate_joint)->Unit(benchmark::kMicrosecond);

// Three cameras of which one sees another ball: what is read where they do not agree.
void triangulate_joint_outlier(benchmark::State& state) {
  Scene scene;
  scene.bearings[2].azimuth += radians(10.0);
  require_ball(triangulation::triangulate_joint(scene.rig, scene.bearings, ObjectClass::ball).point);
  for (auto _ : state) {
    benchmark::DoNotOptimize(triangulation::triangulate_joint(scene.rig, scene.bearings, ObjectClass::ball));
  }
}
BENCHMARK(triangulate_joint_outlier)->Unit(benchmark::kMicrosecond);

void opencv_triangulate_points(benchmark::State& state) {
  const Scene scene;
  cv::Mat projections[2];
  cv::Mat images[2];
  for (int i = 0; i < 2; ++i) {
    const View view = view_of(scene, i);
    projections[i] = cv::Mat(3, 4, CV_64F);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 4; ++c) projections[i].at<double>(r, c) = view.projection(r, c);
    }
    images[i] = (cv::Mat_<double>(2, 1) << view.image.x(), view.image.y());
  }
  cv::Mat point;
  for (auto _ : state) {
    cv::triangulatePoints(projections[0], projections[1], images[0], images[1], point);
    benchmark::DoNotOptimize(point.data);
  }
  const double w = point.at<double>(3);
  require_ball(Vector3d(point.at<double>(0), point.at<double>(1), point.at<double>(2)) / w);
}
BENCHMARK(opencv_triangulate_points)->Unit(benchmark::kMicrosecond);

void eigen_svd(benchmark::State& state) {
  const Scene scene;
  const View views[] = {view_of(scene, 0), view_of(scene, 1)};
  Eigen::Vector4d point;
  for (auto _ : state) {
    Eigen::Matrix4d equations;
    for (int i = 0; i < 2; ++i) {
      equations.row(2 * i) = views[i].image.x() * views[i].projection.row(2) - views[i].projection.row(0);
      equations.row(2 * i + 1) = views[i].image.y() * views[i].projection.row(2) - views[i].projection.row(1);
    }
    point = Eigen::JacobiSVD<Eigen::Matrix4d>(equations, Eigen::ComputeFullV).matrixV().col(3);
    benchmark::DoNotOptimize(point);
  }
  require_ball(point.hnormalized());
}
BENCHMARK(eigen_svd)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  return movis::bench::run_and_compare(argc, argv,
                                       {{"triangulate_pairs", "opencv_triangulate_points"},
                                        {"triangulate_pairs", "eigen_svd"},
                                        {"triangulate_joint", "opencv_triangulate_points"},
                                        {"triangulate_joint", "eigen_svd"}});
}
