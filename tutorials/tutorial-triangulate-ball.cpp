// From the bearings of three cameras to the position of the ball, and how far that position can be trusted.
//
// Scenario: the robot stands at the origin of an open floor, the ball lies far away (data set `open`) or where a shot
// is decided (`near`). Each camera gives a bearing, the pair of cameras that looks across the ball's direction
// intersects two of them, and the bearings' covariance goes along.
//
//   L                  distance of the cameras from the robot's centre, metres; baseline of a pair B = √3 L
//   λ1, λ2             the bearings of (3)–(4), from the robot's x axis, radians; σ of one of them: sigma_bearing
//   (x_a, y_a)         the ball in the robot frame, metres: (3)–(4), the intersection of two lines, computed without
//                      tangents in movis/triangulation/pairs.h
//   ρ                  distance of the ball from the robot's centre, metres
//   parallax           p = λ2 − λ1 ≈ B/ρ, so ρ ≈ B/p and |dρ/dp| = B/p² = ρ²/B. Two independent bearings make
//                      σ_p = √2 σ_bearing, hence  σ_ρ ≈ √2 ρ²/B σ_bearing: twice as far is four times as uncertain,
//                      while the direction stays as good as a bearing. Rough where ρ is not much larger than B.
//
// Source: the MOVIS paper, section 2.4, equations (3)–(4); the rule for σ_ρ is derived above.

#include <visp3/core/vpFont.h>
#include <visp3/core/vpImageDraw.h>

#include <Eigen/Cholesky>
#include <numeric>

#include "common.h"
#include "movis/scan/scanner.h"
#include "movis/triangulation/pairs.h"

using namespace movis;
using Eigen::Vector2d;

// A floor of 8.4 m × 8.4 m, seen from above.
struct Plan {
  vpImagePoint at(const Vector2d& point) const { return {60.0 * (4.2 - point.y()), 60.0 * (4.2 + point.x())}; }
  vpImage<vpRGBa> image{504, 504, vpRGBa(255, 255, 255)};
};

void draw(Plan& plan, const omni::Rig& rig, const PointEstimate& ball, const Vector2d& truth) {
  for (const omni::Camera& camera : rig.cameras) {
    const Vector2d viewpoint = camera.position.head<2>();
    vpImageDraw::drawLine(plan.image, plan.at(viewpoint), plan.at(truth), vpColor(190, 190, 190));
    vpImageDraw::drawCircle(plan.image, plan.at(viewpoint), 2, vpColor::black);
  }
  vpImageDraw::drawCross(plan.image, plan.at(truth), 9, vpColor::black);
  const Eigen::Matrix2d root = Eigen::LLT<Eigen::Matrix2d>(ball.covariance.topLeftCorner<2, 2>()).matrixL();
  const auto on_ellipse = [&](int i) {  // one sigma, 100 times as large
    const Vector2d unit(std::cos(0.02 * kPi * i), std::sin(0.02 * kPi * i));
    return plan.at(ball.point.head<2>() + 100.0 * root * unit);
  };
  for (int i = 0; i < 100; ++i) {
    vpImageDraw::drawLine(plan.image, on_ellipse(i), on_ellipse(i + 1), vpColor::red);
  }
}

// √2 ρ²/B σ_bearing, with the σ of the best bearing: a camera that sees only a part of the ball is not asked.
double rule_of_thumb(double range, double baseline, const std::vector<Bearing>& bearings) {
  double variance = 1.0;
  for (const Bearing& bearing : bearings) {
    if (bearing.object == ObjectClass::ball) variance = std::min(variance, bearing.covariance(0, 0));
  }
  return std::sqrt(2.0 * variance) * range * range / baseline;
}

// The rest of a line of the table; the error, metres.
double compare(const PointEstimate& ball, const Vector2d& truth, double rule) {
  const Vector2d measured = ball.point.head<2>();
  const double error = (measured - truth).norm();
  const Vector2d along = measured.normalized();
  const double sigma_range = std::sqrt(along.dot(ball.covariance.topLeftCorner<2, 2>() * along));
  const double cross = truth.x() * measured.y() - truth.y() * measured.x();
  fmt::print("  ({:7.3f}, {:7.3f}){:7.2f}{:9.2f}{:8.2f}{:8.2f}{:10.3f}\n", measured.x(), measured.y(), 100.0 * error,
             100.0 * (measured.norm() - truth.norm()), 100.0 * sigma_range, 100.0 * rule,
             degrees(std::atan2(cross, truth.dot(measured))));
  return error;
}

// Measures the ball in every frame and appends the errors, metres.
void measure(const std::filesystem::path& folder, Plan& plan, std::vector<double>& errors) {
  grab::DatasetSource source(grab::read_dataset(folder));
  const auto truths = grab::read_truth(folder / "truth.csv");
  const omni::Rig& rig = source.dataset().rig;
  const double baseline = (rig.cameras[0].position - rig.cameras[1].position).norm();
  const scan::Colours colours = scan::read_colours(data_file("colours/default.yaml"));
  const int cameras = static_cast<int>(rig.cameras.size());
  std::vector<scan::Scanner> scanners;
  scanners.reserve(rig.cameras.size());
  for (int k = 0; k < cameras; ++k) scanners.emplace_back(rig, k, colours, scan::ScanOptions{});

  std::vector<Bearing> bearings;
  source.open();
  for (grab::FrameSet set; source.acquire(set);) {
    bearings.clear();
    for (int k = 0; k < cameras; ++k) {
      if (!set.frames[k].lost()) scanners[k].scan(set.frames[k].view, set.frames[k].time_s, bearings);
    }
    const PointEstimate ball = triangulation::triangulate_pairs(rig, bearings, ObjectClass::ball);

    const grab::Truth& known = truths.at(set.index);
    const Vector2d truth = tutorial::in_robot(known.world_from_robot, known.ball_in_field).head<2>();
    fmt::print("{:6}{:4}{:7.2f}  ({:7.3f}, {:7.3f})", folder.filename().string(), set.index, truth.norm(), truth.x(),
               truth.y());
    if (ball.status != PointStatus::ok) {
      fmt::print("  {}\n", word(ball.status));
      continue;
    }
    errors.push_back(compare(ball, truth, rule_of_thumb(truth.norm(), baseline, bearings)));
    draw(plan, rig, ball, truth);
  }
}

bool triangulate(const std::vector<std::string>& folders, const std::string& out) {
  Plan plan;
  std::vector<double> errors;
  fmt::print("{:6}{:>4}{:>7}{:>20}{:>20}{:>7}{:>9}{:>8}{:>8}{:>10}\n", "set", "no.", "range", "true x, y",
             "measured x, y", "error", "in range", "sigma", "rule", "direction");
  fmt::print("{:6}{:>4}{:>7}{:>20}{:>20}{:>7}{:>9}{:>8}{:>8}{:>10}\n", "", "", "m", "m", "m", "cm", "cm", "cm", "cm",
             "°");
  for (const std::string& folder : folders) measure(folder, plan, errors);
  vpFont(13).drawText(plan.image, "cross: true ball; red: one sigma, 100 times as large", vpImagePoint(5, 5),
                      vpColor::black);
  if (errors.empty()) throw Error("the ball was measured in no frame");
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
  fmt::print("mean error {:.2f} cm of {} balls\n", 100.0 * mean, errors.size());
  tutorial::write_picture(plan.image, out);
  return mean < 0.03;
}

int main(int argc, char** argv) {
  CLI::App arguments("Triangulates the ball and compares with the truth", "tutorial-triangulate-ball");
  std::vector<std::string> folders;
  std::string out = "tutorial-triangulate-ball.png";
  arguments.add_option("--data", folders, "Data sets with truth.csv; default: data/images/open and data/images/near");
  arguments.add_option("--out", out, "The picture")->capture_default_str();
  return tutorial::run(arguments, argc, argv, [&] {
    if (folders.empty()) folders = {data_file("images/open").string(), data_file("images/near").string()};
    return triangulate(folders, out);
  });
}
