// A fair trial of localizers: the robot turns on the paper's nine spots, and all of them get the same images.
//
// Scenario: as in the paper's Fig. 8 to 16 the robot stands on the spots A to I of its field and turns. Three simulated
// cameras with noise see it; on every heading each localizer makes a pose of the same scan.
//
//   β        heading: the angle from the field's X axis to the robot's x axis, degrees
//   dX, dY   measured less true, field frame, cm; the graph shows them over β on one spot
//   mean     of the position's error over all headings of a spot, cm; a count where some headings had no pose
//   --yaw    turns the first camera by so many degrees, while the pipeline believes the drawing
//
// Source: the MOVIS paper, second section 4.1; the whole experiment is `movis experiment self-localization`.
#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>

#include "common.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"
#include "movis/sim/renderer.h"

using namespace movis;
using Eigen::Vector2d;

const std::vector<std::pair<char, Vector2d>> kSpots{{'A', {-1.0, 1.1}},  {'B', {0.0, 1.1}},  {'C', {1.0, 1.1}},
                                                    {'D', {-1.0, 0.0}},  {'E', {0.0, 0.0}},  {'F', {1.0, 0.0}},
                                                    {'G', {-1.0, -1.1}}, {'H', {0.0, -1.1}}, {'I', {1.0, -1.1}}};

struct Contender {
  std::string name;
  localization::Localizer localizer;
  vpColor colour;
  double sum = 0.0, all = 0.0;   // of position errors, metres, on the present spot and on all spots
  int fixes = 0, all_fixes = 0;  // likewise

  double mean() const { return all_fixes > 0 ? all / all_fixes : HUGE_VAL; }
};

// Left the errors over the heading, X above Y; right the field from above. Both to scale.
struct Picture {
  static constexpr double kReach = 0.15;  // metres of error that the graphs show
  vpImagePoint graph(int axis, double heading_deg, double error) const {
    const double shown = std::min(kReach, std::max(-kReach, error));
    return {120.0 + 240.0 * axis - 100.0 * shown / kReach, 40.0 + 1.2 * heading_deg};
  }
  vpImagePoint field(const Vector2d& point) const {
    const Vector2d shown = point.cwiseMax(Vector2d(-1.9, -2.5)).cwiseMin(Vector2d(1.9, 2.5));
    return {245.0 - 95.0 * shown.y(), 690.0 + 95.0 * shown.x()};
  }
  vpImage<vpRGBa> image{500, 960, vpRGBa(255, 255, 255)};
};

void draw_frame(Picture& picture, const Field& field, char spot) {
  const vpFont font(14);
  for (const int axis : {0, 1}) {
    for (const double error : {-picture.kReach, 0.0, picture.kReach}) {
      vpImageDraw::drawLine(picture.image, picture.graph(axis, 0, error), picture.graph(axis, 360, error),
                            vpColor::lightGray);
    }
    const std::string text = fmt::format("d{} ON SPOT {} TO 15 cm", "XY"[axis], spot);
    font.drawText(picture.image, text, vpImagePoint(240.0 * axis + 2.0, 40.0), vpColor::black);
  }
  const auto box = [&](const Vector2d& a, const Vector2d& b, const vpColor& colour) {
    vpImageDraw::drawRectangle(picture.image, vpRect(picture.field(a), picture.field(b)), colour, false, 2);
  };
  box({-field.half_width, -field.half_length}, {field.half_width, field.half_length}, vpColor::lightGray);
  box({-field.Fw, field.Fd}, {field.Fw, field.Fd + field.goal_depth}, vpColor::orange);
  box({-field.Fw, -field.Fd - field.goal_depth}, {field.Fw, -field.Fd}, vpColor::blue);
}

void judge(Contender& contender, const Fix& fix, const Pose2& truth, bool in_graph, Picture& picture) {
  if (fix.status != FixStatus::ok) return;
  const Vector2d error = fix.world_from_robot.translation() - truth.translation();
  contender.sum += error.norm();
  ++contender.fixes;
  vpImageDraw::drawPoint(picture.image, picture.field(fix.world_from_robot.translation()), contender.colour, 3);
  if (!in_graph) return;
  const double heading_deg = degrees(truth.beta) + (truth.beta < 0.0 ? 360.0 : 0.0);
  for (const int axis : {0, 1}) {
    vpImageDraw::drawCross(picture.image, picture.graph(axis, heading_deg, error[axis]), 5, contender.colour, 2);
  }
}

// The end of a table's line: the spot's mean, which is added to those of all spots.
void print_mean(Contender& contender, int headings) {
  const std::string share = contender.fixes < headings ? fmt::format(" ({}/{})", contender.fixes, headings) : "";
  fmt::print("{:>8}{:8}", contender.fixes > 0 ? fmt::format("{:.2f}", 100.0 * contender.sum / contender.fixes) : "-",
             share);
  contender.all += contender.sum;
  contender.all_fixes += contender.fixes;
  contender.sum = contender.fixes = 0;
}

bool turn_on_spots(double yaw_deg, char graph_spot, const std::string& out) {
  const omni::Rig drawing = omni::read_rig(data_file("rigs/movis.yaml"));
  omni::Rig built = drawing;
  built.cameras[0].yaw += radians(yaw_deg);
  const Field field = read_field(data_file("fields/paper.yaml"));
  sim::Renderer renderer(built, {field, {}, {}}, control::read_robot(data_file("robots/miniature.yaml")),
                         sim::read_look(data_file("looks/hall.yaml")));
  std::vector<Contender> contenders;
  const vpColor colours[] = {vpColor::red, vpColor::purple, vpColor::blue, vpColor::darkGreen};
  for (const std::string_view name : localization::localizer_names()) {
    contenders.push_back({std::string(name), localization::find_localizer(name), colours[contenders.size() % 4]});
  }
  pipeline::Pipeline pipeline(drawing, field, scan::read_colours(data_file("colours/default.yaml")), {},
                              contenders.back().localizer);
  Picture picture;
  draw_frame(picture, field, graph_spot);
  fmt::print("mean, cm");
  for (const Contender& contender : contenders) fmt::print("{:>8}{:8}", contender.name, "");
  constexpr int kHeadings = 24;
  std::uint64_t noise_seed = 1;
  for (const auto& [spot, place] : kSpots) {
    fmt::print("\n{:8}", spot);
    for (int i = 0; i < kHeadings; ++i) {
      const Pose2 truth{place.x(), place.y(), wrap_angle(2.0 * kPi * i / kHeadings)};
      grab::FrameSet images;
      renderer.render({0.0, truth, {0.0, 0.0, 1000.0}}, noise_seed++, images);  // the ball: where no camera sees it
      const pipeline::Estimate& seen = step(pipeline, images);                  // scanned once; then a fix by each
      for (Contender& contender : contenders) {
        const Fix fix =
            contender.localizer.fix({pipeline.rig, seen.bearings, seen.goals, seen.lines}, *pipeline.map, {});
        judge(contender, fix, truth, spot == graph_spot, picture);
      }
    }
    for (Contender& contender : contenders) print_mean(contender, kHeadings);
  }
  double text_row = 10.0;
  fmt::print("\n");
  for (const Contender& contender : contenders) {
    fmt::print("{}: {:.2f} cm over {} fixes of {}\n", contender.name, 100.0 * contender.mean(), contender.all_fixes,
               kHeadings * kSpots.size());
    std::string label = contender.name;  // in capitals: ViSP 3.5's font oversteps its memory at some descenders
    std::transform(label.begin(), label.end(), label.begin(), ::toupper);
    vpFont(14).drawText(picture.image, label, vpImagePoint(text_row += 18.0, 865.0), contender.colour);
  }
  tutorial::write_picture(picture.image, out);
  return contenders[2].mean() < 0.10 && contenders.back().mean() < contenders[2].mean();
}

int main(int argc, char** argv) {
  CLI::App arguments("Turns the robot on nine spots and compares localizers", "tutorial-self-localization");
  std::string out = "tutorial-self-localization.png", spot = "A";
  double yaw_deg = 0.0;
  arguments.add_option("--yaw", yaw_deg, "By how much the first camera is turned, degrees")->capture_default_str();
  arguments.add_option("--spot", spot, "Of the graph: A to I")
      ->check(CLI::IsMember({"A", "B", "C", "D", "E", "F", "G", "H", "I"}))
      ->capture_default_str();
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv, [&] { return turn_on_spots(yaw_deg, spot[0], out); });
}
