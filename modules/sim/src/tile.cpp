#include "tile.h"

#include <algorithm>
#include <cmath>

namespace movis::sim {
namespace {

constexpr int kFaces = 8;    // room for the faces of one body
constexpr int kSamples = 3;  // along each side of a pixel on an edge

void put(const LightRowsOut& light, int u, int v, const Colour& colour) {
  for (int channel = 0; channel < 3; ++channel) light.rows[channel][v][u] = colour[channel];
}

}  // namespace

TilePainter::TilePainter(const Eye& eye, const Standpoint& standpoint, const Stage& stage, TileScratch& scratch)
    : eye_(eye), standpoint_(standpoint), stage_(stage), bounds_(scratch.bounds), near_(scratch.near) {
  bounds_.clear();
  const float beta = std::atan2(standpoint.sine, standpoint.cosine);
  for (const Prop& prop : stage.props) {
    bounds_.push_back(bounds_of(prop, standpoint.origin));
    bounds_.back().azimuth -= beta;
  }
  near_.reserve(stage.props.size());
}

void TilePainter::find_near_props(const Eye::Tile& tile) {
  near_.clear();
  for (std::size_t i = 0; i < bounds_.size(); ++i) {
    if (bounds_[i].meets(tile.bounds)) near_.push_back(&stage_.props[i]);
  }
}

TilePainter::Seen TilePainter::look(const Ray& ray) const {
  Seen seen;
  Hit hit{};
  for (int i = 0; i < static_cast<int>(near_.size()); ++i) {
    if (!intersect(*near_[i], ray, hit)) continue;
    if (seen.prop != nullptr && hit.distance >= seen.hit.distance) continue;
    seen = {kFaces * i + hit.face, near_[i], hit};
  }
  return seen;
}

Colour TilePainter::colour(const Ray& ray, const Seen& seen) const {
  if (seen.prop == nullptr) return stage_.hall.colour(ray, stage_.shadows);
  return colour_of(*seen.prop, ray, seen.hit, stage_.hall.light());
}

Colour TilePainter::sampled(int corner) const {
  const Eigen::Vector3f* above = &rays_[corner];
  const Eigen::Vector3f* below = above + kCorners;
  Colour sum = Colour::Zero();
  for (int j = 0; j < kSamples; ++j) {
    const float v = (static_cast<float>(j) + 0.5F) / kSamples;
    const Eigen::Vector3f left = above[0] + v * (below[0] - above[0]);
    const Eigen::Vector3f right = above[1] + v * (below[1] - above[1]);
    for (int i = 0; i < kSamples; ++i) {
      const float u = (static_cast<float>(i) + 0.5F) / kSamples;
      const Ray ray{standpoint_.origin, (left + u * (right - left)).normalized()};
      sum += colour(ray, look(ray));
    }
  }
  return sum / (kSamples * kSamples);
}

// A pixel that is not all background.
Colour TilePainter::pixel(int corner) const {
  const int face = faces_[corner];
  const bool even =
      face == faces_[corner + 1] && face == faces_[corner + kCorners] && face == faces_[corner + kCorners + 1];
  if (!even) return sampled(corner);
  const Eigen::Vector3f middle =
      rays_[corner] + rays_[corner + 1] + rays_[corner + kCorners] + rays_[corner + kCorners + 1];
  const Ray ray{standpoint_.origin, middle.normalized()};
  const Prop& prop = *near_[face / kFaces];
  Hit hit{};
  if (!intersect(prop, ray, hit)) return sampled(corner);
  return colour_of(prop, ray, hit, stage_.hall.light());
}

void TilePainter::paint_props(int left, int top, int columns, int rows, const LightRowsOut& light) {
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u <= columns; ++u) {
      const int corner = v * kCorners + u;
      rays_[corner] = standpoint_.to_field(eye_.corner(left + u, top + v));
      faces_[corner] = look({standpoint_.origin, rays_[corner]}).face;
    }
  }
  for (int v = 0; v < rows; ++v) {
    for (int u = 0; u < columns; ++u) {
      const int corner = v * kCorners + u;
      const int nearest =
          std::max({faces_[corner], faces_[corner + 1], faces_[corner + kCorners], faces_[corner + kCorners + 1]});
      if (nearest != kBackground) put(light, left + u, v, pixel(corner));
    }
  }
}

void TilePainter::paint(int column, int row, const LightRowsOut& light) {
  const Eye::Tile& tile = eye_.tiles[static_cast<std::size_t>(row) * eye_.tile_columns + column];
  if (tile.hidden) return;
  find_near_props(tile);
  if (near_.empty()) return;
  const int left = column * kTile;
  const int top = row * kTile;
  const int columns = std::min(kTile, eye_.width - left);
  const int rows = std::min(kTile, eye_.height - top);
  paint_props(left, top, columns, rows, light);
}

}  // namespace movis::sim
