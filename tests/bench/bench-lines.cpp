// The distance of 300 points from the nearest line, exactly and with its derivative, by the map against trying every
// line, and against a lookup in OpenCV's distance transform of the painted field (5 cm cells, no derivative). Then the
// pose from those points: from a guess, and from nowhere.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgproc.hpp>

#include "localization/line_field.h"
#include "movis/localization/line_match.h"
#include "ratio_table.h"

namespace {

using namespace movis;
using Eigen::Vector2d;

const Pose2 kWorldFromRobot{-1.2, -4.1, 0.8};

struct Scene {
  localization::FieldMap map{test::large_field()};
  std::vector<LinePoint> points;
  std::vector<Vector2d> in_world;

  Scene() {
    RandomStream random = make_stream(1, 0);
    points = test::white_points(map.field, kWorldFromRobot, 300, 6.0, 0.02, 0.1, random);
    for (const LinePoint& point : points) in_world.push_back(kWorldFromRobot * point.point);
  }
};

// Every straight line of the field by its ends, and every circle; what a localizer without a map would do.
struct EveryLine {
  struct Segment {
    Vector2d from, along;  // `along` with its length
  };
  struct Circle {
    Vector2d centre;
    double radius;
  };
  std::vector<Segment> segments;
  std::vector<Circle> circles;

  void add(double x, double y, double to_x, double to_y) { segments.push_back({{x, y}, {to_x - x, to_y - y}}); }

  explicit EveryLine(const Field& field) {
    const double h = 0.5 * field.line, w = field.half_width - h, l = field.half_length - h;
    add(-w, 0.0, w, 0.0);
    for (const double s : {-1.0, 1.0}) {
      add(s * w, -l, s * w, l);
      add(-w, s * l, w, s * l);
      for (const Field::Area& area : {field.penalty_area, field.goal_area}) {
        const double x = 0.5 * area.width - h, y = s * (field.half_length - area.depth + h);
        add(-x, y, x, y);
        add(-x, y, -x, s * l);
        add(x, y, x, s * l);
      }
      for (const double r : {-1.0, 1.0})
        circles.push_back({{r * field.half_width, s * field.half_length}, field.corner_arc});
    }
    circles.push_back({{0.0, 0.0}, field.circle});
  }

  double distance(const Vector2d& point) const {
    double nearest = 1e9;
    for (const Segment& segment : segments) {
      const Vector2d offset = point - segment.from;
      const double t = std::clamp(offset.dot(segment.along) / segment.along.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (offset - t * segment.along).norm());
    }
    for (const Circle& circle : circles)
      nearest = std::min(nearest, std::abs((point - circle.centre).norm() - circle.radius));
    return nearest;
  }
};

void require(bool right) {
  if (right) return;
  std::fprintf(stderr, "bench-lines: a contender is wrong\n");
  std::exit(1);
}

void offset_by_map(benchmark::State& state) {
  const Scene scene;
  for (auto _ : state)
    for (const Vector2d& point : scene.in_world) benchmark::DoNotOptimize(scene.map.lines.offset(point));
}
BENCHMARK(offset_by_map)->Unit(benchmark::kMicrosecond);

void every_line(benchmark::State& state) {
  const Scene scene;
  const EveryLine lines(scene.map.field);
  for (const Vector2d& point : scene.in_world)
    require(std::abs(lines.distance(point) - std::abs(scene.map.lines.offset(point).distance)) < 1e-9);
  for (auto _ : state)
    for (const Vector2d& point : scene.in_world) benchmark::DoNotOptimize(lines.distance(point));
}
BENCHMARK(every_line)->Unit(benchmark::kMicrosecond);

void opencv_distance_transform(benchmark::State& state) {
  constexpr double kCell = 0.05, kMargin = 2.0;
  const Scene scene;
  const EveryLine lines(scene.map.field);
  const double left = -scene.map.field.half_width - kMargin, bottom = -scene.map.field.half_length - kMargin;
  cv::Mat painted(static_cast<int>(-2.0 * bottom / kCell), static_cast<int>(-2.0 * left / kCell), CV_8U);
  for (int row = 0; row < painted.rows; ++row)
    for (int column = 0; column < painted.cols; ++column)
      painted.at<std::uint8_t>(row, column) =
          lines.distance({left + (column + 0.5) * kCell, bottom + (row + 0.5) * kCell}) > 0.5 * kCell ? 255 : 0;
  cv::Mat distances;
  cv::distanceTransform(painted, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const auto lookup = [&](const Vector2d& point) {
    return kCell * distances.at<float>(static_cast<int>((point.y() - bottom) / kCell),
                                       static_cast<int>((point.x() - left) / kCell));
  };
  for (const Vector2d& point : scene.in_world)
    require(std::abs(lookup(point) - std::abs(scene.map.lines.offset(point).distance)) < 2.0 * kCell);
  for (auto _ : state)
    for (const Vector2d& point : scene.in_world) benchmark::DoNotOptimize(lookup(point));
}
BENCHMARK(opencv_distance_transform)->Unit(benchmark::kMicrosecond);

void require_pose(const localization::LineFit& fit) {
  const Vector2d error = fit.fix.world_from_robot.translation() - kWorldFromRobot.translation();
  require(fit.fix.status == FixStatus::ok && error.norm() < 0.05);
}

void match_from_a_guess(benchmark::State& state) {
  const Scene scene;
  localization::LineMatchScratch scratch;
  const auto match = [&] { return match_lines(scene.points, scene.map, {-1.0, -4.3, 0.9}, {}, scratch); };
  require_pose(match());
  for (auto _ : state) benchmark::DoNotOptimize(match());
}
BENCHMARK(match_from_a_guess)->Unit(benchmark::kMicrosecond);

void find_from_nowhere(benchmark::State& state) {
  const Scene scene;
  localization::LineMatchScratch scratch;
  const auto find = [&] { return find_by_lines(scene.points, scene.map, {}, scratch); };
  require_pose(find());
  for (auto _ : state) benchmark::DoNotOptimize(find());
}
BENCHMARK(find_from_nowhere)->Unit(benchmark::kMicrosecond);

}  // namespace

int main(int argc, char** argv) {
  return movis::bench::run_and_compare(
      argc, argv, {{"offset_by_map", "every_line"}, {"offset_by_map", "opencv_distance_transform"}});
}
