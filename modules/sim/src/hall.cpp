#include "hall.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "light.h"
#include "movis/core/random.h"

namespace movis::sim {
namespace {

constexpr double kFineCell = 0.01;  // metres
constexpr double kCoarseCell = 0.05;
constexpr float kGrain = 0.03F;  // of the floor's brightness from cell to cell, relative

// The line that a Y-symmetric area before a goal draws: inside the outer edge, not inside the inner one.
bool on_area(const Field& field, const Field::Area& area, double x, double y) {
  if (area.depth <= 0.0) return false;
  const double u = std::abs(x) - 0.5 * area.width;                // outside the area's side, metres
  const double v = field.half_length - area.depth - std::abs(y);  // outside its front
  const double outside = std::max(u, v);
  return outside <= 0.0 && outside > -field.line && std::abs(y) < field.half_length;
}

bool on_line(const Field& field, double x, double y) {
  const double beyond = std::max(std::abs(x) - field.half_width, std::abs(y) - field.half_length);
  if (beyond > 0.0) return false;
  if (beyond > -field.line || std::abs(y) < 0.5 * field.line) return true;
  if (std::abs(std::hypot(x, y) - field.circle) < 0.5 * field.line) return true;
  const double corner = std::hypot(std::abs(x) - field.half_width, std::abs(y) - field.half_length);
  if (field.corner_arc > 0.0 && std::abs(corner - field.corner_arc) < 0.5 * field.line) return true;
  return on_area(field, field.penalty_area, x, y) || on_area(field, field.goal_area, x, y);
}

const Colour& surface(const Arena& arena, const Look& look, double x, double y) {
  if (!arena.field) return look.floor;
  const Field& field = *arena.field;
  if (on_line(field, x, y)) return look.line;
  const double beyond = std::max(std::abs(x) - field.half_width, std::abs(y) - field.half_length);
  return beyond < look.floor_margin ? look.floor : look.surround;
}

std::int32_t packed(float red, float green) {
  const auto fraction = [](float light) {
    return static_cast<std::uint32_t>(std::lround(65535.0F * std::min(light / Hall::kFullLight, 1.0F)));
  };
  return static_cast<std::int32_t>(fraction(red) << 16 | fraction(green));
}

// The part of the light that shadows leave at a point.
float left_by(const std::vector<Shadow>& shadows, const Eigen::Vector2f& point) {
  float light = 1.0F;
  for (const Shadow& shadow : shadows) {
    const float inside = 1.0F - (point - shadow.centre).squaredNorm() / (shadow.reach * shadow.reach);
    if (inside > 0.0F) light *= 1.0F - shadow.strength * inside * inside;
  }
  return light;
}

Hall::Grid make_grid(double half_width, double half_length, double cell) {
  Hall::Grid grid;
  grid.cells_per_metre = static_cast<float>(1.0 / cell);
  grid.left = static_cast<float>(-half_width);
  grid.bottom = static_cast<float>(-half_length);
  grid.columns = static_cast<int>(std::ceil(2.0 * half_width / cell));
  grid.rows = static_cast<int>(std::ceil(2.0 * half_length / cell));
  return grid;
}

// The cell's place in the planes, or −1 outside the grid.
int cell_of(const Hall::Grid& grid, float x, float y) {
  const float column = std::floor((x - grid.left) * grid.cells_per_metre);
  const float row = std::floor((y - grid.bottom) * grid.cells_per_metre);
  if (!(column >= 0.0F && row >= 0.0F)) return -1;
  if (column >= static_cast<float>(grid.columns) || row >= static_cast<float>(grid.rows)) return -1;
  return grid.first + static_cast<int>(row) * grid.columns + static_cast<int>(column);
}

}  // namespace

Hall::Hall(const Arena& arena, const Look& look)
    : half_width_(static_cast<float>(look.hall_half_width)), light_(look.light), wall_(look.hall) {
  constexpr double kMargin = 0.1;  // of the fine grid beyond the floor's margin
  const double margin = look.floor_margin + kMargin;
  if (arena.field) {
    field_ = make_grid(arena.field->half_width + margin, arena.field->half_length + margin, kFineCell);
    paint(field_, arena, look, 4);
  }
  around_ = make_grid(look.hall_half_width, look.hall_half_width, kCoarseCell);
  around_.first = static_cast<int>(blue_.size());
  paint(around_, arena, look, 1);
}

void Hall::paint(const Grid& grid, const Arena& arena, const Look& look, int samples) {
  RandomStream random = make_stream(1, 0);  // the floor is the same one in every run
  std::normal_distribution<float> grain(1.0F, kGrain);
  const float cell = 1.0F / grid.cells_per_metre;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      Colour sum = Colour::Zero();
      for (int v = 0; v < samples; ++v) {
        const double y = grid.bottom + cell * (row + (v + 0.5) / samples);
        for (int u = 0; u < samples; ++u)
          sum += surface(arena, look, grid.left + cell * (column + (u + 0.5) / samples), y);
      }
      const Eigen::Vector3f centre(grid.left + cell * (static_cast<float>(column) + 0.5F),
                                   grid.bottom + cell * (static_cast<float>(row) + 0.5F), 0.0F);
      const float light = shade(light_, centre, Eigen::Vector3f::UnitZ()) * grain(random);
      const Colour mean = sum * (light / static_cast<float>(samples * samples));
      red_green_.push_back(packed(mean[0], mean[1]));
      blue_.push_back(mean[2]);
    }
  }
}

Colour Hall::colour(const Ray& ray, const std::vector<Shadow>& shadows) const {
  if (ray.direction.z() < 0.0F) {
    const float distance = -ray.origin.z() / ray.direction.z();
    const Eigen::Vector2f point = (ray.origin + distance * ray.direction).head<2>();
    int cell = cell_of(field_, point.x(), point.y());
    if (cell < 0) cell = cell_of(around_, point.x(), point.y());
    if (cell >= 0) {
      const auto word = static_cast<std::uint32_t>(red_green_[cell]);
      const float red = static_cast<float>(word >> 16) * (kFullLight / 65535.0F);
      const float green = static_cast<float>(word & 0xFFFF) * (kFullLight / 65535.0F);
      return Colour(red, green, blue_[cell], 0.0F) * left_by(shadows, point);
    }
  }
  const float to_x = (std::copysign(half_width_, ray.direction.x()) - ray.origin.x()) / ray.direction.x();
  const float to_y = (std::copysign(half_width_, ray.direction.y()) - ray.origin.y()) / ray.direction.y();
  const Eigen::Vector3f point = ray.origin + std::min(to_x, to_y) * ray.direction;
  const Eigen::Vector3f normal = to_x < to_y ? Eigen::Vector3f(std::copysign(1.0F, -ray.direction.x()), 0.0F, 0.0F)
                                             : Eigen::Vector3f(0.0F, std::copysign(1.0F, -ray.direction.y()), 0.0F);
  return wall_ * shade(light_, point, normal);
}

}  // namespace movis::sim
