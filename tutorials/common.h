#pragma once

#include <fmt/core.h>
#include <visp3/io/vpImageIo.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <functional>

#include "movis/core/error.h"
#include "movis/core/field.h"
#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"

// What the tutorials share.
namespace movis::tutorial {

// Parses the arguments and runs the tutorial. Exit codes: 0 the result is as it should be, 1 it is off or the work
// failed, 2 wrong arguments.
inline int run(CLI::App& arguments, int argc, char** argv, const std::function<bool()>& body) {
  try {
    arguments.parse(argc, argv);
    return body() ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    return arguments.exit(error) == 0 ? 0 : 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", arguments.get_name(), error.what());
    return 1;
  }
}

// One set of images with everything that is known about it.
struct Scene {
  omni::Rig rig;
  grab::FrameSet images;
  Field field;
  grab::Truth truth;
};

// A set of a data set with field.yaml and truth.csv; without a folder of data/images/field.
inline Scene read_scene(std::filesystem::path folder, std::int64_t frame) {
  if (folder.empty()) folder = data_file("images/field");
  grab::DatasetSource source(grab::read_dataset(folder));
  Scene scene{source.dataset().rig, {}, read_field(folder / "field.yaml"), {}};
  source.open();
  while (source.acquire(scene.images)) {
    if (scene.images.index != frame) continue;
    scene.truth = grab::read_truth(folder / "truth.csv").at(frame);
    return scene;
  }
  throw Error("{}: there is no frame {}", folder.string(), frame);
}

// The robot stands on the floor: heights are the same in both frames.
inline Eigen::Vector3d in_robot(const Pose2& world_from_robot, const Eigen::Vector3d& point_in_field) {
  const Eigen::Vector2d on_floor = inverse(world_from_robot) * Eigen::Vector2d(point_in_field.head<2>());
  return {on_floor.x(), on_floor.y(), point_in_field.z()};
}

// Azimuth and elevation of a ray in the robot's axes.
inline std::pair<double, double> direction(const Eigen::Vector3d& ray) {
  return {std::atan2(ray.y(), ray.x()), std::atan2(ray.z(), ray.head<2>().norm())};
}

// Where the camera sees a point; nothing where it does not, or outside of its image.
inline std::optional<Eigen::Vector2d> pixel_of(const omni::Camera& camera, const Eigen::Vector3d& point_in_robot) {
  const auto pixel = omni::project(camera, point_in_robot);
  const Eigen::Array2d last(camera.width - 1, camera.height - 1);
  if (!pixel || (pixel->array() < 0.0).any() || (pixel->array() > last).any()) return std::nullopt;
  return pixel;
}

// vpImageIo is silent where it cannot write.
inline void write_picture(const vpImage<vpRGBa>& picture, const std::string& file) {
  if (!std::ofstream(file)) throw Error("{}: cannot be written; name another place with --out", file);
  vpImageIo::write(picture, file);
  fmt::print("drawn into {}\n", file);
}

}  // namespace movis::tutorial
