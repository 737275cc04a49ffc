// What stands in an arena is where it should be in the picture, in its colour: pixels chosen by projecting a point.
#include <gtest/gtest.h>

#include "movis/core/angle.h"
#include "render_scene.h"

namespace movis {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using test::RenderScene;
using test::shows;

RenderScene field_scene() {
  RenderScene scene;
  scene.arena.field = read_field(data_file("fields/paper.yaml"));
  return scene;
}

Vector3d on_floor(const Vector2d& point) {
  return {point.x(), point.y(), 0.0};
}

TEST(RendererArena, YellowGoalAheadBlueGoalBehind) {
  const RenderScene scene = field_scene();
  const grab::FrameSet images = scene.images();
  EXPECT_TRUE(shows(light_of(scene, images, {0.1, 2.25, 0.3}), scene.look.yellow_goal));
  EXPECT_TRUE(shows(light_of(scene, images, {0.1, -2.25, 0.3}), scene.look.blue_goal));
}

TEST(RendererArena, WhiteGoals) {
  RenderScene scene = field_scene();
  scene.arena.field->goals = Field::Goals::white;
  scene.look.hall = scene.look.hull;  // or white would not be told from the hall
  const grab::FrameSet images = scene.images();
  for (const double y : {2.25, -2.25}) {
    EXPECT_TRUE(shows(light_of(scene, images, {0.1, y, 0.3}), scene.look.white_goal));
  }
}

TEST(RendererArena, Wall) {
  RenderScene scene = field_scene();
  scene.arena.wall = sim::Wall{0.6, 0.3};
  scene.look.wall = scene.look.magenta;
  const grab::FrameSet images = scene.images();
  for (const Vector2d& foot : {Vector2d(2.35, 0.3), Vector2d(-2.35, -0.3), Vector2d(1.2, 2.6), Vector2d(1.2, -2.6)}) {
    const auto at = [&](double z) { return light_of(scene, images, {foot.x(), foot.y(), z}); };
    EXPECT_TRUE(shows(at(0.15), scene.look.wall)) << foot.transpose();
    EXPECT_TRUE(shows(at(0.40), scene.look.hall)) << foot.transpose();
  }
}

TEST(RendererArena, ObstaclesWithBands) {
  RenderScene scene = field_scene();
  using Band = sim::Obstacle::Band;
  for (const Band band : {Band::cyan, Band::magenta, Band::none}) {
    scene.arena.obstacles = {{{0.6, 1.3}, 0.15, 0.5, band, 0.25, 0.35}};
    const grab::FrameSet images = scene.images();
    const Vector2d side = Vector2d(0.6, 1.3) - 0.15 * Vector2d(0.6, 1.3).normalized();  // towards the robot
    const auto at = [&](double z) { return light_of(scene, images, {side.x(), side.y(), z}); };
    EXPECT_TRUE(shows(at(0.15), scene.look.hull));
    EXPECT_TRUE(shows(at(0.42), scene.look.hull));
    EXPECT_TRUE(shows(at(0.30), band == Band::cyan      ? scene.look.cyan
                                : band == Band::magenta ? scene.look.magenta
                                                        : scene.look.hull));
  }
}

TEST(RendererArena, TheNearerHidesTheFarther) {
  RenderScene scene = field_scene();
  scene.look.light.gloss = 0.0F;  // or the ball is nearly white there
  const Vector3d on_goal(0.0, 2.24, 0.15);
  EXPECT_TRUE(shows(light_of(scene, scene.images(), on_goal), scene.look.yellow_goal));
  scene.state.ball_in_field = {0.0, 1.3, 0.18};
  EXPECT_TRUE(shows(light_of(scene, scene.images(), on_goal), scene.look.ball));
  scene.arena.obstacles = {{{0.0, 0.8}, 0.2, 0.4}};
  EXPECT_TRUE(shows(light_of(scene, scene.images(), on_goal), scene.look.hull));
}

// A point on a line of a field with everything on it, and the way to where the grass is.
struct LinePoint {
  const char* name;
  Vector2d point;
  Vector2d to_grass;
};

TEST(RendererArena, LinesOfALargeField) {
  RenderScene scene;
  Field field;
  field.half_width = 6.0;
  field.half_length = field.Fd = 9.0;
  field.circle = 2.0;
  field.line = 0.125;
  field.Fw = 1.2;
  field.goal_height = 1.0;
  field.goal_depth = 0.5;
  field.goal_thickness = 0.05;
  field.goals = Field::Goals::white;
  field.penalty_area = {2.25, 6.9};
  field.goal_area = {0.75, 3.9};
  field.corner_arc = 0.75;
  scene.arena.field = field;
  scene.look.hall_half_width = 15.0;
  const double half = field.line / 2.0;
  const double r = std::sqrt(0.5);
  const Vector2d corner(6.0 - 0.75 * r, 9.0 - 0.75 * r);
  const std::vector<LinePoint> points{
      {"side line", {6.0 - half, 4.0}, {-1.0, 0.0}},
      {"goal line", {2.5, 9.0 - half}, {0.0, -1.0}},
      {"centre line", {4.0, 0.0}, {0.0, 1.0}},
      {"centre circle", {2.0 * r, 2.0 * r}, {-r, -r}},
      {"penalty area, front", {0.8, 9.0 - 2.25 + half}, {0.0, 1.0}},
      {"penalty area, side", {3.45 - half, 7.9}, {-1.0, 0.0}},
      {"goal area, front", {0.8, 9.0 - 0.75 + half}, {0.0, -1.0}},
      {"goal area, side", {1.95 - half, 8.6}, {1.0, 0.0}},
      {"corner arc", corner, {-r, -r}},
  };
  sim::Renderer renderer(scene.rig, scene.arena, scene.robot, scene.look);
  grab::FrameSet images;
  for (const double end : {1.0, -1.0}) {
    for (const LinePoint& line : points) {
      const Vector2d point(line.point.x(), end * line.point.y());
      const Vector2d grass = point + 0.25 * Vector2d(line.to_grass.x(), end * line.to_grass.y());
      const Vector2d robot = point - 0.8 * point.normalized();
      scene.state.world_from_robot = {robot.x(), robot.y(), 0.7};
      scene.state.ball_in_field = {-3.0, -1.0, sim::kBallRadius};
      renderer.render(scene.state, 1, images);
      EXPECT_TRUE(shows(light_of(scene, images, on_floor(point)), scene.look.line)) << line.name << " " << end;
      EXPECT_TRUE(shows(light_of(scene, images, on_floor(grass)), scene.look.floor)) << line.name << " " << end;
    }
  }
}

TEST(RendererArena, FloorMarginThenSurround) {
  RenderScene scene = field_scene();
  scene.look.floor_margin = 0.4;
  scene.state.world_from_robot = {1.2, 0.0, 0.0};
  scene.state.ball_in_field = {-1.0, 0.0, sim::kBallRadius};
  const grab::FrameSet images = scene.images();
  EXPECT_TRUE(shows(light_of(scene, images, {1.75 + 0.3, 0.5, 0.0}), scene.look.floor));
  EXPECT_TRUE(shows(light_of(scene, images, {1.75 + 0.5, 0.5, 0.0}), scene.look.surround));
}

}  // namespace
}  // namespace movis
