#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounds.h"
#include "movis/sim/look.h"
#include "movis/sim/scene.h"

// What stands on the floor: goals, walls, opponents, the ball, each a few convex bodies in the field frame.
namespace movis::sim {

struct Ray {
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  // unit
};

struct Hit {
  float distance;  // along the ray, metres
  Eigen::Vector3f normal;
  int face;  // numbers the body's faces: within one, colour changes smoothly
};

struct Prop {
  enum class Shape { box, ball, cylinder };
  Shape shape = Shape::box;
  Eigen::Vector3f low = Eigen::Vector3f::Zero();   // of a box: its corner with the smallest coordinates
  Eigen::Vector3f high = Eigen::Vector3f::Zero();  // and that with the largest
  Eigen::Vector3f centre = Eigen::Vector3f::Zero();
  float radius = 0.0F;  // of a ball or a cylinder, which stands upright on the floor
  float height = 0.0F;  // of a cylinder
  float reach = 0.0F;   // of the sphere around `centre` that holds the whole body
  Colour colour = Colour::Zero();
  Colour band = Colour::Zero();  // of a cylinder, between the two heights
  float band_bottom = 0.0F, band_top = 0.0F;
};

// The directions in which a body is seen.
Bounds bounds_of(const Prop& prop, const Eigen::Vector3f& eye_in_field);

// Where a ray enters a body, if it does.
bool intersect(const Prop& prop, const Ray& ray, Hit& hit);

// The colour that a ray brings back from where it hit, linear.
Colour colour_of(const Prop& prop, const Ray& ray, const Hit& hit, const Light& light);

// What stands still, from an arena.
std::vector<Prop> props_of(const Arena& arena, const Look& look);

Prop ball_prop(const Eigen::Vector3d& centre_in_field, const Look& look);

}  // namespace movis::sim
