#include "own_robot.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "light.h"
#include "prop.h"

namespace movis::sim {
namespace {

constexpr int kFewSamples = 2;  // along each side of a pixel, to see whether it needs more
constexpr int kSamples = 4;
constexpr int kReflections = 2;          // rays of a pixel that are followed beyond another mirror
constexpr float kReflectance = 0.9F;     // of a mirror
constexpr float kCameraRadius = 0.016F;  // of the camera below a mirror, metres
constexpr float kCameraLength = 0.0445F;
constexpr float kLensDepth = 0.0005F;          // of a camera's centre of projection behind its front
constexpr float kPlateThickness = 0.008F;      // of the plate that carries a mirror
constexpr float kPlainMirrorRadius = 0.0275F;  // of a sensor unit whose mirror is not known
constexpr float kBlack = 0.4F;                 // colour of cameras and plates, relative to the hull's
constexpr float kNothing = std::numeric_limits<float>::max();
constexpr float kBeside = 0.0F;

struct Seen {
  float distance = kNothing;  // kBeside: there is no ray
  Colour colour = Colour::Zero();
  bool mirror = false;  // then `ray` is what it shows
  Ray ray{};
};

void keep_nearer(Seen& seen, float distance, const Colour& colour) {
  if (distance > 0.0F && distance < seen.distance) seen = {distance, colour, false, {}};
}

// An upright cylinder between two heights, with both its ends.
void see_cylinder(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray, const Eigen::Vector2f& centre,
                  float radius, float bottom, float top, const Colour& surface, const Light& light, Seen& seen) {
  const Eigen::Vector2f offset = origin.head<2>() - centre;
  const float a = ray.head<2>().squaredNorm();
  const float b = offset.dot(ray.head<2>());
  const float inside = b * b - a * (offset.squaredNorm() - radius * radius);
  if (inside > 0.0F && a > 0.0F) {
    const float distance = (-b - std::sqrt(inside)) / a;
    const float z = origin.z() + distance * ray.z();
    if (z >= bottom && z <= top) {
      const Eigen::Vector2f side = (offset + distance * ray.head<2>()) / radius;
      const Eigen::Vector3f point = origin + distance * ray;
      keep_nearer(seen, distance, surface * shade(light, point, {side.x(), side.y(), 0.0F}));
    }
  }
  for (const float height : {bottom, top}) {
    const float distance = (height - origin.z()) / ray.z();
    const Eigen::Vector3f point = origin + distance * ray;
    if ((point.head<2>() - centre).squaredNorm() > radius * radius) continue;
    const Eigen::Vector3f normal(0.0F, 0.0F, height == top ? 1.0F : -1.0F);
    keep_nearer(seen, distance, surface * shade(light, point, normal));
  }
}

// A mirror's ray: to the hull, or out into the world.
void keep_nearer_mirror(Seen& seen, float distance, const Ray& ray, const control::RobotModel& robot,
                        const Look& look) {
  if (distance >= seen.distance) return;
  const float to_deck = (static_cast<float>(robot.height) - ray.origin.z()) / ray.direction.z();
  const Eigen::Vector2f on_deck = (ray.origin + to_deck * ray.direction).head<2>();
  if (to_deck > 0.0F && on_deck.norm() < static_cast<float>(robot.radius)) {
    seen = {distance, kReflectance * look.hull, false, {}};
  } else {
    seen = {distance, Colour::Zero(), true, ray};
  }
}

// The hyperboloid of omni/hyperboloid.h, upright at `focus`: (z + c)²/a² − r²/b² = 1 from its vertex up to its rim.
void see_mirror(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray, const omni::Camera& unit,
                const omni::Hyperboloid& mirror, const control::RobotModel& robot, const Look& look, Seen& seen) {
  const Eigen::Vector3d p = (origin - unit.position.cast<float>()).cast<double>();
  const Eigen::Vector3d d = ray.cast<double>();
  const double a2 = mirror.a * mirror.a;
  const double b2 = mirror.b * mirror.b;
  const double c = std::sqrt(a2 + b2);
  const double qa = d.z() * d.z() / a2 - d.head<2>().squaredNorm() / b2;
  const double qb = (p.z() + c) * d.z() / a2 - p.head<2>().dot(d.head<2>()) / b2;
  const double qc = (p.z() + c) * (p.z() + c) / a2 - p.head<2>().squaredNorm() / b2 - 1.0;
  const double root = qb * qb - qa * qc;
  if (root <= 0.0) return;
  for (const double sign : {-1.0, 1.0}) {
    const double distance = (-qb + sign * std::sqrt(root)) / qa;
    const Eigen::Vector3d at = p + distance * d;
    if (distance <= 0.0 || at.z() + c <= 0.0 || at.head<2>().norm() > mirror.rim_radius) continue;
    Eigen::Vector3d normal(-at.x() / b2, -at.y() / b2, (at.z() + c) / a2);  // up, into the mirror
    normal = -normal.normalized();
    if (normal.dot(d) >= 0.0) continue;  // from within
    const Eigen::Vector3f leaving = (d - 2.0 * d.dot(normal) * normal).cast<float>();
    const Eigen::Vector3f point = origin + static_cast<float>(distance) * ray;
    keep_nearer_mirror(seen, static_cast<float>(distance), {point, leaving}, robot, look);
  }
}

void see_unit(const Eigen::Vector3f& origin, const Eigen::Vector3f& ray, const omni::Camera& unit,
              const control::RobotModel& robot, const Look& look, Seen& seen) {
  const Eigen::Vector3f at = unit.position.cast<float>();
  const Eigen::Vector2f axis = at.head<2>();
  float rim = kPlainMirrorRadius;
  float rim_height = at.z();
  float front = at.z() - 0.07F;
  if (const auto* mirror = std::get_if<omni::Hyperboloid>(&unit.model)) {
    const double c = std::hypot(mirror->a, mirror->b);
    rim = static_cast<float>(mirror->rim_radius);
    rim_height += static_cast<float>(mirror->a * std::hypot(1.0, mirror->rim_radius / mirror->b) - c);
    front = at.z() - static_cast<float>(2.0 * c) - kLensDepth;
    see_mirror(origin, ray, unit, *mirror, robot, look, seen);
  }
  const Colour black = kBlack * look.hull;
  see_cylinder(origin, ray, axis, rim, rim_height, rim_height + kPlateThickness, black, look.light, seen);
  see_cylinder(origin, ray, axis, kCameraRadius, front - kCameraLength, front, black, look.light, seen);
}

// What a camera sees of the robot along one ray.
Seen see_robot(const omni::Rig& rig, std::size_t index, const Eigen::Matrix3d& robot_from_camera,
               const control::RobotModel& robot, const Look& look, const Eigen::Vector2d& pixel) {
  Seen seen;
  const auto direction = unproject(rig.cameras[index].model, pixel);
  if (!direction) return {kBeside, look.outside, false, {}};
  const Eigen::Vector3f origin = rig.cameras[index].position.cast<float>();
  const Eigen::Vector3f ray = (robot_from_camera * *direction).cast<float>();
  see_cylinder(origin, ray, Eigen::Vector2f::Zero(), static_cast<float>(robot.radius), 0.0F,
               static_cast<float>(robot.height), look.hull, look.light, seen);
  for (std::size_t other = 0; other < rig.cameras.size(); ++other) {
    if (other != index) see_unit(origin, ray, rig.cameras[other], robot, look, seen);
  }
  return seen;
}

struct Pixel {
  int samples = 0, covered = 0, beside = 0;
  bool mixed = false;              // not all samples are of the same kind
  Colour colour = Colour::Zero();  // sum over the samples
  std::vector<Ray> mirrored;
};

// A pixel by side × side rays.
void look_at(const omni::Rig& rig, std::size_t index, const Eigen::Matrix3d& robot_from_camera,
             const control::RobotModel& robot, const Look& look, const Eigen::Vector2d& corner, int side,
             Pixel& pixel) {
  pixel.mirrored.clear();
  pixel.covered = pixel.beside = 0;
  pixel.samples = side * side;
  pixel.colour.setZero();
  for (int sample = 0; sample < pixel.samples; ++sample) {
    const int row = sample / side;
    const Eigen::Vector2d inside((sample % side + 0.5) / side, (row + 0.5) / side);
    const Seen seen = see_robot(rig, index, robot_from_camera, robot, look, corner + inside);
    if (seen.distance == kNothing) continue;
    ++pixel.covered;
    pixel.beside += seen.distance == kBeside ? 1 : 0;
    pixel.colour += seen.colour;
    if (seen.mirror) pixel.mirrored.push_back(seen.ray);
  }
  pixel.mixed = pixel.covered % pixel.samples != 0 || pixel.beside % pixel.samples != 0 || !pixel.mirrored.empty();
}

}  // namespace

OwnRobot see_own_robot(const omni::Rig& rig, std::size_t index, const control::RobotModel& robot, const Look& look) {
  const omni::Camera& camera = rig.cameras[index];
  const std::size_t pixels = static_cast<std::size_t>(camera.width) * camera.height;
  const Eigen::Matrix3d robot_from_camera = camera.robot_from_camera();
  OwnRobot own;
  own.open.resize(pixels);
  own.outside.resize(pixels);
  for (auto& plane : own.planes) plane.resize(pixels);
  Pixel pixel;
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto column = static_cast<int>(i % camera.width);
    const auto row = static_cast<int>(i / camera.width);
    const Eigen::Vector2d corner(column - 0.5, row - 0.5);
    look_at(rig, index, robot_from_camera, robot, look, corner, kFewSamples, pixel);
    if (pixel.mixed) look_at(rig, index, robot_from_camera, robot, look, corner, kSamples, pixel);
    own.outside[i] = pixel.beside == pixel.samples;
    own.open[i] = 1.0F - static_cast<float>(pixel.covered) / static_cast<float>(pixel.samples);
    for (int channel = 0; channel < 3; ++channel) {
      own.planes[channel][i] = pixel.colour[channel] / static_cast<float>(pixel.samples);
    }
    const std::size_t rays = pixel.mirrored.size();
    const std::size_t count = std::min<std::size_t>(rays, kReflections);
    for (std::size_t k = 0; k < count; ++k) {
      const Ray& ray = pixel.mirrored[k * rays / count];
      const float weight = kReflectance * static_cast<float>(rays) / static_cast<float>(pixel.samples * count);
      own.reflections.push_back({row, column, weight, ray.origin, ray.direction});
    }
  }
  return own;
}

}  // namespace movis::sim
