#include "eye.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "sensor.h"

namespace movis::sim {
namespace {

// The camera itself with a domain that goes on a little, so that pixels on its border have their rays.
omni::Camera widened(omni::Camera camera) {
  if (auto* mirror = std::get_if<omni::Hyperboloid>(&camera.model)) mirror->rim_radius *= 1.1;
  if (auto* sphere = std::get_if<omni::UnifiedSphere>(&camera.model)) sphere->max_elevation += 0.05;
  if (auto* radial = std::get_if<omni::Radial>(&camera.model)) radial->max_radius_px *= 1.1;
  return camera;
}

// The stretches that are true. Short gaps are bridged: a stretch costs at least as much as a vector.
std::vector<Eye::Span> spans_of(const std::vector<bool>& row) {
  std::vector<Eye::Span> spans;
  for (int u = 0; u < static_cast<int>(row.size()); ++u) {
    if (!row[u]) continue;
    if (!spans.empty() && u - spans.back().end < kMostLanes) {
      spans.back().end = u + 1;
    } else {
      spans.push_back({u, u + 1});
    }
  }
  return spans;
}

}  // namespace

Eye::Eye(const omni::Rig& rig, std::size_t camera, const control::RobotModel& robot, const Look& look)
    : position(rig.cameras[camera].position.cast<float>()),
      width(rig.cameras[camera].width),
      height(rig.cameras[camera].height),
      tile_columns((width + kTile - 1) / kTile),
      tile_rows((height + kTile - 1) / kTile),
      stride((width + 1 + 2 * kMostLanes) / kMostLanes * kMostLanes),
      own(see_own_robot(rig, camera, robot, look)) {
  find_corners(rig.cameras[camera]);
  find_spans();
  for (int row = 0; row <= height; ++row) {
    const auto first = std::find_if(own.reflections.begin(), own.reflections.end(),
                                    [&](const Reflection& reflection) { return reflection.row >= row; });
    first_reflection.push_back(static_cast<std::size_t>(first - own.reflections.begin()));
  }
  for (int row = 0; row < tile_rows; ++row) {
    for (int column = 0; column < tile_columns; ++column) tiles.push_back(make_tile(column, row));
  }
}

// Where there is no ray, all pixels around are the own robot's or beside the mirror, and any ray will do.
void Eye::find_corners(const omni::Camera& camera) {
  const omni::Camera wide = widened(camera);
  const Eigen::Matrix3d robot_from_camera = camera.robot_from_camera();
  for (auto& plane : corners) plane.assign(static_cast<std::size_t>(height + 1) * stride, 0.0F);
  for (int v = 0; v <= height; ++v) {
    for (int u = 0; u < stride; ++u) {
      const auto ray = u <= width ? unproject(wide.model, Eigen::Vector2d(u - 0.5, v - 0.5)) : std::nullopt;
      const Eigen::Vector3d direction = robot_from_camera * ray.value_or(Eigen::Vector3d::UnitX());
      for (int axis = 0; axis < 3; ++axis) {
        corners[axis][static_cast<std::size_t>(v) * stride + u] = static_cast<float>(direction[axis]);
      }
    }
  }
}

void Eye::find_spans() {
  std::vector<bool> corners_of_last(static_cast<std::size_t>(width) + 1);
  for (int v = 0; v <= height; ++v) {
    std::vector<bool> is_open(width), is_floor(width), is_mirror(width), is_robot(width);
    for (int u = 0; u < width && v < height; ++u) {
      const std::size_t pixel = static_cast<std::size_t>(v) * width + u;
      const float lowest =
          std::min({corner(u, v).z(), corner(u + 1, v).z(), corner(u, v + 1).z(), corner(u + 1, v + 1).z()});
      is_mirror[u] = !own.outside[pixel];
      is_robot[u] = is_mirror[u] && own.open[pixel] < 1.0F;
      is_open[u] = own.open[pixel] > 0.0F;
      is_floor[u] = is_open[u] && lowest < 0.0F;
    }
    const std::vector<Span> floor_of_row = spans_of(is_floor);
    std::vector<bool> corners_of_row(corners_of_last.size());
    for (const Span& span : floor_of_row) {
      std::fill(corners_of_row.begin() + span.begin, corners_of_row.begin() + span.end + 1, true);
    }
    std::vector<bool> corners_needed(corners_of_row.size());
    std::transform(corners_of_row.begin(), corners_of_row.end(), corners_of_last.begin(), corners_needed.begin(),
                   std::logical_or<>());
    floor_corners.push_back(spans_of(corners_needed));
    corners_of_last = corners_of_row;
    if (v == height) break;
    open.push_back(spans_of(is_open));
    floor.push_back(floor_of_row);
    own_robot.push_back(spans_of(is_robot));
    const std::vector<Span> within = spans_of(is_mirror);
    mirror.push_back(within.empty() ? Span{} : Span{within.front().begin, within.back().end});
  }
}

Eye::Tile Eye::make_tile(int column, int row) const {
  const int left = column * kTile;
  const int top = row * kTile;
  const int right = std::min(left + kTile, width);
  const int bottom = std::min(top + kTile, height);
  Tile tile;
  for (int v = top; v < bottom; ++v) {
    for (int u = left; u < right; ++u) {
      tile.hidden = tile.hidden && own.open[static_cast<std::size_t>(v) * width + u] == 0.0F;
    }
  }
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) sum += corner(u, v);
  }
  tile.bounds = {std::atan2(sum.y(), sum.x()), 0.0F, std::asin(sum.normalized().z()), std::asin(sum.normalized().z())};
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) tile.bounds.include(corner(u, v));
  }
  return tile;
}

}  // namespace movis::sim
