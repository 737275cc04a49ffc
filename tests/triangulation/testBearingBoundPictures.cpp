// The bound of a bearing against rendered pictures: the Fisher information is also the sum over all pixels of the
// squared derivatives of their grey levels, here by finite differences.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <array>
#include <cstdio>
#include <vector>

#include "movis/core/angle.h"
#include "movis/triangulation/cramer_rao.h"
#include "sim/render_scene.h"
#include "support/outline_contrast.h"

namespace movis::triangulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kBlur = 0.6;        // pixels
constexpr double kStep = 0.005;      // radians between two pictures: about a pixel
constexpr double kLevelStep = 0.04;  // of linear light
constexpr double kNoise = 2.0;       // grey levels

// Pictures of a ball by one camera, and what may be asked of the ball in them: azimuth, elevation and angular radius.
class Pictures {
 public:
  enum Shade : std::uint8_t { dark, plain, bright };  // of the ball: kLevelStep from the first to the last

  explicit Pictures(test::RenderScene scene) : camera_(scene.rig.cameras[0]) {
    scene.rig.cameras.resize(1);
    scene.look.sensor.blur_px = kBlur;
    const sim::Colour ball = scene.look.ball;
    for (const float shade : {-0.5F, 0.0F, 0.5F}) {
      scene.look.ball.head<3>() = ball.head<3>() + shade * static_cast<float>(kLevelStep);
      renderers_.emplace_back(scene.rig, scene.arena, scene.robot, scene.look);
    }
  }

  const omni::Camera& camera() const { return camera_; }

  Vector3d angles_of(const Vector3d& point) const {
    const Vector3d offset = point - camera_.position;
    return {std::atan2(offset.y(), offset.x()), std::atan2(offset.z(), offset.head<2>().norm()),
            std::asin(sim::kBallRadius / offset.norm())};
  }

  const cv::Mat& picture(const Vector3d& angles, Shade shade = plain) {
    const double distance = sim::kBallRadius / std::sin(angles[2]);
    sim::State state;
    state.ball_in_field =
        camera_.position + distance * Vector3d(std::cos(angles[1]) * std::cos(angles[0]),
                                               std::cos(angles[1]) * std::sin(angles[0]), std::sin(angles[1]));
    renderers_[shade].render(state, 1, images_);
    return images_.memory[0];
  }

  // Grey levels, all three channels, of the pixels around a place.
  Eigen::ArrayXd around(const Vector2d& pixel, int half_width, const Vector3d& angles, Shade shade = plain) {
    const cv::Mat& image = picture(angles, shade);
    const int left = static_cast<int>(std::lround(pixel.x())) - half_width;
    const int top = static_cast<int>(std::lround(pixel.y())) - half_width;
    const int size = 2 * half_width + 1;
    Eigen::ArrayXd values(3 * size * size);
    for (int i = 0; i < size * size; ++i) {
      for (int c = 0; c < 3; ++c) values[3 * i + c] = image.at<cv::Vec3b>(top + i / size, left + i % size)[c];
    }
    return values;
  }

 private:
  omni::Camera camera_;
  std::vector<sim::Renderer> renderers_;
  grab::FrameSet images_;
};

// Covariance of the three angles with the ball's brightness eliminated.
Matrix3d bound_from_pictures(Pictures& pictures, const Vector3d& point) {
  const Vector3d angles = pictures.angles_of(point);
  const Vector2d pixel = project(pictures.camera(), point).value();
  const int half_width = static_cast<int>(250.0 * angles[2]) + 8;
  std::array<Eigen::ArrayXd, 4> slopes;
  for (int i = 0; i < 3; ++i) {
    const Vector3d step = 0.5 * kStep * Vector3d::Unit(i);
    slopes[i] = pictures.around(pixel, half_width, angles + step) - pictures.around(pixel, half_width, angles - step);
    slopes[i] /= kStep;
  }
  slopes[3] = pictures.around(pixel, half_width, angles, Pictures::bright) -
              pictures.around(pixel, half_width, angles, Pictures::dark);
  slopes[3] /= kLevelStep;
  Matrix4d information;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) information(i, j) = (slopes[i] * slopes[j]).sum() / (kNoise * kNoise);
  }
  return information.inverse().topLeftCorner<3, 3>();
}

sim::Colour grey(double byte) {
  const auto value = static_cast<float>(test::linear_of(static_cast<std::uint8_t>(byte)));
  return {value, value, value, 0.0F};
}

// A grey ball on a grey floor without light and shade, of so little contrast that the sRGB curve is nearly straight.
test::RenderScene grey_scene(double ball, double floor) {
  test::RenderScene scene;
  scene.look.light = {1.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F};
  scene.look.ball = grey(ball);
  scene.look.floor = scene.look.hall = grey(floor);
  return scene;
}

void expect_ratios(const Matrix3d& found, const Matrix3d& expected, double low, double high, const Vector3d& point) {
  for (int i = 0; i < 3; ++i) {
    const double ratio = std::sqrt(found(i, i) / expected(i, i));
    std::printf("  %s at %.1f m: sigma from the pictures is %.3f of the bound\n",
                std::array{"azimuth", "elevation", "radius"}[static_cast<std::size_t>(i)], point.head<2>().norm(),
                ratio);
    EXPECT_GT(ratio, low) << i << " at " << point.transpose();
    EXPECT_LT(ratio, high) << i << " at " << point.transpose();
  }
}

const std::array<Vector3d, 3> kPlaces{Vector3d(-1.2, 0.6, 0.11), Vector3d(-1.6, 2.0, 0.11), Vector3d(-3.6, 1.6, 0.11)};

// The difference of two pictures blurs the edge by another pixel's box; 3×3 samples a pixel and 8 bits do the rest.
TEST(BearingBoundPictures, GreyBallOnGreyFloor) {
  constexpr double kContrast = 40.0;
  Pictures pictures(grey_scene(160.0, 120.0));
  for (const Vector3d& point : kPlaces) {
    const Matrix3d bound =
        bearing_bound(pictures.camera(), point, sim::kBallRadius, {std::sqrt(3.0) * kContrast, kNoise, kBlur});
    expect_ratios(bound_from_pictures(pictures, point), bound, 0.9, 1.1, point);
  }
}

// The look of the shipped scenes: colours, light and shade, a shadow on the floor, the sRGB curve.
TEST(BearingBoundPictures, ShippedLook) {
  Pictures pictures{test::RenderScene()};
  for (const Vector3d& point : kPlaces) {
    constexpr double kAway = 3.0;  // pixels, five times the blur
    const double contrast = test::outline_contrast(pictures.picture(pictures.angles_of(point)), pictures.camera(),
                                                   point, sim::kBallRadius, kAway);
    const Matrix3d bound = bearing_bound(pictures.camera(), point, sim::kBallRadius, {contrast, kNoise, kBlur});
    std::printf("  contrast %.0f grey levels\n", contrast);
    expect_ratios(bound_from_pictures(pictures, point), bound, 0.7, 1.3, point);
  }
}

}  // namespace
}  // namespace movis::triangulation
