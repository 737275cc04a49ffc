// Rendering what omnidirectional cameras see, with a truth to measure against.
//
// Scenario: a robot, a ball and an opponent with a magenta band on the paper's field. The renderer draws what the three
// cameras see, the scanner measures the ball's bearing in the picture, and the scene says what it should be. Then one
// thing at a time is changed, in the world or in what the scanner believes of it:
//
//   nominal           the rig of data/rigs, with the light, the blur and the noise of data/looks/hall.yaml
//   no blur or noise  the light itself: what is still off is no fault of lens and sensor
//   tilted by 3°      camera M1 leans about its x axis, and the scanner knows
//   tilt unknown      the same picture, read as though M1 stood upright: an error that no sigma tells of
//   sphere            M1's mirror replaced by the unified sphere that is the same camera: movis/omni/hyperboloid.h.
//                     The mirror's rim, at radius r and a·√(1 + r²/b²) − c above the viewpoint, limits the elevation
//
//   azimuth, elevation  of the ray from the viewpoint to the ball's centre, in the robot's axes; printed in degrees
//   sigma               one standard deviation of each, as the scanner states it: movis/scan/refine.h
//   noise               √(read_noise² + signal) electrons a pixel: EMVA 1288, release 4.0; movis/sim/look.h

#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>
#include <visp3/core/vpImageTools.h>

#include "common.h"
#include "movis/grab/views.h"
#include "movis/scan/scanner.h"
#include "movis/sim/renderer.h"
#include "movis/sim/scenario.h"

using namespace movis;
using Picture = vpImage<vpRGBa>;
constexpr int kPanel = 240;  // the drawing is two rows of three panels of this size, pixels

struct Case {
  const char* name;
  sim::Scenario scenario;  // rig, field, opponents, robot and look: what the renderer sees with, and what it sees
  omni::Rig believed;      // what the scanner takes the rig for
};

omni::UnifiedSphere as_sphere(const omni::Hyperboloid& mirror) {
  const double a = mirror.a, b = mirror.b, c = std::hypot(a, b), r = mirror.rim_radius;
  const double xi = 2.0 * a * c / (a * a + c * c), scale = b * b / (a * a + c * c);
  omni::UnifiedSphere sphere{xi, scale * mirror.fu, scale * mirror.fv, mirror.u0, mirror.v0};
  sphere.max_elevation = std::atan2(a * std::sqrt(1.0 + r * r / (b * b)) - c, r);
  return sphere;
}

// What the cameras see, in the rig's order.
std::vector<Picture> render(const sim::Scenario& scenario, const sim::State& state) {
  sim::Renderer renderer(scenario.rig, scenario.arena, scenario.robot, scenario.look);
  grab::FrameSet images;
  renderer.render(state, 1, images);  // with the same seed, 1, the same noise
  std::vector<Picture> pictures(images.frames.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) grab::copy(images.frames[k].view, pictures[k]);
  return pictures;
}

// Measures the ball in a camera's picture and prints a line of the table; the error, radians.
double measure(const Case& which, int camera, const Picture& picture, const Eigen::Vector3d& ball_in_robot) {
  scan::Scanner scanner(which.believed, camera, scan::read_colours(data_file("colours/default.yaml")), {});
  std::vector<Bearing> bearings;
  scanner.scan(grab::view_of(picture), 0.0, bearings);
  const omni::Camera& seeing = which.scenario.rig.cameras[camera];
  const auto [azimuth, elevation] = tutorial::direction(ball_in_robot - seeing.position);
  for (const Bearing& bearing : bearings) {
    if (bearing.object != ObjectClass::ball) continue;
    const Eigen::Vector2d error(turn(azimuth, bearing.azimuth), bearing.elevation - elevation);
    const Eigen::Vector2d sigma = bearing.covariance.diagonal().cwiseSqrt();
    fmt::print("{:18}{:3}{:9.3f}°{:9.3f}°{:8.3f}°{:7.3f}°{:9.3f}°{:9.3f}°{:8.3f}°{:7.3f}°\n", which.name, seeing.name,
               degrees(azimuth), degrees(bearing.azimuth), degrees(error.x()), degrees(sigma.x()), degrees(elevation),
               degrees(bearing.elevation), degrees(error.y()), degrees(sigma.y()));
    return error.norm();
  }
  throw Error("{}: there is no ball in the picture of {}", which.name, seeing.name);
}

int largest_difference(const Picture& a, const Picture& b) {
  int largest = 0;
  for (unsigned int i = 0; i < a.getSize(); ++i) {
    const vpRGBa &p = a.bitmap[i], &q = b.bitmap[i];
    largest = std::max({largest, std::abs(p.R - q.R), std::abs(p.G - q.G), std::abs(p.B - q.B)});
  }
  return largest;
}

// A square of a picture into one of the drawing's panels; its size is that of a panel times or by a whole number.
void show(const Picture& picture, const vpImagePoint& top_left, int size, const std::string& name,
          const vpImagePoint& panel_at, Picture& drawing) {
  Picture square, panel;
  vpImageTools::crop(picture, top_left, size, size, square);
  const auto method = size > kPanel ? vpImageTools::INTERPOLATION_LINEAR : vpImageTools::INTERPOLATION_NEAREST;
  vpImageTools::resize(square, panel, kPanel, kPanel, method);
  vpFont(13).drawText(panel, name, {4, 4}, vpColor::white);
  drawing.insert(panel, panel_at);
}

// Above what the cameras see; beneath M1's ball, large, with a cross where the nominal camera has its centre.
Picture draw(const std::vector<std::vector<Picture>>& pictures, const omni::Camera& m1, const Eigen::Vector3d& ball) {
  constexpr int kZoom = 6, kPixels = kPanel / kZoom;  // of the lower panels
  Picture drawing(2 * kPanel, 3 * kPanel);
  const char* const names[] = {"M1", "M2", "M3", "M1's ball", "no blur or noise", "M1 tilted"};
  const Eigen::Vector2d pixel = omni::project(m1, ball).value();
  const vpImagePoint corner(std::floor(pixel.y()) - 0.5 * kPixels, std::floor(pixel.x()) - 0.5 * kPixels);
  const vpImagePoint cross = (vpImagePoint(pixel.y() + 0.5, pixel.x() + 0.5) - corner) * kZoom;
  for (int column = 0; column < 3; ++column) {
    const vpImagePoint above(0, kPanel * column), beneath(kPanel, kPanel * column);
    show(pictures[0][column], {0, 80}, 2 * kPanel, names[column], above, drawing);
    show(pictures[column][0], corner, kPixels, names[3 + column], beneath, drawing);
    vpImageDraw::drawCross(drawing, beneath + cross, 15, vpColor::black, 2);
  }
  return drawing;
}

std::vector<Case> make_cases() {
  sim::Scenario scenario = sim::read_scenario(data_file("scenarios/resting-ball.yaml"));
  scenario.arena.obstacles.push_back({{-0.8, 0.7}, 0.2, 0.6, sim::Obstacle::Band::magenta});
  sim::Scenario clean = scenario, leaning = scenario, sphere = scenario;
  clean.look.sensor = {};
  leaning.rig.cameras[0].tilt_x = radians(3.0);
  sphere.rig.cameras[0].model = as_sphere(std::get<omni::Hyperboloid>(scenario.rig.cameras[0].model));
  return {{"nominal", scenario, scenario.rig},
          {"no blur or noise", clean, clean.rig},
          {"tilted by 3°", leaning, leaning.rig},
          {"tilt unknown", leaning, scenario.rig},
          {"sphere", sphere, sphere.rig}};
}

bool render_and_measure(const std::string& out) {
  const sim::State state{0.0, {-0.4, -0.6, radians(20.0)}, {0.25, 0.3, sim::kBallRadius}};
  const Eigen::Vector3d ball = tutorial::in_robot(state.world_from_robot, state.ball_in_field);
  const std::vector<Case> cases = make_cases();
  std::vector<std::vector<Picture>> pictures;
  std::vector<double> errors;  // of M1
  fmt::print("                       azimuth   measured    error   sigma  elevation  measured   error   sigma\n");
  for (const Case& which : cases) {
    pictures.push_back(render(which.scenario, state));
    errors.push_back(measure(which, 0, pictures.back()[0], ball));
    for (int k = 1; k < 3 && pictures.size() == 1; ++k) measure(which, k, pictures[0][k], ball);
  }
  const int difference = largest_difference(pictures[0][0], pictures[4][0]);
  fmt::print("mirror and sphere: the pictures differ by {} grey levels at most\n", difference);
  tutorial::write_picture(draw(pictures, cases[0].believed.cameras[0], ball), out);
  const double worst = std::max({errors[0], errors[1], errors[2], errors[4]});
  return worst < radians(0.4) && errors[3] > radians(1.0) && std::abs(errors[4] - errors[0]) < radians(0.01);
}

int main(int argc, char** argv) {
  CLI::App arguments("Renders what the cameras of a rig see and measures the ball in it", "tutorial-render-omni");
  std::string out = "tutorial-render-omni.png";
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv, [&] { return render_and_measure(out); });
}
