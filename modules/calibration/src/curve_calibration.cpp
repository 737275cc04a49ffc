#include "movis/calibration/curve_calibration.h"

#include <ceres/ceres.h>

#include <cmath>

#include "movis/core/error.h"
#include "movis/core/median.h"
#include "movis/localization/line_pixel.h"

namespace movis::calibration {
namespace {

using localization::FieldMap;
using localization::LineFit;

constexpr double kWidths[] = {0.5, 0.25, 0.0, 0.0};  // s of the rounds, metres
constexpr double kNoiseScale = 3.0;                  // c in units of f σ
constexpr double kLargestSpread = 3.0;               // f: a larger one would let any line attract any pixel
constexpr double kUnseen = 1e3;                      // distance of a pixel that the curve shows no floor, metres

struct Pixel {
  Eigen::Vector2d pixel;
  double sigma;  // metres
};

// The start with the four numbers changed: a and b relatively, the centre by pixels.
omni::Radial changed(const omni::Radial& start, const double* change) {
  omni::Radial model = start;
  model.a *= 1.0 + change[0];
  model.b *= 1.0 + change[1];
  model.u0 += change[2];
  model.v0 += change[3];
  return model;
}

// Δ over its σ.
struct Expected {
  const CurveOptions& options;
  bool operator()(const double* change, double* residuals) const {
    residuals[0] = change[0] / options.sigma_a;
    residuals[1] = change[1] / options.sigma_b;
    residuals[2] = change[2] / options.sigma_centre_px;
    residuals[3] = change[3] / options.sigma_centre_px;
    return true;
  }
};

// d/σ of a pixel.
struct LineDistance {
  const omni::Camera& start;
  Eigen::Matrix3d robot_from_camera;
  const FieldMap& map;
  Pixel seen;

  bool operator()(const double* change, const double* pose, double* residual) const {
    *residual = kUnseen / seen.sigma;
    const auto ray_in_camera = unproject(changed(std::get<omni::Radial>(start.model), change), seen.pixel);
    if (!ray_in_camera) return true;
    const Eigen::Vector3d ray = robot_from_camera * *ray_in_camera;
    if (!(ray.z() < 0.0)) return true;
    const Eigen::Vector2d point = start.position.head<2>() - start.position.z() / ray.z() * ray.head<2>();
    *residual = map.lines.offset(Pose2{pose[0], pose[1], pose[2]} * point).distance / seen.sigma;
    return true;
  }
};

// ρ(q) = c² q/(c² + q) of the squared residual q: Lauer's error.
class LauerLoss : public ceres::LossFunction {
 public:
  explicit LauerLoss(double scale) : scale_(scale) {}
  void Evaluate(double squared, double* out) const override {
    const double near = scale_ / (scale_ + squared);
    out[0] = near * squared;
    out[1] = near * near;
    out[2] = -2.0 * near * near / (scale_ + squared);
  }

 private:
  double scale_;  // c²
};

double spread(const std::vector<LineDistance>& distances, const double* change, const double* pose) {
  std::vector<double> sizes;
  for (const LineDistance& distance : distances) {
    double residual = 0.0;
    distance(change, pose, &residual);
    sizes.push_back(std::abs(residual));
  }
  return std::clamp(kNormalMedian * median(sizes), 1.0, kLargestSpread);
}

void solve(std::vector<LineDistance>& distances, const CurveOptions& options, double s, double* change, double* pose) {
  ceres::Problem::Options ownership;
  ownership.enable_fast_removal = false;
  ceres::Problem problem(ownership);
  const double noise = kNoiseScale * spread(distances, change, pose);
  for (LineDistance& distance : distances) {
    const double wide = s / distance.seen.sigma;
    problem.AddResidualBlock(new ceres::NumericDiffCostFunction<LineDistance, ceres::CENTRAL, 1, 4, 3>(
                                 &distance, ceres::DO_NOT_TAKE_OWNERSHIP),
                             new LauerLoss(wide * wide + noise * noise), change, pose);
  }
  problem.AddResidualBlock(new ceres::NumericDiffCostFunction<Expected, ceres::CENTRAL, 4, 4>(new Expected{options}),
                           nullptr, change);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = 100;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
}

std::vector<LinePoint> on_floor(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& camera, double line) {
  std::vector<LinePoint> points;
  // Without a place on the floor the point has no sigma either: it is left out, but counts as such.
  for (const Eigen::Vector2d& pixel : pixels)
    points.push_back(localization::line_point(camera, 0, pixel, line).value_or(LinePoint{}));
  return points;
}

std::vector<LineDistance> distances_of(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& start,
                                       const FieldMap& map) {
  const double largest_sigma = localization::LineMatchOptions{}.largest_sigma;
  std::vector<LineDistance> distances;
  for (const Eigen::Vector2d& pixel : pixels) {
    const auto point = localization::line_point(start, 0, pixel, map.field.line);
    if (point && point->sigma_on_floor <= largest_sigma)
      distances.push_back({start, start.robot_from_camera(), map, {pixel, point->sigma_on_floor}});
  }
  return distances;
}

constexpr const char* kWhatToDo =
    "is it the field, and the camera, of the picture? If so, give the rig a start nearer to the truth";

void refuse_what_fits_badly(const LineFit& fit, std::size_t pixels, const std::string& camera) {
  if (fit.fix.status == FixStatus::ok) return;
  if (fit.fix.status == FixStatus::no_landmark) {
    throw Error("camera {}: no curve is told by {} white-line pixels (no_landmark); give more, of several lines",
                camera, pixels);
  }
  throw Error("no curve explains the {} white-line pixels of camera {} ({}); {}", pixels, camera, word(fit.fix.status),
              kWhatToDo);
}

// A curve that must leave what is known of it to bring the pixels onto lines brings them onto wrong ones.
void refuse_large_changes(const double* change, const CurveOptions& options, const std::string& camera) {
  const auto refuse = [&](const char* name, double by, double sigma, const char* unit) {
    if (std::abs(by) <= options.most_sigmas * sigma) return;
    throw Error(
        "camera {}: only a curve with {} changed by {:.3g}{} brings the pixels onto lines, more than {} times "
        "the {:.3g}{} that one differs by; {}",
        camera, name, by, unit, options.most_sigmas, sigma, unit, kWhatToDo);
  };
  refuse("a", 100.0 * change[0], 100.0 * options.sigma_a, " %");
  refuse("b", 100.0 * change[1], 100.0 * options.sigma_b, " %");
  refuse("u0", change[2], options.sigma_centre_px, " px");
  refuse("v0", change[3], options.sigma_centre_px, " px");
}

// Pixels that fill the lines lie within half a line from its middle, but for what a pixel is on the floor.
void refuse_large_distances(double median_distance, const std::vector<LineDistance>& distances, double line,
                            const std::string& camera) {
  std::vector<double> sigmas;
  for (const LineDistance& distance : distances) sigmas.push_back(distance.seen.sigma);
  const double sigma = median(sigmas);
  const double pixel = std::sqrt(std::max(0.0, sigma * sigma - line * line / 12.0)) / kNormalMedian;
  const double limit = std::hypot(0.5 * line, pixel);
  if (median_distance <= limit) return;
  throw Error(
      "camera {}: the best curve leaves the pixels {:.3f} m from the lines in the median, more than the {:.3f} m "
      "that half a line and a pixel explain; {}",
      camera, median_distance, limit, kWhatToDo);
}

}  // namespace

CurveCalibration calibrate_curve(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& start,
                                 const FieldMap& map, const CurveOptions& options) {
  const auto* model = std::get_if<omni::Radial>(&start.model);
  if (model == nullptr) {
    throw Error("camera {} has the model {}; a curve is what a radial one has", start.name, omni::name(start.model));
  }
  localization::LineMatchScratch scratch;
  CurveCalibration result;
  result.before = find_by_lines(on_floor(pixels, start, map.field.line), map, {}, scratch);
  std::vector<LineDistance> distances = distances_of(pixels, start, map);
  const Pose2& found = result.before.fix.world_from_robot;
  double change[4] = {0.0, 0.0, 0.0, 0.0};
  double pose[3] = {found.x, found.y, found.beta};
  if (result.before.support > 0.0)
    for (const double s : kWidths) solve(distances, options, s, change, pose);

  result.camera = start;
  result.camera.model = changed(*model, change);
  result.after = match_lines(on_floor(pixels, result.camera, map.field.line), map,
                             {pose[0], pose[1], wrap_angle(pose[2])}, {}, scratch);
  refuse_what_fits_badly(result.after, pixels.size(), start.name);
  refuse_large_changes(change, options, start.name);
  refuse_large_distances(result.after.median, distances, map.field.line, start.name);
  result.world_from_robot = result.after.fix.world_from_robot;
  result.pixels = result.after.points;
  return result;
}

double median_distance(const std::vector<Eigen::Vector2d>& pixels, const omni::Camera& camera, const Pose2& pose,
                       const FieldMap& map) {
  const double largest_sigma = localization::LineMatchOptions{}.largest_sigma;
  std::vector<double> sizes;
  for (const LinePoint& point : on_floor(pixels, camera, map.field.line))
    if (point.sigma_on_floor > 0.0 && point.sigma_on_floor <= largest_sigma)
      sizes.push_back(std::abs(map.lines.offset(pose * point.point).distance));
  return median(sizes);
}

}  // namespace movis::calibration
