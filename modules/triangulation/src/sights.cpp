#include "sights.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::RowVector3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLeastVariance = 1e-16;  // rad²: what an angle is exact to at most

// Upper triangular U with UᵀU = Σ⁻¹: the rows of U r are independent and of unit variance. By elimination from the last
// variable to the first, so that without a radius its row is simply left out.
Matrix3d whitener_of(const Bearing& bearing, bool with_radius, double factor) {
  const double scale = factor * factor;
  double aa = std::max(scale * bearing.covariance(0, 0), kLeastVariance);
  double ae = scale * bearing.covariance(0, 1);
  double ee = std::max(scale * bearing.covariance(1, 1), kLeastVariance);
  Matrix3d u = Matrix3d::Zero();
  if (with_radius) {
    const double rr = std::max(scale * bearing.radius_variance, kLeastVariance);
    const double ar = scale * bearing.radius_covariance.x();
    const double er = scale * bearing.radius_covariance.y();
    u(2, 2) = 1.0 / std::sqrt(rr);
    // What is left of (azimuth, elevation) once the radius is known, and how they follow from it.
    aa = std::max(aa - ar * ar / rr, kLeastVariance);
    ae -= ar * er / rr;
    ee = std::max(ee - er * er / rr, kLeastVariance);
    u(0, 2) = -ar / rr;
    u(1, 2) = -er / rr;
  }
  const double along = ae / ee;  // of the azimuth by the elevation
  const double own = std::max(aa - ae * along, kLeastVariance);
  const double by_elevation = 1.0 / std::sqrt(ee);
  const double by_azimuth = 1.0 / std::sqrt(own);
  u.row(0) = RowVector3d(1.0, -along, u(0, 2) - along * u(1, 2)) * by_azimuth;
  u.row(1) = RowVector3d(0.0, 1.0, u(1, 2)) * by_elevation;
  return u;
}

Sight sight_of(const omni::Camera& camera, const Bearing& bearing, const JointOptions& options) {
  Sight sight;
  sight.bearing = &bearing;
  sight.position = camera.position;
  sight.cos_azimuth = std::cos(bearing.azimuth);
  sight.sin_azimuth = std::sin(bearing.azimuth);
  sight.cos_elevation = std::cos(bearing.elevation);
  sight.sin_elevation = std::sin(bearing.elevation);
  sight.has_radius = options.diameter && bearing.object == ObjectClass::ball && bearing.radius > 0.0;
  sight.cos_radius = sight.has_radius ? std::cos(bearing.radius) : 1.0;
  sight.sin_radius = sight.has_radius ? std::sin(bearing.radius) : 0.0;
  sight.whitener = whitener_of(bearing, sight.has_radius, bearing.clean() ? 1.0 : options.flagged_factor);
  return sight;
}

// Normal equations of the point and of the biases, these in units of their sigmas: rows of unit variance are added.
struct Normal {
  Matrix3d pp = Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> pb = Eigen::Matrix<double, 3, 2>::Zero();
  Matrix2d bb = Matrix2d::Identity();  // the biases' prior
  Vector3d pr = Vector3d::Zero();
  Vector2d br = Vector2d::Zero();
  double rr = 0.0;

  void add(const RowVector3d& by_point, const Eigen::RowVector2d& by_bias, double residual) {
    pp.noalias() += by_point.transpose() * by_point;
    pb.noalias() += by_point.transpose() * by_bias;
    bb.noalias() += by_bias.transpose() * by_bias;
    pr += by_point.transpose() * residual;
    br += by_bias.transpose() * residual;
    rr += residual * residual;
  }

  void add(const RowVector3d& by_point, double residual) {
    pp.noalias() += by_point.transpose() * by_point;
    pr += by_point.transpose() * residual;
    rr += residual * residual;
  }
};

// A step towards the minimum, with the biases eliminated.
struct Step {
  bool solved = false;
  Vector3d step;
  Matrix3d information, covariance;
  double chi2;
};

Step solve(const Normal& normal) {
  Step result;
  const double determinant = normal.bb(0, 0) * normal.bb(1, 1) - normal.bb(0, 1) * normal.bb(1, 0);  // at least 1
  Matrix2d bb_inverse;
  bb_inverse << normal.bb(1, 1), -normal.bb(0, 1), -normal.bb(1, 0), normal.bb(0, 0);
  bb_inverse /= determinant;
  const Eigen::Matrix<double, 3, 2> share = normal.pb * bb_inverse;
  result.information = normal.pp - share * normal.pb.transpose();
  const Vector3d gradient = normal.pr - share * normal.br;
  bool invertible = false;
  result.information.computeInverseWithCheck(result.covariance, invertible, 0.0);
  if (!invertible || !result.covariance.allFinite() || !(result.covariance.diagonal().minCoeff() > 0.0)) return result;
  result.step = result.covariance * gradient;
  result.chi2 = normal.rr - normal.br.dot(bb_inverse * normal.br) - gradient.dot(result.step);
  result.solved = result.step.allFinite();
  return result;
}

// A sight's residuals at a point, with their derivatives.
struct Seen {
  bool ahead = false;
  Vector3d residual;  // of azimuth, elevation and radius; measured less predicted, radians
  Matrix3d by_point;  // of what is predicted
};

Seen see(const Sight& sight, const Vector3d& point, double ball_radius) {
  Seen seen;
  const Vector3d o = point - sight.position;
  const double h2 = o.head<2>().squaredNorm();
  const double h = std::sqrt(h2);
  const double d2 = h2 + o.z() * o.z();
  const double ahead = sight.cos_azimuth * o.x() + sight.sin_azimuth * o.y();
  const double across = sight.cos_azimuth * o.y() - sight.sin_azimuth * o.x();
  const double along = sight.cos_elevation * h + sight.sin_elevation * o.z();
  seen.ahead = ahead > 0.0 && along > 0.0;
  if (!seen.ahead) return seen;
  seen.residual.x() = -across / ahead;
  seen.residual.y() = -(sight.cos_elevation * o.z() - sight.sin_elevation * h) / along;
  seen.by_point.row(0) = RowVector3d(-o.y(), o.x(), 0.0) / h2;
  seen.by_point.row(1) = RowVector3d(-o.z() * o.x() / h, -o.z() * o.y() / h, h) / d2;
  if (sight.has_radius) {
    const double beyond2 = d2 - ball_radius * ball_radius;
    if (!(beyond2 > 0.0)) {  // the camera is inside the ball
      seen.ahead = false;
      return seen;
    }
    const double d = std::sqrt(d2);
    const double beyond = std::sqrt(beyond2);
    seen.residual.z() = (sight.sin_radius * beyond - sight.cos_radius * ball_radius) / d;
    seen.by_point.row(2) = -ball_radius / (d2 * beyond) * o.transpose();
  }
  return seen;
}

// `bias` holds the sigmas of the biases.
void add_sight(const Sight& sight, const Seen& seen, const Vector2d& bias, Normal& normal) {
  const Matrix3d& u = sight.whitener;
  const auto by_point = [&](int row) -> RowVector3d { return u.row(row) * seen.by_point; };
  if (sight.has_radius) {
    for (int row = 0; row < 3; ++row) {
      normal.add(by_point(row), {u(row, 1) * bias.x(), u(row, 2) * bias.y()}, u.row(row) * seen.residual);
    }
    return;
  }
  normal.add(u(0, 0) * seen.by_point.row(0) + u(0, 1) * seen.by_point.row(1), {u(0, 1) * bias.x(), 0.0},
             u(0, 0) * seen.residual.x() + u(0, 1) * seen.residual.y());
  normal.add(u(1, 1) * seen.by_point.row(1), {u(1, 1) * bias.x(), 0.0}, u(1, 1) * seen.residual.y());
}

// The point that is nearest to all rays, distances across each ray weighted by its angles' sigmas. That the object lies
// near the floor is held loosely: it only helps where the rays say little.
Step start_from(const Sights& sights, const Reading& reading, const JointOptions& options) {
  constexpr double kLoose = 4.0;  // 1/m, beside some thousands for a metre across a ray
  Normal normal;
  for (int i = 0; i < sights.count; ++i) {
    if (!reading.takes(i)) continue;
    const Sight& s = sights.sight[i];
    const RowVector3d azimuth(-s.sin_azimuth, s.cos_azimuth, 0.0);
    const RowVector3d elevation(-s.sin_elevation * s.cos_azimuth, -s.sin_elevation * s.sin_azimuth, s.cos_elevation);
    const RowVector3d rows[] = {s.whitener(0, 0) * azimuth + s.whitener(0, 1) * elevation,
                                s.whitener(1, 1) * elevation};
    for (const RowVector3d& row : rows) normal.add(row, row * s.position);
  }
  if (reading.on_floor) normal.add(kLoose * RowVector3d::UnitZ(), kLoose * options.ball_radius);
  return solve(normal);
}

// Normal equations at a point, with what is kept of the residuals. False where it lies behind a camera.
bool linearize(const Sights& sights, const Reading& reading, const JointOptions& options, const Vector3d& point,
               Normal& normal, JointSolution& solution) {
  const Vector2d bias(radians(options.elevation_bias_deg), radians(options.radius_bias_deg));
  solution.dof = -3;
  solution.largest_residual = 0.0;
  for (int i = 0; i < sights.count; ++i) {
    if (!reading.takes(i)) continue;
    const Seen seen = see(sights.sight[i], point, options.ball_radius);
    if (!seen.ahead) return false;
    add_sight(sights.sight[i], seen, bias, normal);
    solution.dof += sights.sight[i].has_radius ? 3 : 2;
    solution.largest_residual =
        std::max({solution.largest_residual, std::abs(seen.residual.x()), std::abs(seen.residual.y())});
  }
  if (!reading.on_floor) return true;
  normal.add(RowVector3d::UnitZ() / options.floor_sigma, (options.ball_radius - point.z()) / options.floor_sigma);
  ++solution.dof;
  return true;
}

// Of the cameras that take part.
Vector3d centre_of(const Sights& sights, const Reading& reading) {
  Vector3d sum = Vector3d::Zero();
  int cameras = 0;
  for (int i = 0; i < sights.count; ++i) {
    if (!reading.takes(i)) continue;
    sum += sights.sight[i].position;
    ++cameras;
  }
  return sum / std::max(cameras, 1);
}

// The height without the floor differs from the floor's by what is left of the floor's residual, studentized.
double floor_score(const JointSolution& solution, const JointOptions& options) {
  constexpr double kUnknown = 1e-6;  // of the floor's variance: the bearings say nothing about the height
  const double floor_variance = options.floor_sigma * options.floor_sigma;
  const double variance = floor_variance - solution.covariance(2, 2);
  if (!(variance > kUnknown * floor_variance)) return 0.0;
  return (solution.point.z() - options.ball_radius) / std::sqrt(variance);
}

}  // namespace

void require_joint_rig(const omni::Rig& rig) {
  const std::size_t cameras = rig.cameras.size();
  if (cameras < 2) throw Error("triangulation needs a rig of two or more cameras; this one has {}", cameras);
  if (cameras > kMostCameras) {
    throw Error("joint triangulation takes up to {} cameras, this rig has {}; triangulate by pairs", kMostCameras,
                cameras);
  }
}

const omni::Camera& camera_of(const omni::Rig& rig, const Bearing& bearing) {
  if (bearing.camera < 0 || bearing.camera >= static_cast<int>(rig.cameras.size())) {
    throw Error("a bearing is of camera number {}, the rig has {} cameras", bearing.camera, rig.cameras.size());
  }
  return rig.cameras[bearing.camera];
}

Sights sights_of(const omni::Rig& rig, const std::vector<Bearing>& bearings, ObjectClass object,
                 const JointOptions& options) {
  Sights sights;
  for (const Bearing& bearing : bearings) {
    if (bearing.object != object) continue;
    const omni::Camera& camera = camera_of(rig, bearing);
    int place = 0;
    while (place < sights.count && sights.sight[place].bearing->camera != bearing.camera) ++place;
    if (place < sights.count && sights.sight[place].bearing->covariance(0, 0) <= bearing.covariance(0, 0)) continue;
    sights.sight[place] = sight_of(camera, bearing, options);
    sights.count = std::max(sights.count, place + 1);
  }
  return sights;
}

JointSolution solve(const Sights& sights, const Reading& reading, const JointOptions& options) {
  constexpr int kMostSteps = 15;
  constexpr double kSmallStep = 1e-8;     // squared, in sigmas
  constexpr double kMostRange = 1000.0;   // metres
  constexpr double kLeastParallax = 3.0;  // sigmas
  JointSolution solution;
  solution.status = PointStatus::parallel_rays;
  Step step = start_from(sights, reading, options);
  if (!step.solved) return solution;
  const Vector3d centre = centre_of(sights, reading);
  solution.point = step.step;
  for (int steps = 0;; ++steps) {
    Normal normal;
    if (!linearize(sights, reading, options, solution.point, normal, solution)) {
      solution.status = PointStatus::behind_camera;
      return solution;
    }
    step = solve(normal);
    if (!step.solved) return solution;
    // Bearings are linear in 1/range: a step beyond twice the range, or to the other side, would not come back.
    const double longest = 0.5 * (solution.point - centre).norm();
    const double length = step.step.norm();
    solution.point += length > longest ? Vector3d(longest / length * step.step) : step.step;
    if (step.step.dot(step.information * step.step) < kSmallStep) break;
    if (steps == kMostSteps || !(longest < kMostRange)) return solution;
  }
  solution.covariance = step.covariance;
  solution.chi2 = std::max(step.chi2, 0.0);
  if (reading.on_floor) solution.floor_score = floor_score(solution, options);
  const Vector3d sight = solution.point - centre;
  const double range2 = sight.squaredNorm();
  const double range_variance = sight.dot(solution.covariance * sight) / range2;
  if (kLeastParallax * kLeastParallax * range_variance <= range2) solution.status = PointStatus::ok;
  return solution;
}

}  // namespace movis::triangulation
