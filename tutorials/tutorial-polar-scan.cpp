// From an omnidirectional image to bearings: the polar scan.
//
// Scenario: one image of camera M1 on the paper's field. Every pixel knows its azimuth, so the pixels of a colour
// class are counted over azimuth (Fig. 4); runs of bins above an adaptive threshold are objects; a bearing is then
// refined far below the width of a bin from the mixed colours of the border pixels.
//
//   r, θ of (1)–(2)       a pixel's polar coordinates; here θ is the azimuth of its ray in the robot's axes, computed
//                         once for every pixel, so that the image is visited in memory order: movis/scan/polar_map.h
//   histogram, threshold  pixels a bin; 720 bins of 0.5°: §2.3, movis/scan/histogram.h
//   azimuth, elevation    of the ray from the viewpoint, in the robot's axes, radians, printed in degrees; sigma is one
//                         standard deviation as the scanner states it: movis/scan/refine.h
//   left, right           azimuths of a goal's edges; true are those of the outside of its box, walls included
//
// Source: the MOVIS paper, sections 2.2–2.3.

#include <visp3/core/vpImageDraw.h>

#include "common.h"
#include "movis/grab/views.h"
#include "movis/scan/scanner.h"

using namespace movis;
using Eigen::Vector3d;

const std::pair<ObjectClass, vpColor> kObjects[] = {{ObjectClass::ball, vpColor::orange},
                                                    {ObjectClass::yellow_goal, vpColor::yellow},
                                                    {ObjectClass::blue_goal, vpColor(80, 130, 255)}};

// The picture: rows 0 to 159 are the unrolled image, a column for every bin, azimuth falling to the right as to one who
// looks around, 0.5° a pixel; rows 160 to 359 the histograms with their thresholds dotted, 1.5 rows a pixel.
constexpr int kPanoramaRows = 160, kRows = 360;
constexpr double kTop = radians(15.0), kStep = radians(0.5);

void print_histogram(ObjectClass object, const scan::Histogram& histogram) {
  const auto& counts = histogram.counts;
  const auto fullest = std::max_element(counts.begin(), counts.end());
  const double azimuth = -kPi + kStep * (0.5 + static_cast<double>(fullest - counts.begin()));
  fmt::print("{:12} threshold {:4.1f} pixels, fullest bin {:3} pixels around {:.2f}°\n", name(object),
             histogram.threshold, *fullest, degrees(azimuth));
}

// Prints a line of the table; the error.
double compare(const Bearing& bearing, const char* angle, double measured, double variance, double truth) {
  const double error = turn(truth, measured);
  fmt::print("{:12} {:10} {:9.3f}° {:7.3f}° {:9.3f}° {:7.3f}°{}\n", name(bearing.object), angle, degrees(measured),
             degrees(std::sqrt(variance)), degrees(truth), degrees(error), bearing.clean() ? "" : "  flagged");
  return error;
}

// Where the goal's edges are: the outermost corners of its box, on either side of its middle.
void compare_goal(const Bearing& goal, const tutorial::Scene& scene) {
  const Field& field = scene.field;
  const int side = goal.object == ObjectClass::yellow_goal ? +1 : -1;
  const auto azimuth_of = [&](double x, double y) {
    const Vector3d in_robot = tutorial::in_robot(scene.truth.world_from_robot, {x, side * y, 0.0});
    return tutorial::direction(in_robot - scene.rig.cameras[0].position).first;
  };
  const double middle = azimuth_of(0.0, field.Fd);
  double left = 0.0, right = 0.0;
  for (const double x : {-field.Fw - field.goal_thickness, field.Fw + field.goal_thickness}) {
    for (const double y : {field.Fd, field.Fd + field.goal_depth}) {
      left = std::max(left, turn(middle, azimuth_of(x, y)));
      right = std::min(right, turn(middle, azimuth_of(x, y)));
    }
  }
  compare(goal, "left edge", goal.left, goal.left_variance, wrap_angle(middle + left));
  compare(goal, "right edge", goal.right, goal.right_variance, wrap_angle(middle + right));
}

// Direction of the ball's centre; true where it is good to 0.2°.
bool compare_ball(const Bearing& ball, const tutorial::Scene& scene) {
  const Vector3d in_robot = tutorial::in_robot(scene.truth.world_from_robot, scene.truth.ball_in_field);
  const auto [azimuth, elevation] = tutorial::direction(in_robot - scene.rig.cameras[0].position);
  const double azimuth_error = compare(ball, "azimuth", ball.azimuth, ball.covariance(0, 0), azimuth);
  const double elevation_error = compare(ball, "elevation", ball.elevation, ball.covariance(1, 1), elevation);
  return std::hypot(azimuth_error, elevation_error) < radians(0.2);
}

vpImage<vpRGBa> unroll(const tutorial::Scene& scene, int columns) {
  const omni::Camera& camera = scene.rig.cameras[0];
  vpImage<vpRGBa> image, panorama(kRows, columns, vpRGBa(30, 30, 30));
  grab::copy(scene.images.frames[0].view, image);
  for (int row = 0; row < kPanoramaRows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double azimuth = kPi - (column + 0.5) * kStep, elevation = kTop - row * kStep;
      const Vector3d ray(std::cos(azimuth), std::sin(azimuth), std::tan(elevation));
      const auto pixel = tutorial::pixel_of(camera, camera.position + ray);
      if (pixel) panorama[row][column] = image.getValue(pixel->y(), pixel->x());
    }
  }
  return panorama;
}

void draw(vpImage<vpRGBa>& drawing, const scan::Histogram& histogram, const vpColor& colour) {
  const auto row_of = [](double pixels) { return kRows - 5.0 - 1.5 * std::min(pixels, 128.0); };
  const int bins = static_cast<int>(histogram.counts.size());
  for (int column = 1; column < bins; ++column) {
    const int bin = bins - 1 - column;
    vpImageDraw::drawLine(drawing, {row_of(histogram.counts[bin + 1]), column - 1.0},
                          {row_of(histogram.counts[bin]), 1.0 * column}, colour);
  }
  const double threshold = row_of(histogram.threshold);
  vpImageDraw::drawDottedLine(drawing, {threshold, 0.0}, {threshold, bins - 1.0}, colour);
}

void draw(vpImage<vpRGBa>& drawing, const Bearing& bearing) {
  const auto column_of = [](double azimuth) { return (kPi - azimuth) / kStep - 0.5; };
  vpImageDraw::drawCross(drawing, {(kTop - bearing.elevation) / kStep, column_of(bearing.azimuth)}, 15, vpColor::red);
  for (const double column : {column_of(bearing.left), column_of(bearing.right)}) {
    vpImageDraw::drawLine(drawing, {0.0, column}, {kPanoramaRows - 1.0, column}, vpColor::red);
  }
}

bool scan_image(const std::string& folder, int frame, const std::string& out) {
  const tutorial::Scene scene = tutorial::read_scene(folder, frame);
  scan::Scanner scanner(scene.rig, 0, scan::read_colours(data_file("colours/default.yaml")), scan::ScanOptions{});
  std::vector<Bearing> bearings;
  scanner.scan(scene.images.frames[0].view, scene.images.frames[0].time_s, bearings);

  vpImage<vpRGBa> drawing = unroll(scene, scanner.polar_map().bins);
  for (const auto& [object, colour] : kObjects) {
    print_histogram(object, scanner.histogram(object));
    draw(drawing, scanner.histogram(object), colour);
  }
  fmt::print("\n{:12} {:10} {:>10} {:>8} {:>10} {:>8}\n", "object", "angle", "measured", "sigma", "true", "error");
  bool good = false;
  for (const Bearing& bearing : bearings) {
    if (bearing.object == ObjectClass::ball) {
      good = compare_ball(bearing, scene);
    } else {
      compare_goal(bearing, scene);
    }
    draw(drawing, bearing);
  }
  fmt::print("\nthe ball's bearing is {}\n", good ? "good to 0.2°" : "OFF by more than 0.2°, or there is none");
  tutorial::write_picture(drawing, out);
  return good;
}

int main(int argc, char** argv) {
  CLI::App arguments("Scans one omnidirectional image for ball and goals", "tutorial-polar-scan");
  std::string folder, out = "tutorial-polar-scan.png";
  int frame = 4;
  arguments.add_option("--data", folder, "A data set with field.yaml and truth.csv; default: data/images/field");
  arguments.add_option("--frame", frame, "Number of the frame")->capture_default_str();
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv, [&] { return scan_image(folder, frame, out); });
}
