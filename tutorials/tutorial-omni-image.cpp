// From a point of the field to its pixel in an omnidirectional image, and back to a ray.
//
// Scenario: the robot stands on the paper's 3.5 m × 4 m field at a known pose. Everything of which the place is known
// (goals, corners, lines, ball) is projected into the image of camera M1. If frames, rig and mirror model are right,
// every cross falls on what it stands for: the images come from a ray tracer that shares no code with MOVIS. Projection
// knows nothing of what hides what: where a line passes under the robot, it is drawn across its body.
//
//   point_in_field (X, Y, Z)   metres; origin at the centre spot, Y towards the yellow goal, Z up
//   point_in_robot (x, y, z)   metres; origin on the floor under the robot, x right, y forward, z up
//   world_from_robot           (X_R, Y_R, β), metres and radians: the paper's equations (5)–(6)
//   pixel (u, v)               pixels; (0, 0) is the centre of the top-left one
//   azimuth, elevation         of the ray that starts at the camera's viewpoint, in the robot's axes: from x towards y,
//                              and up from the horizontal; radians, printed in degrees
//   mirror                     hyperboloid, one viewpoint: Baker and Nayar, IJCV 35(2), 1999; movis/omni/hyperboloid.h

#include <visp3/core/vpDisplayException.h>
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/gui/vpDisplayX.h>

#include "common.h"
#include "movis/grab/views.h"
#include "movis/omni/rig.h"
#include "movis/scan/classify.h"

using namespace movis;
using Eigen::Vector3d;

struct Landmark {
  std::string name;
  Vector3d in_field;
  std::optional<ObjectClass> object;  // what its pixel shows unless something stands before it
};

std::vector<Landmark> landmarks(const Field& field, const Vector3d& ball_in_field) {
  std::vector<Landmark> all{{"ball", ball_in_field, ObjectClass::ball}};
  for (const int side : {+1, -1}) {
    const double middle_of_net = side * (field.Fd + field.goal_depth);
    all.push_back({side > 0 ? "yellow goal" : "blue goal",
                   {0.0, middle_of_net, 0.6 * field.goal_height},
                   side > 0 ? ObjectClass::yellow_goal : ObjectClass::blue_goal});
    for (const int post : {1, 2}) {
      const double x = post == 1 ? -field.Fw : field.Fw;
      const std::string name = fmt::format("{}{}", side > 0 ? 'P' : 'Q', post);
      all.push_back({name + " foot", {x, side * field.Fd, 0.0}, std::nullopt});
      all.push_back({name + " top", {x, side * field.Fd, field.goal_height}, std::nullopt});
    }
  }
  return all;
}

// Points at most 10 cm apart on the middle of the field's lines, in the field frame.
std::vector<Vector3d> line_points(const Field& field) {
  const double x = field.half_width - 0.5 * field.line;
  const double y = field.half_length - 0.5 * field.line;
  const int steps = static_cast<int>(std::ceil(2.0 * y / 0.1));
  std::vector<Vector3d> points;
  for (int i = 0; i <= steps; ++i) {
    const double s = 2.0 * i / steps - 1.0;
    for (const double border : {-x, x}) points.emplace_back(border, s * y, 0.0);
    for (const double across : {-y, 0.0, y}) points.emplace_back(s * x, across, 0.0);
    points.emplace_back(field.circle * std::cos(kPi * s), field.circle * std::sin(kPi * s), 0.0);
  }
  return points;
}

const char* class_at(const vpImage<vpRGBa>& image, const Eigen::Vector2d& pixel, const scan::Colours& colours) {
  const vpRGBa colour = image.getValue(pixel.y(), pixel.x());
  for (const scan::ColourClass& candidate : colours.classes) {
    if (scan::belongs(scan::to_integers(candidate), colour.R, colour.G, colour.B)) return name(candidate.object);
  }
  return "none";
}

void show(vpImage<vpRGBa>& image) {
  try {
    vpDisplayX window(image, 50, 50, "M1");
    vpDisplay::display(image);
    vpDisplay::displayText(image, 20, 20, "Click to close", vpColor::white);
    vpDisplay::flush(image);
    vpDisplay::getClick(image);
  } catch (const vpDisplayException& error) {
    throw Error("--display needs an X server, is DISPLAY set? ({})", error.what());
  }
}

void draw_lines(vpImage<vpRGBa>& drawing, const tutorial::Scene& scene, const omni::Camera& camera) {
  for (const Vector3d& point : line_points(scene.field)) {
    const auto pixel = tutorial::pixel_of(camera, tutorial::in_robot(scene.truth.world_from_robot, point));
    if (pixel) vpImageDraw::drawPoint(drawing, {pixel->y(), pixel->x()}, vpColor::red, 3);
  }
}

bool project_landmarks(const std::string& folder, int frame, const std::string& out, bool display) {
  const tutorial::Scene scene = tutorial::read_scene(folder, frame);
  const omni::Camera& camera = scene.rig.cameras[0];
  const scan::Colours colours = scan::read_colours(data_file("colours/default.yaml"));
  vpImage<vpRGBa> image;
  grab::copy(scene.images.frames[0].view, image);
  vpImage<vpRGBa> drawing = image;
  draw_lines(drawing, scene, camera);

  fmt::print("{:12}{:>20}{:>17}{:>12}{:>12}{:>14}  {}\n", "point", "in the field, m", "pixel", "azimuth", "elevation",
             "round trip", "colour there");
  double worst_px = 0.0;
  int recognized = 0;
  for (const auto& [name, in_field, object] : landmarks(scene.field, scene.truth.ball_in_field)) {
    fmt::print("{:12}{:7.2f}{:7.2f}{:6.2f}", name, in_field.x(), in_field.y(), in_field.z());
    const auto pixel = tutorial::pixel_of(camera, tutorial::in_robot(scene.truth.world_from_robot, in_field));
    if (!pixel) {
      fmt::print("   beyond the mirror's rim\n");
      continue;
    }
    const Vector3d ray = omni::unproject(camera, *pixel).value();
    const double anywhere = 3.0;  // metres along the ray: all its points have the same pixel
    const double round_trip_px = (omni::project(camera, camera.position + anywhere * ray).value() - *pixel).norm();
    worst_px = std::max(worst_px, round_trip_px);
    const std::string colour = object ? class_at(image, *pixel, colours) : "-";
    if (object && colour == movis::name(*object)) ++recognized;
    const auto [azimuth, elevation] = tutorial::direction(ray);
    fmt::print("{:9.2f}{:8.2f}{:11.2f}°{:11.2f}°{:11.1e} px  {}\n", pixel->x(), pixel->y(), degrees(azimuth),
               degrees(elevation), round_trip_px, colour);
    vpImageDraw::drawCross(drawing, {pixel->y(), pixel->x()}, 11, vpColor::red);
    if (in_field.z() == scene.field.goal_height) {
      vpFont(13).drawText(drawing, name.substr(0, 2), {std::max(2.0, pixel->y() - 16.0), pixel->x() + 6.0},
                          vpColor::black);
    }
  }
  fmt::print("worst round trip {:.1e} px; {} of 3 colours recognized\n", worst_px, recognized);
  tutorial::write_picture(drawing, out);
  if (display) show(drawing);
  return worst_px < 1e-6 && recognized >= 2;  // one may stand behind another camera of the robot
}

int main(int argc, char** argv) {
  CLI::App arguments("Projects known points of the field into the image of camera M1", "tutorial-omni-image");
  std::string folder, out = "tutorial-omni-image.png";
  int frame = 0;
  bool display = false;
  arguments.add_option("--data", folder, "A data set with field.yaml and truth.csv; default: data/images/field");
  arguments.add_option("--frame", frame, "Number of the frame")->capture_default_str();
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  arguments.add_flag("--display", display, "Open a window of ViSP");
  return tutorial::run(arguments, argc, argv, [&] { return project_landmarks(folder, frame, out, display); });
}
