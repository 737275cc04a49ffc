// One property suite over every camera model, then known answers for each.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <ostream>

#include "movis/core/angle.h"
#include "movis/omni/camera_model.h"
#include "movis/omni/rig.h"

namespace movis::omni {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Hyperboloid mirror() {
  return {0.028095, 0.0234125, 0.0275, 660.0, 660.0, 319.5, 239.5};
}

UnifiedSphere sphere(double xi) {
  UnifiedSphere model;
  model.xi = xi;
  model.fu = 282.0;
  model.fv = 281.0;
  model.u0 = 321.0;
  model.v0 = 238.0;
  model.max_elevation = radians(25.0);
  return model;
}

UnifiedSphere distorted_sphere() {
  UnifiedSphere model = sphere(1.1);
  model.k1 = -0.05;
  model.k2 = 0.01;
  model.p1 = 1e-3;
  model.p2 = -2e-3;
  model.skew = 5e-4;
  return model;
}

// Beyond the turning point its distortion grows again: another ray for the same pixel, which must not be taken.
UnifiedSphere folding_sphere() {
  UnifiedSphere model = sphere(0.96);
  model.k1 = -0.3;
  model.k2 = 0.03;
  model.max_elevation = radians(60.0);
  return model;
}

// At 640 × 480 the horizon lies on a circle of 221 pixels, and the model ends just inside it.
Radial radial() {
  return {1.57, 0.0071, 0.8, 321.0, 238.0, 220.0};
}

struct Case {
  const char* label;
  CameraModel model;
};

void PrintTo(const Case& tested, std::ostream* stream) {
  *stream << tested.label;
}  // NOLINT: GoogleTest's name

class EveryModel : public testing::TestWithParam<Case> {
 protected:
  const CameraModel& model() const { return GetParam().model; }
};

INSTANTIATE_TEST_SUITE_P(CameraModel, EveryModel,
                         testing::Values(Case{"hyperboloid", mirror()}, Case{"below_one", sphere(0.8)},
                                         Case{"paraboloid", sphere(1.0)}, Case{"above_one", sphere(1.3)},
                                         Case{"distorted", distorted_sphere()}, Case{"folding", folding_sphere()},
                                         Case{"radial", radial()}),
                         [](const auto& tested) { return std::string(tested.param.label); });

// Every pixel of the picture that has a ray projects back onto itself, and most of the mirror has rays.
TEST_P(EveryModel, UnprojectThenProjectOverTheWholeImage) {
  int with_ray = 0;
  for (int v = 0; v < 480; v += 3) {
    for (int u = 0; u < 640; u += 3) {
      const Vector2d pixel(u, v);
      const auto ray = unproject(model(), pixel);
      if (!ray) continue;
      ++with_ray;
      EXPECT_NEAR(ray->norm(), 1.0, 1e-12);
      const auto back = project(model(), *ray);
      ASSERT_TRUE(back) << pixel.transpose();
      EXPECT_LT((*back - pixel).norm(), 1e-8) << pixel.transpose();
    }
  }
  EXPECT_GT(with_ray, 10000);
}

TEST_P(EveryModel, ProjectThenUnprojectOverTheSphere) {
  int visible = 0;
  for (double elevation = -84.0; elevation <= 60.0; elevation += 2.5) {
    for (double azimuth = -180.0; azimuth < 180.0; azimuth += 7.5) {
      const double e = radians(elevation);
      const double a = radians(azimuth);
      const Vector3d ray(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const auto pixel = project(model(), 3.7 * ray);  // any length
      if (!pixel) continue;
      ++visible;
      const auto back = unproject(model(), *pixel);
      ASSERT_TRUE(back) << elevation << " " << azimuth;
      EXPECT_LT((*back - ray).norm(), 1e-10) << elevation << " " << azimuth;
    }
  }
  EXPECT_GT(visible, 48 * 30);  // everything below the horizon at least
}

TEST_P(EveryModel, AnalyticJacobianIsTheNumericOne) {
  for (double elevation = -80.0; elevation <= 15.0; elevation += 5.0) {
    for (double azimuth = -175.0; azimuth < 180.0; azimuth += 20.0) {
      const double e = radians(elevation);
      const double a = radians(azimuth);
      const Vector3d ray = 1.7 * Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const auto projection = project_with_jacobian(model(), ray);
      if (!projection) continue;
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3d step = kStep * Vector3d::Unit(axis);
        const auto plus = project(model(), ray + step);
        const auto minus = project(model(), ray - step);
        if (!plus || !minus) continue;  // at the border of the domain
        const Vector2d numeric = (*plus - *minus) / (2.0 * kStep);
        EXPECT_LT((projection->pixel_by_ray.col(axis) - numeric).norm(), 1e-4) << elevation << " " << azimuth;
      }
    }
  }
}

TEST_P(EveryModel, NoRayNoPixel) {
  EXPECT_FALSE(project(model(), Vector3d::Zero()));
  EXPECT_FALSE(project(model(), Vector3d::UnitZ()));  // straight up: into the mirror's back
  EXPECT_FALSE(project(model(), Vector3d(std::nan(""), 0.0, -1.0)));
  EXPECT_FALSE(unproject(model(), Vector2d(1e5, 1e5)));
  EXPECT_FALSE(unproject(model(), Vector2d(std::nan(""), 0.0)));
}

// By hand, from the mirror's equation alone: a point P of the mirror at radius r stands at z = −c + a √(1 + r²/b²); the
// camera at (0, 0, −2c) sees it at u0 + fu r/(z + 2c), and the ray from the viewpoint to it has the direction (r, z).
TEST(Hyperboloid, FollowsTheMirrorsEquation) {
  const Hyperboloid model = mirror();
  const double c = std::sqrt(model.a * model.a + model.b * model.b);
  for (const double r : {0.001, 0.01, 0.02, 0.027}) {
    const double z = -c + model.a * std::sqrt(1.0 + r * r / (model.b * model.b));
    const auto pixel = project(CameraModel(model), Vector3d(r, 0.0, z));
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x(), 319.5 + 660.0 * r / (z + 2.0 * c), 1e-9);
    EXPECT_NEAR(pixel->y(), 239.5, 1e-9);
  }
}

TEST(Hyperboloid, EndsAtTheRim) {
  const Hyperboloid model = mirror();
  const double c = std::sqrt(model.a * model.a + model.b * model.b);
  const auto ray_at = [&](double r) {
    return Vector3d(0.0, r, -c + model.a * std::sqrt(1.0 + r * r / (model.b * model.b)));
  };
  EXPECT_TRUE(project(CameraModel(model), ray_at(0.99999 * model.rim_radius)));
  EXPECT_FALSE(project(CameraModel(model), ray_at(1.00001 * model.rim_radius)));
}

// ξ = 2ac/(a² + c²) and focal length f b²/(a² + c²): the same camera twice.
TEST(Hyperboloid, IsAUnifiedSphere) {
  const Hyperboloid model = mirror();
  const double c2 = model.a * model.a + model.b * model.b;
  const double sum = model.a * model.a + c2;
  UnifiedSphere same;
  same.xi = 2.0 * model.a * std::sqrt(c2) / sum;
  same.fu = same.fv = 660.0 * model.b * model.b / sum;
  same.u0 = model.u0;
  same.v0 = model.v0;
  for (const Vector3d& ray : {Vector3d(1.0, 0.2, -0.1), Vector3d(-0.3, 0.4, -1.0), Vector3d(0.5, -2.0, 0.3)}) {
    const auto a = project(CameraModel(model), ray);
    const auto b = project(CameraModel(same), ray);
    ASSERT_TRUE(a && b);
    EXPECT_LT((*a - *b).norm(), 1e-9);
  }
}

// By hand: ξ = 1 and a horizontal ray give m = 1/(1 − 0) = 1: one focal length from the centre.
TEST(UnifiedSphere, ParaboloidHorizon) {
  const auto pixel = project(CameraModel(sphere(1.0)), Vector3d(0.0, -5.0, 0.0));
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 321.0, 1e-12);
  EXPECT_NEAR(pixel->y(), 238.0 - 281.0, 1e-12);
}

// By hand, with m = (0.5, 0) from the ray (3, 0, −4)/5 and ξ = 0.4: k = 1 + 0.1·0.25 + 0.2·0.0625 = 1.0375,
// tangential x: p2·(0.25 + 2·0.25) = 0.75 p2, y: p1·0.25; u = f (m'_x + skew m'_y).
TEST(UnifiedSphere, DistortionByHand) {
  UnifiedSphere model;
  model.xi = 0.4;
  model.fu = 100.0;
  model.fv = 200.0;
  model.k1 = 0.1;
  model.k2 = 0.2;
  model.p1 = 0.01;
  model.p2 = 0.02;
  model.skew = 0.5;
  const auto pixel = project(CameraModel(model), Vector3d(3.0, 0.0, -4.0));
  ASSERT_TRUE(pixel);
  const double x = 1.0375 * 0.5 + 0.75 * 0.02;
  const double y = 0.25 * 0.01;
  EXPECT_NEAR(pixel->x(), 100.0 * (x + 0.5 * y), 1e-10);
  EXPECT_NEAR(pixel->y(), 200.0 * y, 1e-10);
}

}  // namespace
}  // namespace movis::omni
