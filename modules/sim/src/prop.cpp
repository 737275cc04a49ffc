#include "prop.h"

#include <cmath>
#include <limits>

#include "light.h"
#include "panels.h"

namespace movis::sim {
namespace {

constexpr float kPiF = 3.14159265F;

// Slabs (T. L. Kay, J. T. Kajiya, Ray tracing complex scenes, SIGGRAPH 1986). A zero component divides to ±infinity,
// which compares as it should.
bool intersect_box(const Prop& box, const Ray& ray, Hit& hit) {
  float enter = 0.0F;
  float leave = std::numeric_limits<float>::max();
  int axis = -1;
  for (int i = 0; i < 3; ++i) {
    const float inverse = 1.0F / ray.direction[i];
    const float low = (box.low[i] - ray.origin[i]) * inverse;
    const float high = (box.high[i] - ray.origin[i]) * inverse;
    const float near = std::min(low, high);
    if (near > enter) {
      enter = near;
      axis = i;
    }
    leave = std::min(leave, std::max(low, high));
  }
  if (axis < 0 || enter >= leave) return false;
  const bool from_above = ray.direction[axis] < 0.0F;
  hit.distance = enter;
  hit.normal.setZero();
  hit.normal[axis] = from_above ? 1.0F : -1.0F;
  hit.face = 2 * axis + (from_above ? 1 : 0);
  return true;
}

bool intersect_ball(const Prop& ball, const Ray& ray, Hit& hit) {
  const Eigen::Vector3f to_centre = ball.centre - ray.origin;
  const float along = to_centre.dot(ray.direction);
  const float inside = along * along - to_centre.squaredNorm() + ball.radius * ball.radius;
  if (along <= 0.0F || inside <= 0.0F) return false;
  hit.distance = along - std::sqrt(inside);
  if (hit.distance <= 0.0F) return false;
  hit.normal = (ray.direction * hit.distance - to_centre) / ball.radius;
  hit.face = 0;
  return true;
}

bool intersect_top(const Prop& cylinder, const Ray& ray, Hit& hit) {
  const float distance = (cylinder.height - ray.origin.z()) / ray.direction.z();
  if (!(distance > 0.0F)) return false;
  const Eigen::Vector2f at = (ray.origin + distance * ray.direction).head<2>() - cylinder.centre.head<2>();
  if (at.squaredNorm() > cylinder.radius * cylinder.radius) return false;
  hit = {distance, Eigen::Vector3f::UnitZ(), 0};
  return true;
}

// The upright cylinder on the floor, without its bottom. Faces: 0 top, 1 side, 2 band.
bool intersect_cylinder(const Prop& cylinder, const Ray& ray, Hit& hit) {
  const Eigen::Vector2f offset = ray.origin.head<2>() - cylinder.centre.head<2>();
  const Eigen::Vector2f direction = ray.direction.head<2>();
  const float a = direction.squaredNorm();
  const float b = offset.dot(direction);
  const float inside = b * b - a * (offset.squaredNorm() - cylinder.radius * cylinder.radius);
  if (inside > 0.0F && a > 0.0F) {
    const float distance = (-b - std::sqrt(inside)) / a;
    const float z = ray.origin.z() + distance * ray.direction.z();
    if (distance > 0.0F && z >= 0.0F && z <= cylinder.height) {
      const Eigen::Vector2f normal = (offset + distance * direction) / cylinder.radius;
      const bool band = z >= cylinder.band_bottom && z < cylinder.band_top;
      hit = {distance, {normal.x(), normal.y(), 0.0F}, band ? 2 : 1};
      return true;
    }
  }
  return intersect_top(cylinder, ray, hit);
}

// Of an upright body: elevations of its foot and its top between the nearest and the farthest horizontal distance.
Bounds upright_bounds(float azimuth, float half_width, float foot, float top, float nearest, float farthest) {
  return {azimuth, half_width, std::atan2(foot, foot < 0.0F ? nearest : farthest),
          std::atan2(top, top > 0.0F ? nearest : farthest)};
}

Bounds bounds_of_box(const Prop& box, const Eigen::Vector3f& eye) {
  const Eigen::Vector2f low = (box.low - eye).head<2>();
  const Eigen::Vector2f high = (box.high - eye).head<2>();
  const Eigen::Vector2f nearest = Eigen::Vector2f::Zero().cwiseMax(low).cwiseMin(high);
  const float azimuth = std::atan2(box.centre.y() - eye.y(), box.centre.x() - eye.x());
  float half_width = nearest.isZero() ? 2.0F * kPiF : 0.0F;
  float farthest = 0.0F;
  for (const float x : {low.x(), high.x()}) {
    for (const float y : {low.y(), high.y()}) {
      half_width = std::max(half_width, std::abs(std::remainder(std::atan2(y, x) - azimuth, 2.0F * kPiF)));
      farthest = std::max(farthest, std::hypot(x, y));
    }
  }
  return upright_bounds(azimuth, half_width, box.low.z() - eye.z(), box.high.z() - eye.z(), nearest.norm(), farthest);
}

// The azimuths of a circle on the floor plane.
float half_width_of_circle(float radius, float distance) {
  return distance > radius ? std::asin(radius / distance) : 2.0F * kPiF;
}

Bounds bounds_of_ball(const Prop& ball, const Eigen::Vector3f& eye) {
  const Eigen::Vector3f to_ball = ball.centre - eye;
  const float distance = to_ball.norm();
  const float level = to_ball.head<2>().norm();
  const float elevation = std::atan2(to_ball.z(), level);
  const float half = half_width_of_circle(ball.radius, distance);
  return {std::atan2(to_ball.y(), to_ball.x()), half_width_of_circle(ball.radius, level), elevation - half,
          elevation + half};
}

Bounds bounds_of_cylinder(const Prop& cylinder, const Eigen::Vector3f& eye) {
  const Eigen::Vector2f to_axis = (cylinder.centre - eye).head<2>();
  const float distance = to_axis.norm();
  return upright_bounds(std::atan2(to_axis.y(), to_axis.x()), half_width_of_circle(cylinder.radius, distance), -eye.z(),
                        cylinder.height - eye.z(), std::max(0.0F, distance - cylinder.radius),
                        distance + cylinder.radius);
}

Prop box(const Panel& panel, const Colour& colour) {
  Prop prop;
  prop.shape = Prop::Shape::box;
  prop.low << (panel.centre - panel.half).cast<float>(), 0.0F;
  prop.high << (panel.centre + panel.half).cast<float>(), static_cast<float>(panel.height);
  prop.centre = 0.5F * (prop.low + prop.high);
  prop.colour = colour;
  return prop;
}

Prop obstacle_prop(const Obstacle& obstacle, const Look& look) {
  Prop prop;
  prop.shape = Prop::Shape::cylinder;
  prop.radius = static_cast<float>(obstacle.radius);
  prop.height = static_cast<float>(obstacle.height);
  prop.centre << obstacle.position.cast<float>(), 0.5F * prop.height;
  prop.colour = look.hull;
  if (obstacle.band != Obstacle::Band::none) {
    prop.band = obstacle.band == Obstacle::Band::cyan ? look.cyan : look.magenta;
    prop.band_bottom = static_cast<float>(obstacle.band_bottom);
    prop.band_top = static_cast<float>(obstacle.band_top);
  }
  return prop;
}

}  // namespace

Bounds bounds_of(const Prop& prop, const Eigen::Vector3f& eye) {
  switch (prop.shape) {
    case Prop::Shape::box:
      return bounds_of_box(prop, eye);
    case Prop::Shape::ball:
      return bounds_of_ball(prop, eye);
    case Prop::Shape::cylinder:
      return bounds_of_cylinder(prop, eye);
  }
  return {};
}

bool intersect(const Prop& prop, const Ray& ray, Hit& hit) {
  switch (prop.shape) {
    case Prop::Shape::box:
      return intersect_box(prop, ray, hit);
    case Prop::Shape::ball:
      return intersect_ball(prop, ray, hit);
    case Prop::Shape::cylinder:
      return intersect_cylinder(prop, ray, hit);
  }
  return false;
}

Colour colour_of(const Prop& prop, const Ray& ray, const Hit& hit, const Light& light) {
  const Eigen::Vector3f point = ray.origin + hit.distance * ray.direction;
  const bool band = prop.shape == Prop::Shape::cylinder && hit.face == 2;
  Colour colour = (band ? prop.band : prop.colour) * shade(light, point, hit.normal);
  if (prop.shape == Prop::Shape::ball) colour += glossy(light, ray.direction, hit.normal);
  return colour;
}

std::vector<Prop> props_of(const Arena& arena, const Look& look) {
  std::vector<Prop> props;
  if (arena.field) {
    const bool white = arena.field->goals == Field::Goals::white;
    for (const Panel& panel : goal_panels(*arena.field)) {
      props.push_back(box(panel, white ? look.white_goal : panel.centre.y() > 0.0 ? look.yellow_goal : look.blue_goal));
    }
  }
  for (const Panel& panel : wall_panels(arena)) props.push_back(box(panel, look.wall));
  for (const Obstacle& obstacle : arena.obstacles) props.push_back(obstacle_prop(obstacle, look));
  return props;
}

Prop ball_prop(const Eigen::Vector3d& centre_in_field, const Look& look) {
  Prop prop;
  prop.shape = Prop::Shape::ball;
  prop.centre = centre_in_field.cast<float>();
  prop.radius = static_cast<float>(kBallRadius);
  prop.colour = look.ball;
  return prop;
}

}  // namespace movis::sim
