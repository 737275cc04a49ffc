#include "terms.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "movis/localization/goal_silhouette.h"
#include "movis/core/angle.h"

namespace movis::calibration {
namespace {

// Beside another sensor unit a part of the ball may be hidden: measured to be about three times worse.
constexpr double kNearSensorFactor = 3.0;

using Place = std::function<Eigen::Vector3d(const double* const* unknowns)>;

int add_ball(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
             const Bearing& bearing, std::vector<int> more_unknowns, Place place) {
  const auto pixel = pixel_of(drawing.believed[bearing.camera], {bearing.azimuth, bearing.elevation});
  if (!pixel) return -1;
  const Eigen::Matrix2d root = expected_covariance(bearing, drawing.options).llt().matrixL();
  const Eigen::Matrix2d whitening = root.inverse();
  const double bias_sigma = radians(drawing.options.elevation_bias_deg);
  Term term;
  term.frame = frame;
  term.camera = bearing.camera;
  term.kind = TermKind::ball;
  term.unknowns = {unknowns.cameras[bearing.camera], unknowns.elevation_bias};
  term.unknowns.insert(term.unknowns.end(), more_unknowns.begin(), more_unknowns.end());
  term.size = 2;
  term.root = root;
  term.residual = [&drawing, pixel = *pixel, whitening, bias_sigma, place, k = bearing.camera](
                      const double* const* blocks, double* residual) {
    const omni::Camera camera = candidate(drawing.cameras[k], drawing.options.prior, blocks[0]);
    const auto seen = direction_of(camera, pixel);
    if (!seen) return false;
    const Direction true_one = direction_of(place(blocks) - camera.position);
    Eigen::Map<Eigen::Vector2d>(residual, 2) =
        whitening * Eigen::Vector2d(turn(true_one.azimuth, seen->azimuth),
                                    seen->elevation - true_one.elevation - bias_sigma * blocks[1][0]);
    return true;
  };
  adjustment.terms.push_back(std::move(term));
  return static_cast<int>(adjustment.terms.size()) - 1;
}

}  // namespace

Drawing::Drawing(const omni::Rig& nominal, const omni::Rig& rig_believed, const RigOptions& options_used)
    : options(options_used) {
  for (const omni::Camera& camera : nominal.cameras) cameras.push_back(bare(camera));
  for (const omni::Camera& camera : rig_believed.cameras) believed.push_back(bare(camera));
}

bool useful_ball(const Bearing& bearing) {
  return bearing.object == ObjectClass::ball && (bearing.flags & ~kNearSensor) == 0;
}

bool useful_goal(const Bearing& bearing) {
  return (bearing.object == ObjectClass::yellow_goal || bearing.object == ObjectClass::blue_goal) && bearing.clean();
}

Eigen::Matrix2d expected_covariance(const Bearing& bearing, const RigOptions& options) {
  const Eigen::Array2d floor(radians(options.azimuth_floor_deg), radians(options.elevation_floor_deg));
  Eigen::Matrix2d covariance = bearing.covariance;
  covariance.diagonal() += floor.square().matrix();
  return (bearing.flags & kNearSensor) != 0 ? kNearSensorFactor * kNearSensorFactor * covariance : covariance;
}

int add_slip(Adjustment& adjustment, int frame, double place_sigma) {
  if (place_sigma <= 0.0) return -1;
  const int slip = adjustment.add_free(Eigen::Vector2d::Zero());
  Term term;
  term.frame = frame;
  term.camera = -1;
  term.kind = TermKind::place;
  term.unknowns = {slip};
  term.size = 2;
  term.root = place_sigma * Eigen::Matrix2d::Identity();
  term.residual = [](const double* const* blocks, double* residual) {
    residual[0] = blocks[0][0];
    residual[1] = blocks[0][1];
    return true;
  };
  adjustment.terms.push_back(std::move(term));
  return slip;
}

int add_known_ball(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
                   const Bearing& bearing, const Eigen::Vector3d& ball_in_robot, int slip) {
  if (slip < 0) {
    return add_ball(adjustment, drawing, unknowns, frame, bearing, {},
                    [ball_in_robot](const double* const*) { return ball_in_robot; });
  }
  return add_ball(adjustment, drawing, unknowns, frame, bearing, {slip},
                  [ball_in_robot, sigma = drawing.options.place_sigma](const double* const* blocks) {
                    const Eigen::Vector3d off(blocks[2][0], blocks[2][1], 0.0);
                    return Eigen::Vector3d(ball_in_robot + sigma * off);
                  });
}

int add_floor_ball(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
                   const Bearing& bearing, int ball) {
  return add_ball(adjustment, drawing, unknowns, frame, bearing, {ball},
                  [height = drawing.options.ball_radius](const double* const* blocks) {
                    const double distance = std::exp(blocks[2][1]);
                    return Eigen::Vector3d(distance * std::cos(blocks[2][0]), distance * std::sin(blocks[2][0]),
                                           height);
                  });
}

Eigen::Vector2d floor_place(const Eigen::VectorXd& ball) {
  return std::exp(ball[1]) * Eigen::Vector2d(std::cos(ball[0]), std::sin(ball[0]));
}

void add_goal(Adjustment& adjustment, const Drawing& drawing, const RigUnknowns& unknowns, int frame,
              const Bearing& bearing, const Field& field, int pose) {
  const double floor = radians(drawing.options.edge_floor_deg);
  const double bias_sigma = radians(drawing.options.edge_bias_deg);
  for (const bool left : {true, false}) {
    const double azimuth = left ? bearing.left : bearing.right;
    const auto pixel = pixel_of(drawing.believed[bearing.camera], {azimuth, bearing.elevation});
    if (!pixel) continue;
    const double sigma = std::sqrt((left ? bearing.left_variance : bearing.right_variance) + floor * floor);
    Term term;
    term.frame = frame;
    term.camera = bearing.camera;
    term.kind = left ? TermKind::left_edge : TermKind::right_edge;
    term.unknowns = {unknowns.cameras[bearing.camera], unknowns.edge_bias, pose};
    term.size = 1;
    term.root(0, 0) = sigma;
    term.residual = [&drawing, &field, pixel = *pixel, sigma, bias_sigma, left, goal = bearing.object,
                     k = bearing.camera](const double* const* blocks, double* residual) {
      const omni::Camera camera = candidate(drawing.cameras[k], drawing.options.prior, blocks[0]);
      const auto seen = direction_of(camera, pixel);
      if (!seen) return false;
      const Pose2 world_from_robot{blocks[2][0], blocks[2][1], blocks[2][2]};
      const localization::Silhouette true_one = localization::goal_silhouette(field, goal, world_from_robot * camera.position.head<2>());
      const double wider = bias_sigma * blocks[1][0];
      const double expected = left ? true_one.left + wider : true_one.right - wider;
      residual[0] = turn(expected, world_from_robot.beta + seen->azimuth) / sigma;
      return true;
    };
    adjustment.terms.push_back(std::move(term));
  }
}

}  // namespace movis::calibration
