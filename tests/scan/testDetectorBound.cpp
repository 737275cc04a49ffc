// How near the scan's bearings of a ball come to what their pixels hold: the Cramér–Rao bound (docs/bound.md) with the
// contrast measured in each picture. On noisy copies of ray-traced pictures; prints a table. MOVIS_COPIES in the
// environment sets how many copies.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include "movis/core/paths.h"
#include "movis/grab/dataset_source.h"
#include "movis/grab/truth.h"
#include "movis/grab/views.h"
#include "movis/scan/scanner.h"
#include "movis/triangulation/cramer_rao.h"
#include "support/degrade.h"
#include "support/outline_contrast.h"
#include "support/shared_data.h"

namespace movis::scan {
namespace {

using Eigen::Array2d;
using Eigen::Vector3d;

constexpr double kBallRadius = 0.11;
constexpr double kBlur = 0.6;                           // pixels
constexpr double kNoise = 2.0;                          // grey levels
constexpr double kBands[] = {0.0, 1.5, 3.0, 4.5, 6.0};  // metres

int copies() {
  const char* chosen = std::getenv("MOVIS_COPIES");
  return chosen != nullptr ? std::max(2, std::atoi(chosen)) : 8;
}

// One camera's picture of one ball, over its noisy copies: azimuth and elevation.
struct Sight {
  double distance = 0.0;            // of the ball from the robot, metres
  Array2d bound = Array2d::Zero();  // variances, rad²
  Array2d bias = Array2d::Zero();   // mean error, radians
  Array2d variance = Array2d::Zero();
};

// The pixels that move the bearing. The others are left as they are, without blur and noise, which saves most of the
// time.
cv::Rect around_ball(const omni::Camera& camera, const Vector3d& ball, const cv::Size& size) {
  const Eigen::Vector2d middle = project(camera, ball).value();
  const double reach = 260.0 * std::asin(kBallRadius / (ball - camera.position).norm()) + 12.0;
  const cv::Rect box(static_cast<int>(middle.x() - reach), static_cast<int>(middle.y() - reach),
                     static_cast<int>(2.0 * reach), static_cast<int>(2.0 * reach));
  return box & cv::Rect({0, 0}, size);
}

std::optional<Bearing> find_ball(Scanner& scanner, const cv::Mat& image, std::vector<Bearing>& bearings) {
  bearings.clear();
  scanner.scan(grab::view_of(image), 0.0, bearings);
  for (const Bearing& bearing : bearings) {
    if (bearing.object == ObjectClass::ball && bearing.clean()) return bearing;
  }
  return std::nullopt;
}

// Nothing where the ball is not found in each of the copies, or only with a flag: then a part of it may be hidden.
std::optional<Sight> look(const omni::Camera& camera, Scanner& scanner, cv::Mat image, const Vector3d& ball,
                          RandomStream& random) {
  constexpr double kAway = 2.5;  // pixels: outside the blur, and within the smallest balls
  cv::Mat part = image(around_ball(camera, ball, image.size()));
  cv::GaussianBlur(part, part, cv::Size(), kBlur);
  const double contrast = test::outline_contrast(image, camera, ball, kBallRadius, kAway);
  const Eigen::Matrix3d bound = triangulation::bearing_bound(camera, ball, kBallRadius, {contrast, kNoise, kBlur});
  const Vector3d offset = ball - camera.position;
  const cv::Mat clean = part.clone();
  std::vector<Bearing> bearings;
  std::vector<Array2d> errors;
  for (int copy = 0; copy < copies(); ++copy) {
    cv::Mat noisy = clean.clone();
    test::degrade(noisy, {0.0, kNoise}, random);
    noisy.copyTo(part);
    const auto bearing = find_ball(scanner, image, bearings);
    if (!bearing) return std::nullopt;
    errors.emplace_back(turn(std::atan2(offset.y(), offset.x()), bearing->azimuth),
                        bearing->elevation - std::atan2(offset.z(), offset.head<2>().norm()));
  }
  Sight sight;
  sight.distance = ball.head<2>().norm();
  sight.bound = bound.diagonal().head<2>();
  for (const Array2d& error : errors) sight.bias += error / static_cast<double>(errors.size());
  for (const Array2d& error : errors) {
    sight.variance += (error - sight.bias).square() / static_cast<double>(errors.size() - 1);
  }
  return sight;
}

std::vector<Sight> look_at(const std::filesystem::path& folder) {
  grab::DatasetSource source(grab::read_dataset(folder));
  const auto truth = grab::read_truth(folder / "truth.csv");
  const omni::Rig& rig = source.dataset().rig;
  const Colours colours = read_colours(data_file("colours/default.yaml"));
  std::vector<Scanner> scanners;
  scanners.reserve(rig.cameras.size());
  for (int k = 0; k < static_cast<int>(rig.cameras.size()); ++k) scanners.emplace_back(rig, k, colours, ScanOptions{});
  RandomStream random = make_stream(1, 0);
  std::vector<Sight> sights;
  source.open();
  for (grab::FrameSet images; source.acquire(images);) {
    const grab::Truth& at = truth.at(images.index);
    Vector3d ball = at.ball_in_field;
    ball.head<2>() = inverse(at.world_from_robot) * Eigen::Vector2d(at.ball_in_field.head<2>());
    for (std::size_t k = 0; k < rig.cameras.size(); ++k) {
      const auto sight = look(rig.cameras[k], scanners[k], images.memory[k], ball, random);
      if (sight) sights.push_back(*sight);
    }
  }
  return sights;
}

// Root mean squares, degrees, but for the ratios, which are of each sight's own variances.
struct Summary {
  int sights = 0;
  Array2d bound = Array2d::Zero(), scatter = Array2d::Zero();
  Array2d common = Array2d::Zero(), own = Array2d::Zero();  // the bias: its mean, and what each sight has beside it
  Array2d scatter_ratio = Array2d::Zero(), total_ratio = Array2d::Zero();
};

Summary summarize(const std::vector<Sight>& sights, double from, double to) {
  Summary summary;
  for (const Sight& sight : sights) {
    if (sight.distance < from || sight.distance >= to) continue;
    ++summary.sights;
    summary.bound += sight.bound;
    summary.scatter += sight.variance;
    summary.common += sight.bias;
    summary.own += sight.bias.square();
    summary.scatter_ratio += sight.variance / sight.bound;
    summary.total_ratio += (sight.variance + sight.bias.square()) / sight.bound;
  }
  for (Array2d* sum : {&summary.bound, &summary.scatter, &summary.common, &summary.own, &summary.scatter_ratio,
                       &summary.total_ratio}) {
    *sum /= std::max(1, summary.sights);
  }
  summary.own = (summary.own - summary.common.square()).max(0.0);
  for (Array2d* square :
       {&summary.bound, &summary.scatter, &summary.own, &summary.scatter_ratio, &summary.total_ratio}) {
    *square = square->sqrt();
  }
  for (Array2d* angle : {&summary.bound, &summary.scatter, &summary.common, &summary.own}) *angle *= degrees(1.0);
  return summary;
}

void print_row(double from, double to, const Summary& summary) {
  for (int i = 0; i < 2; ++i) {
    std::printf("  %3.1f–%3.1f m %4d  %-9s  %7.4f° %7.4f°  %+7.4f° %7.4f°  %7.2f %7.2f\n", from, to, summary.sights,
                i == 0 ? "azimuth" : "elevation", summary.bound[i], summary.scatter[i], summary.common[i],
                summary.own[i], summary.scatter_ratio[i], summary.total_ratio[i]);
  }
}

// Below the bound no unbiased detector can be, but for chance, and for what the bound itself is worth: 10 % of a sigma
// against rendered pictures (testBearingBoundPictures).
TEST(DetectorBound, OpenFloorWithBlurAndNoise) {
  const auto folder = test::shared_data() / "pov/open";
  MOVIS_NEEDS_SHARED_DATA(folder);
  const std::vector<Sight> sights = look_at(folder);
  ASSERT_GT(sights.size(), 60U);
  std::printf(
      "  %d copies. One sigma each; bias: the mean of all sights, and the spread of each sight's own around it\n"
      "  range     sights                bound  scatter    common     own  /bound: scatter total\n",
      copies());
  for (std::size_t i = 0; i + 1 < std::size(kBands); ++i) {
    print_row(kBands[i], kBands[i + 1], summarize(sights, kBands[i], kBands[i + 1]));
  }
  const Summary all = summarize(sights, 0.0, 100.0);
  print_row(0.0, 6.0, all);
  const double freedoms = static_cast<double>(sights.size()) * (copies() - 1);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(all.scatter_ratio[i], 0.9 * (1.0 - 4.0 * std::sqrt(0.5 / freedoms))) << i;
    EXPECT_LT(all.scatter_ratio[i], 3.0) << i;
  }
}

}  // namespace
}  // namespace movis::scan
