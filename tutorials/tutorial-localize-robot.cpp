// From the goals to the robot's pose: the paper's three methods beside a localizer of your own.
//
// Scenario: the robot stands on the paper's field, near the spots of Fig. 6, and sees both goals. The pipeline scans
// the images and triangulates the goals' centres and edges; every localizer then makes a pose of the same landmarks.
//
//   world_from_robot  (X_R, Y_R, β): the robot's place in the field frame, metres, and the angle from the field's X
//                     axis to the robot's x axis, radians, printed in degrees: (5)–(6)
//   p, q              centres of the yellow and the blue goal, robot frame, metres
//   P1, P2, Q1, Q2    the goals' edges, at X = ±(Fw + wall), Y = ±Fd in the field frame, metres
//   method1           from p and q: (7)–(11)
//   method2           from the angles under which the goals appear: (12)–(18)
//   composed          X and β of method 1, Y of method 2: (19)–(20)
//   posts             yours: the rigid motion that brings the four measured edges r closest to where they are, f, in
//                     least squares. As Σ f = 0:  β = atan2(Σ r × f, Σ r · f),  (X_R, Y_R) = −R(β) mean(r);
//                     the planar case of S. Umeyama, IEEE PAMI 13(4), 1991, without scale
//
// Source: the MOVIS paper, section 3; what its text has wrong is corrected in movis/localization/method1.h, method2.h.

#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>

#include "common.h"
#include "movis/localization/localizer.h"
#include "movis/pipeline/pipeline.h"

using namespace movis;
using Eigen::Vector2d;

// Your localizer: a function of this signature is all it takes; of the instant it may also use the bearings. A geometry
// that cannot be solved is a status. The covariance is left out here, but whoever fuses the fix with others needs it:
// see movis/localization/method1.h.
Fix posts(const localization::Instant& instant, const localization::FieldMap& map, const localization::Options&) {
  const triangulation::GoalPoints &yellow = instant.goals.yellow, &blue = instant.goals.blue;
  const Field& field = map.field;
  Fix fix;
  fix.status = FixStatus::no_distance;
  if (yellow.edges_status != PointStatus::ok || blue.edges_status != PointStatus::ok) return fix;
  const double w = field.Fw + field.goal_thickness;
  const Vector2d in_robot[] = {yellow.left, yellow.right, blue.right, blue.left};  // P1, P2, Q1, Q2
  const Vector2d in_field[] = {{-w, field.Fd}, {w, field.Fd}, {-w, -field.Fd}, {w, -field.Fd}};
  double dot = 0.0, cross = 0.0;
  Vector2d mean = Vector2d::Zero();
  for (int i = 0; i < 4; ++i) {
    dot += in_robot[i].dot(in_field[i]);
    cross += in_robot[i].x() * in_field[i].y() - in_robot[i].y() * in_field[i].x();
    mean += 0.25 * in_robot[i];
  }
  const Pose2 turn_only{0.0, 0.0, std::atan2(cross, dot)};
  const Vector2d place = turn_only * Vector2d(-mean);
  fix.status = FixStatus::ok;
  fix.world_from_robot = {place.x(), place.y(), turn_only.beta};
  return fix;
}

struct Contender {
  const char* name;
  localization::Localizer localizer;
  vpColor colour;
  double error_sum = 0.0;  // of the position, metres
  int fixes = 0;

  double mean_error() const { return fixes > 0 ? error_sum / fixes : HUGE_VAL; }
};

// The field from above, 120 pixels a metre.
struct Plan {
  vpImagePoint at(const Vector2d& point) const { return {120.0 * (2.5 - point.y()), 120.0 * (2.1 + point.x())}; }
  vpImage<vpRGBa> image{600, 504, vpRGBa(255, 255, 255)};
};

void draw_field(Plan& plan, const Field& field) {
  const auto box = [&](const Vector2d& a, const Vector2d& b, const vpColor& colour) {
    vpImageDraw::drawRectangle(plan.image, vpRect(plan.at(a), plan.at(b)), colour, false, 2);
  };
  const double back = field.Fd + field.goal_depth;
  box({-field.half_width, -field.half_length}, {field.half_width, field.half_length}, vpColor::lightGray);
  box({-field.Fw, field.Fd}, {field.Fw, back}, vpColor::orange);
  box({-field.Fw, -back}, {field.Fw, -field.Fd}, vpColor::blue);
}

void draw_truth(Plan& plan, const Pose2& world_from_robot) {
  const vpImagePoint place = plan.at(world_from_robot.translation());
  vpImageDraw::drawCircle(plan.image, place, 9, vpColor::black);
  vpImageDraw::drawLine(plan.image, place, plan.at(world_from_robot * Vector2d(0.0, 0.3)), vpColor::black);  // forward
}

// One line of the table.
void judge(Contender& contender, const Fix& fix, const Pose2& truth, Plan& plan) {
  if (fix.status != FixStatus::ok) {
    fmt::print("    {:9}{}\n", contender.name, word(fix.status));
    return;
  }
  const Pose2& pose = fix.world_from_robot;
  const double error = (pose.translation() - truth.translation()).norm();
  contender.error_sum += error;
  ++contender.fixes;
  fmt::print("    {:9}{:8.3f}{:9.3f}{:9.2f}°{:9.1f}{:9.1f}{:9.2f}°\n", contender.name, pose.x, pose.y,
             degrees(pose.beta), 100.0 * (pose.x - truth.x), 100.0 * (pose.y - truth.y),
             degrees(turn(truth.beta, pose.beta)));
  vpImageDraw::drawCross(plan.image, plan.at(pose.translation()), 9, contender.colour, 2);
}

bool localize(const std::filesystem::path& folder, const std::string& out) {
  grab::DatasetSource source(grab::read_dataset(folder));
  const Field field = read_field(folder / "field.yaml");
  const auto truths = grab::read_truth(folder / "truth.csv");
  const scan::Colours colours = scan::read_colours(data_file("colours/default.yaml"));
  Contender contenders[] = {{"method1", localization::find_localizer("method1"), vpColor::red},
                            {"method2", localization::find_localizer("method2"), vpColor::purple},
                            {"composed", localization::find_localizer("composed"), vpColor::blue},
                            {"posts", {posts}, vpColor::darkGreen}};
  pipeline::Pipeline pipeline(source.dataset().rig, field, colours, pipeline::Options{}, {posts});
  Plan plan;
  draw_field(plan, field);

  fmt::print("{:12}{:>9}{:>9}{:>10}{:>9}{:>9}{:>11}\n", "", "X, m", "Y, m", "heading", "dX, cm", "dY, cm", "d heading");
  source.open();
  for (grab::FrameSet set; source.acquire(set);) {
    const pipeline::Estimate& estimate = step(pipeline, set);  // estimate.fix is already that of `posts`
    const Pose2 truth = truths.at(set.index).world_from_robot;
    fmt::print("{:3} {:9}{:8.3f}{:9.3f}{:9.2f}°\n", set.index, "true", truth.x, truth.y,
               degrees(wrap_angle(truth.beta)));
    draw_truth(plan, truth);
    const localization::Instant instant{pipeline.rig, estimate.bearings, estimate.goals, estimate.lines};
    for (Contender& contender : contenders) judge(contender, contender.localizer.fix(instant, *pipeline.map, {}), truth, plan);
  }

  const vpFont font(14);
  double text_row = 185.0;
  for (const Contender& contender : contenders) {
    const std::string text = contender.fixes == 0
                                 ? fmt::format("{}: no fix", contender.name)
                                 : fmt::format("{}: mean position error {:.1f} cm of {} fixes", contender.name,
                                               100.0 * contender.mean_error(), contender.fixes);
    fmt::print("{}\n", text);
    font.drawText(plan.image, text, vpImagePoint(text_row += 20.0, 120.0), contender.colour);
  }
  tutorial::write_picture(plan.image, out);
  return contenders[2].mean_error() < 0.10;
}

int main(int argc, char** argv) {
  CLI::App arguments("Compares the paper's localizers with one of your own", "tutorial-localize-robot");
  std::string folder, out = "tutorial-localize-robot.png";
  arguments.add_option("--data", folder, "A data set with field.yaml and truth.csv; default: data/images/field");
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv,
                       [&] { return localize(folder.empty() ? data_file("images/field").string() : folder, out); });
}
