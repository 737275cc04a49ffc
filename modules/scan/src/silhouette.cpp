#include "silhouette.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "membership.h"
#include "movis/core/angle.h"

namespace movis::scan {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Sample = RefineScratch::BorderSample;

constexpr double kReach = 5.0;  // pixels on either side of the outline that are looked at
constexpr double kMixed = 1.6;  // pixels: these are fitted
constexpr double kPure = 1.2;   // pixels: from here on the light is taken for unmixed
constexpr int kMostSectors = 64;

// The sphere's cone and the derivatives of its axis.
struct Frame {
  explicit Frame(const BallCone& cone) : cos_radius(std::cos(cone.radius)), sin_radius(std::sin(cone.radius)) {
    const double ca = std::cos(cone.azimuth);
    const double sa = std::sin(cone.azimuth);
    const double ce = std::cos(cone.elevation);
    const double se = std::sin(cone.elevation);
    axis = {ce * ca, ce * sa, se};
    by_azimuth = {-ce * sa, ce * ca, 0.0};
    by_elevation = {-se * ca, -se * sa, ce};
    across = {-sa, ca, 0.0};
  }

  double inside_of(const Sample& sample) const {  // d, pixels
    return (axis.dot(sample.ray) - cos_radius) / sample.gradient;
  }
  Eigen::Vector2d disc(const Sample& sample) const {  // across and up, in units of the disc's radius
    return Eigen::Vector2d(across.dot(sample.ray), by_elevation.dot(sample.ray)) / sin_radius;
  }

  double cos_radius, sin_radius;
  Vector3d axis, by_azimuth, by_elevation, across;
};

Vector3d ray_at(const PolarMap& map, int u, int v) {
  const PixelRay& ray = map.ray[map.index(u, v)];
  return {ray.x, ray.y, ray.z};
}

bool is_black(const Sample& sample) {
  return sample.light.maxCoeff() < kBlack;
}

// The pixels around the outline into scratch.border; the angle that one covers, or nothing where there are too few.
std::optional<double> collect_border(const ImageView& image, const PolarMap& map, const Box& box, const BallCone& start,
                                     std::vector<Sample>& border) {
  constexpr std::size_t kFewest = 30;
  const Frame frame(start);
  border.clear();
  double solid_angle = 0.0;
  for (int v = std::max(1, box.v_begin); v < std::min(map.height - 1, box.v_end); ++v) {
    for (int u = std::max(1, box.u_begin); u < std::min(map.width - 1, box.u_end); ++u) {
      const std::size_t index = map.index(u, v);
      const double own = map.ray[index].solid_angle;
      if (!(own > 0.0)) continue;
      const Vector3d ray = ray_at(map, u, v);
      const double slack = frame.axis.dot(ray) - frame.cos_radius;
      const double pixel = std::sqrt(own);
      // n·r changes by sin of the angle between them: at most that at the reach outside.
      const double most = 2.0 * kReach * pixel * (frame.sin_radius + 2.0 * kReach * pixel);
      if (std::abs(slack) > most) continue;
      if (!map.contains(u - 1, v) || !map.contains(u + 1, v) || !map.contains(u, v - 1) || !map.contains(u, v + 1)) {
        continue;
      }
      const double by_u = 0.5 * frame.axis.dot(ray_at(map, u + 1, v) - ray_at(map, u - 1, v));
      const double by_v = 0.5 * frame.axis.dot(ray_at(map, u, v + 1) - ray_at(map, u, v - 1));
      constexpr double kLeast = 0.2;  // of its value on the outline: it vanishes at the disc's centre
      const double gradient = std::max(std::hypot(by_u, by_v), kLeast * frame.sin_radius * pixel);
      if (std::abs(slack) > kReach * gradient || border.size() == border.capacity()) continue;
      const Light light = light_at(image, u, v);
      border.push_back({ray, {light.r, light.g, light.b}, gradient, 0.0, 0});
      solid_angle += own;
    }
  }
  if (border.size() < kFewest) return std::nullopt;
  return std::sqrt(solid_angle / static_cast<double>(border.size()));
}

// I: the ball's light over its disc.
struct Shading {
  static Vector4d base(const Eigen::Vector2d& disc) {
    return {1.0, disc.x(), disc.y(), std::sqrt(std::max(0.0, 1.0 - disc.squaredNorm()))};
  }
  Vector3d at(const Eigen::Vector2d& disc) const { return coefficients.transpose() * base(disc); }

  Eigen::Matrix<double, 4, 3> coefficients;
  Vector3d noise = Vector3d::Zero();  // variance that the fit leaves
};

std::optional<Shading> fit_shading(const Frame& frame, const std::vector<Sample>& border) {
  constexpr int kFewest = 5;
  constexpr double kLimbPrior = 0.1;    // pixels' worth of evidence that c3 is 0: a small disc cannot tell
  constexpr double kLeastNoise = 1e-6;  // about one grey level in the dark
  Matrix4d normal = Matrix4d::Zero();
  Eigen::Matrix<double, 4, 3> right = Eigen::Matrix<double, 4, 3>::Zero();
  int count = 0;
  for (const Sample& sample : border) {
    if (sample.inside <= kPure || is_black(sample)) continue;
    const Vector4d base = Shading::base(frame.disc(sample));
    normal += base * base.transpose();
    right += base * sample.light.transpose();
    ++count;
  }
  if (count < kFewest) return std::nullopt;
  normal += 1e-6 * Matrix4d::Identity();
  normal(3, 3) += kLimbPrior;
  Shading shading;
  shading.coefficients = normal.ldlt().solve(right);
  for (const Sample& sample : border) {
    if (sample.inside <= kPure || is_black(sample)) continue;
    shading.noise += (sample.light - shading.at(frame.disc(sample))).cwiseAbs2();
  }
  shading.noise = (shading.noise / std::max(1, count - 4)).array() + kLeastNoise;
  return shading;
}

// A part of the outline, with what surrounds the ball there.
struct Sector {
  bool used = false;
  bool contradicts = false;
  Vector3d outside = Vector3d::Zero();     // B
  Matrix3d scatter = Matrix3d::Zero();     // of the light outside
  int pixels = 0;                          // outside
  int black = 0;                           // of them
  Vector3d projection = Vector3d::Zero();  // h
  double weight = 0.0;                     // 1 / the variance of w
  double misfit = 0.0;                     // the mean of the squared residuals over their variance
  int fitted = 0;
};

struct Outline {
  std::array<Sector, kMostSectors> sectors;
  int count = 0;

  Sector* begin() { return sectors.data(); }
  Sector* end() { return sectors.data() + count; }
  double direction(int sector) const { return (sector + 0.5) / count * 2.0 * kPi - kPi; }
  int sector_of(const Eigen::Vector2d& disc) const {
    return static_cast<int>((std::atan2(disc.y(), disc.x()) + kPi) / (2.0 * kPi) * count) % count;
  }
};

// B and h of every sector.
void describe_sectors(const Frame& frame, const Shading& shading, double radius_px, std::vector<Sample>& border,
                      Outline& outline) {
  constexpr double kBallBrightness = 0.15;  // relative error of I's brightness
  constexpr double kBrightness = 0.3;       // of B's
  constexpr int kFewest = 3;                // pixels outside
  constexpr int kBlackShare = 5;            // one in
  constexpr double kLeastWeight = 25.0;     // a share that is known to 0.2
  constexpr double kMiddle = 0.7;           // pixels inside of the outline: where a mixed pixel's ball is
  for (Sector& sector : outline) {
    const bool contradicts = sector.contradicts;
    sector = {};
    sector.contradicts = contradicts;
  }
  for (Sample& sample : border) {
    sample.sector = outline.sector_of(frame.disc(sample));
    if (sample.inside >= -kPure) continue;
    Sector& sector = outline.sectors[sample.sector];
    sector.outside += sample.light;
    sector.scatter += sample.light * sample.light.transpose();
    sector.black += is_black(sample) ? 1 : 0;
    ++sector.pixels;
  }
  const double rim = std::max(0.3, 1.0 - kMiddle / radius_px);
  for (int i = 0; i < outline.count; ++i) {
    Sector& sector = outline.sectors[i];
    if (sector.contradicts || sector.pixels < kFewest || kBlackShare * sector.black > sector.pixels) continue;
    sector.outside /= sector.pixels;
    sector.scatter = sector.scatter / sector.pixels - sector.outside * sector.outside.transpose();
    const double direction = outline.direction(i);
    const Vector3d inside = shading.at(rim * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    // Where the pixel is half ball and half surroundings.
    Matrix3d covariance = 0.25 * (kBrightness * kBrightness * sector.outside * sector.outside.transpose() +
                                  kBallBrightness * kBallBrightness * inside * inside.transpose() + sector.scatter);
    covariance.diagonal() += shading.noise;
    const Vector3d contrast = inside - sector.outside;
    const Vector3d whitened = covariance.inverse() * contrast;
    sector.weight = contrast.dot(whitened);
    if (!(sector.weight > kLeastWeight)) continue;
    sector.projection = whitened / sector.weight;
    sector.used = true;
  }
}

// Sums over the mixed pixels, by (azimuth, elevation, radius, s).
struct Sums {
  Matrix4d information = Matrix4d::Zero();
  Vector4d gradient = Vector4d::Zero();
  double misfit = 0.0;  // the sum of the squared residuals over their variances
  int pixels = 0;
};

Sums sum_residuals(const Frame& frame, double width, const std::vector<Sample>& border, Outline& outline) {
  constexpr double kSqrtHalf = 0.70710678118654752;
  constexpr double kNormalPeak = 0.39894228040143268;  // 1/√(2π)
  Sums sums;
  for (Sector& sector : outline) {
    sector.misfit = 0.0;
    sector.fitted = 0;
  }
  for (const Sample& sample : border) {
    Sector& sector = outline.sectors[sample.sector];
    if (!sector.used) continue;
    const double inside = sample.inside;
    if (std::abs(inside) > kMixed) continue;
    const double x = inside / width;
    const double share = sector.projection.dot(sample.light - sector.outside);
    const double residual = share - 0.5 * std::erfc(-kSqrtHalf * x);
    const Vector4d by_parameters =
        kNormalPeak * std::exp(-0.5 * x * x) / width *
        Vector4d(frame.by_azimuth.dot(sample.ray) / sample.gradient,
                 frame.by_elevation.dot(sample.ray) / sample.gradient, frame.sin_radius / sample.gradient, -x);
    const double misfit = sector.weight * residual * residual;
    sums.information += sector.weight * by_parameters * by_parameters.transpose();
    sums.gradient += sector.weight * residual * by_parameters;
    sums.misfit += misfit;
    sector.misfit += misfit;
    ++sums.pixels;
    ++sector.fitted;
  }
  return sums;
}

// Marks the sectors whose pixels fit far worse than those of most others.
void find_contradictions(Outline& outline) {
  constexpr double kTimes = 9.0;      // three standard deviations
  constexpr double kLeastMean = 0.2;  // below it the covariances are generous, not the sectors alike
  std::array<double, kMostSectors> means{};
  int count = 0;
  for (const Sector& sector : outline) {
    if (sector.fitted > 0) means[count++] = sector.misfit / sector.fitted;
  }
  if (count == 0) return;
  std::nth_element(means.begin(), means.begin() + count / 2, means.begin() + count);
  const double limit = kTimes * std::max(kLeastMean, means[count / 2]);
  for (Sector& sector : outline) {
    if (sector.fitted > 0 && sector.misfit > limit * sector.fitted) sector.contradicts = true;
  }
}

}  // namespace

std::optional<BallCone> fit_silhouette(const ImageView& image, const PolarMap& map, const Box& box,
                                       const BallCone& start, RefineScratch& scratch) {
  constexpr int kRounds = 5;
  constexpr int kDescribedEvery = 2;  // rounds
  constexpr int kFewest = 12;         // mixed pixels
  constexpr double kArc = 4.0;        // pixels of the outline in a sector
  constexpr double kWidth = 0.5;      // s to start from, pixels; it is expected within 0.1 of it where nothing tells
  constexpr double kWidthInformation = 100.0;
  constexpr double kWidthMin = 0.25;
  constexpr double kWidthMax = 1.5;
  constexpr double kRadiusMax = 1.5;   // radians
  constexpr double kLeastScale = 0.3;  // of the variances that Σ tells, where the residuals are smaller

  std::vector<Sample>& border = scratch.border;
  const auto pixel = collect_border(image, map, box, start, border);
  if (!pixel) return std::nullopt;
  const double radius_px = start.radius / *pixel;
  Outline outline;
  outline.count = std::clamp(static_cast<int>(2.0 * kPi * radius_px / kArc), 8, kMostSectors);

  BallCone cone = start;
  double width = kWidth;
  for (int round = 0;; ++round) {
    const Frame frame(cone);
    for (Sample& sample : border) sample.inside = frame.inside_of(sample);
    if (round % kDescribedEvery == 0) {
      const auto shading = fit_shading(frame, border);
      if (!shading) return std::nullopt;
      describe_sectors(frame, *shading, radius_px, border, outline);
    }
    Sums sums = sum_residuals(frame, width, border, outline);
    if (sums.pixels < kFewest) return std::nullopt;
    sums.information(3, 3) += kWidthInformation;
    sums.gradient[3] += kWidthInformation * (kWidth - width);
    const Eigen::LDLT<Matrix4d> solver(sums.information);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-13)) return std::nullopt;
    if (round == kRounds) {
      const double scale = std::max(kLeastScale, sums.misfit / std::max(1, sums.pixels - 4));
      cone.covariance = scale * Matrix4d(solver.solve(Matrix4d::Identity())).topLeftCorner<3, 3>();
      return cone;
    }
    if (round % kDescribedEvery == 1) find_contradictions(outline);
    const Vector4d step = solver.solve(sums.gradient);
    cone.azimuth += step[0];
    cone.elevation += step[1];
    cone.radius += step[2];
    width = std::clamp(width + step[3], kWidthMin, kWidthMax);
    if (!(cone.radius > *pixel) || cone.radius > kRadiusMax) return std::nullopt;
  }
}

}  // namespace movis::scan
