#include "panels.h"

#include <algorithm>
#include <limits>

namespace movis::sim {
namespace {

constexpr double kThinnest = 0.004;      // metres; a thinner wall could not be told from none
constexpr double kWallThickness = 0.02;  // metres, outwards

}  // namespace

std::vector<Panel> goal_panels(const Field& field) {
  const double thickness = std::max(field.goal_thickness, kThinnest);
  std::vector<Panel> panels;
  for (const double end : {1.0, -1.0}) {
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector2d centre(side * (field.Fw + thickness / 2.0), end * (field.Fd + field.goal_depth / 2.0));
      panels.push_back({centre, {thickness / 2.0, field.goal_depth / 2.0}, field.goal_height});
    }
    panels.push_back({{0.0, end * (field.Fd + field.goal_depth)}, {field.Fw, kBackPanel / 2.0}, field.goal_height});
  }
  return panels;
}

std::vector<Panel> wall_panels(const Arena& arena) {
  if (!arena.wall || !arena.field) return {};
  const double half = kWallThickness / 2.0;
  const double x = arena.field->half_width + arena.wall->distance + half;  // of the walls' middle lines
  const double y = arena.field->half_length + arena.wall->distance + half;
  const double height = arena.wall->height;
  return {{{x, 0.0}, {half, y + half}, height},
          {{-x, 0.0}, {half, y + half}, height},
          {{0.0, y}, {x + half, half}, height},
          {{0.0, -y}, {x + half, half}, height}};
}

double distance(const std::vector<Panel>& panels, const Eigen::Vector2d& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Panel& panel : panels) {
    const Eigen::Vector2d beyond = ((point - panel.centre).cwiseAbs() - panel.half).cwiseMax(0.0);
    nearest = std::min(nearest, beyond.norm());
  }
  return nearest;
}

}  // namespace movis::sim
