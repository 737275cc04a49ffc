#include "ball_outline.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "membership.h"

namespace movis::scan {

using Eigen::Vector3d;
using Span = RefineScratch::Span;

void collect_outline(const ImageView& image, const PolarMap& map, Rows rows, RefineScratch& scratch) {
  const auto black = [&](int u, int v) { return map.contains(u, v) && brightness(light_at(image, u, v)) < kBlack; };
  const auto membership_at = [&](int u, int v) {
    const Span& span = scratch.widened[v];
    return scratch.memberships[span.first + static_cast<std::size_t>(u - span.begin)];
  };
  const auto ray_at = [&](int u, int v) {
    const PixelRay& ray = map.ray[map.index(u, v)];
    return Eigen::Vector3f(ray.x, ray.y, ray.z);
  };
  const auto between = [&](int u1, int v1, int u2, int v2) {
    const float w1 = membership_at(u1, v1);
    const float w2 = membership_at(u2, v2);
    if ((w1 < 0.5F) == (w2 < 0.5F) || !map.contains(u1, v1) || !map.contains(u2, v2)) return;
    const int du = w1 < 0.5F ? u1 - u2 : u2 - u1;  // outwards
    const int dv = w1 < 0.5F ? v1 - v2 : v2 - v1;
    const int u_out = w1 < 0.5F ? u1 : u2;
    const int v_out = w1 < 0.5F ? v1 : v2;
    if (black(u_out, v_out) || black(u_out + du, v_out + dv) || black(u_out + 2 * du, v_out + 2 * dv)) return;
    if (scratch.outline.size() == scratch.outline.capacity()) return;
    const float share = (0.5F - w1) / (w2 - w1);
    scratch.outline.push_back(((1.0F - share) * ray_at(u1, v1) + share * ray_at(u2, v2)).normalized());
  };
  scratch.outline.clear();
  for (int v = rows.begin; v < rows.end; ++v) {
    const Span& span = scratch.widened[v];
    for (int u = span.begin; u + 1 < span.end; ++u) between(u, v, u + 1, v);
    if (v + 1 == rows.end) break;
    const Span& below = scratch.widened[v + 1];
    for (int u = std::max(span.begin, below.begin); u < std::min(span.end, below.end); ++u) between(u, v, u, v + 1);
  }
}

namespace {

float median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The cone through three points of the outline that most of the others lie closest to (least median of squares, P.
// Rousseeuw, 1984): up to half of them may be of something else, such as the ball's image in another sensor unit's
// mirror.
std::optional<Vector3d> robust_cone(const std::vector<Eigen::Vector3f>& outline, std::vector<float>& values) {
  constexpr std::size_t kTriples = 48;
  constexpr std::size_t kJudges = 64;
  const std::size_t count = outline.size();
  const std::size_t stride = std::max<std::size_t>(1, count / kJudges);
  std::optional<Vector3d> best;
  double least = 0.0;
  for (std::size_t k = 0; k < kTriples; ++k) {
    const std::size_t first = k * count / kTriples;
    const std::size_t second = first + count / 3 + 5 * k % (count / 6 + 1);
    const std::size_t third = first + 2 * count / 3 + 11 * k % (count / 6 + 1);
    Eigen::Matrix3d rays;
    rays << outline[first].cast<double>().transpose(), outline[second % count].cast<double>().transpose(),
        outline[third % count].cast<double>().transpose();
    if (std::abs(rays.determinant()) < 1e-9) continue;
    const Vector3d m = rays.inverse() * Vector3d::Ones();
    values.clear();
    for (std::size_t i = 0; i < count; i += stride) {
      values.push_back(static_cast<float>(std::abs(outline[i].cast<double>().dot(m) - 1.0)));
    }
    const double median = median_of(values) / m.norm();
    if (best && median >= least) continue;
    best = m;
    least = median;
  }
  return best;
}

}  // namespace

std::optional<Cone> fit_cone(const std::vector<Eigen::Vector3f>& outline, double pixel, std::vector<float>& values) {
  constexpr int kRounds = 6;
  constexpr int kFewest = 12;
  if (outline.size() < kFewest) return std::nullopt;
  const std::optional<Vector3d> start = robust_cone(outline, values);
  if (!start) return std::nullopt;
  Vector3d m = *start;
  const auto limit_around = [&] {
    values.clear();
    for (const Eigen::Vector3f& point : outline) {
      values.push_back(static_cast<float>(std::abs(point.cast<double>().dot(m) - 1.0)));
    }
    return std::max(3.0 * median_of(values), 0.1 * pixel * m.norm());
  };
  double limit = limit_around();
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right_side = Vector3d::Zero();
    double sum_of_squares = 0.0;
    int used = 0;
    for (const Eigen::Vector3f& point : outline) {
      const Vector3d ray = point.cast<double>();
      const double residual = ray.dot(m) - 1.0;
      if (std::abs(residual) > limit) continue;
      normal += ray * ray.transpose();
      right_side += ray;
      sum_of_squares += residual * residual;
      ++used;
    }
    if (used < kFewest) return std::nullopt;
    const Eigen::LDLT<Eigen::Matrix3d> solver(normal);
    if (solver.info() != Eigen::Success || !(solver.rcond() > 1e-12)) return std::nullopt;
    if (round == kRounds - 1) {
      // n = m/|m|: ∂n/∂m = (I − n nᵀ)/|m|. Neighbouring points share their pixels: half of them are independent.
      const double length = m.norm();
      const Vector3d axis = m / length;
      const Eigen::Matrix3d axis_by_m = (Eigen::Matrix3d::Identity() - axis * axis.transpose()) / length;
      const double variance = 2.0 * sum_of_squares / (used - 3);
      return Cone{axis, axis_by_m * (variance * solver.solve(Eigen::Matrix3d::Identity())) * axis_by_m.transpose(),
                  std::acos(std::min(1.0, 1.0 / length))};
    }
    m = solver.solve(right_side);
    limit = limit_around();
  }
  return std::nullopt;
}

}  // namespace movis::scan
