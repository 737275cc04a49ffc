#include "movis/core/status.h"

#include <cmath>

#include "movis/core/bearing.h"
#include "movis/core/image_view.h"

namespace movis {

const char* word(PointStatus status) {
  switch (status) {
    case PointStatus::ok:
      return "ok";
    case PointStatus::not_seen:
      return "not_seen";
    case PointStatus::one_camera:
      return "one_camera";
    case PointStatus::parallel_rays:
      return "parallel_rays";
    case PointStatus::behind_camera:
      return "behind_camera";
    case PointStatus::contradiction:
      return "contradiction";
  }
  return "?";
}

const char* word(FixStatus status) {
  switch (status) {
    case FixStatus::ok:
      return "ok";
    case FixStatus::no_field:
      return "no_field";
    case FixStatus::no_goal:
      return "no_goal";
    case FixStatus::one_goal:
      return "one_goal";
    case FixStatus::no_distance:
      return "no_distance";
    case FixStatus::contradiction:
      return "contradiction";
    case FixStatus::coinciding_circles:
      return "coinciding_circles";
    case FixStatus::negative_radicand:
      return "negative_radicand";
    case FixStatus::outside_field:
      return "outside_field";
    case FixStatus::no_landmark:
      return "no_landmark";
    case FixStatus::ambiguous:
      return "ambiguous";
    case FixStatus::bad_fit:
      return "bad_fit";
  }
  return "?";
}

const char* name(ObjectClass object) {
  switch (object) {
    case ObjectClass::ball:
      return "ball";
    case ObjectClass::yellow_goal:
      return "yellow_goal";
    case ObjectClass::blue_goal:
      return "blue_goal";
    case ObjectClass::field:
      return "field";
    case ObjectClass::line:
      return "line";
    case ObjectClass::obstacle:
      return "obstacle";
  }
  return "?";
}

const char* name(PixelFormat format) {
  switch (format) {
    case PixelFormat::bgr8:
      return "BGR8";
    case PixelFormat::rgb8:
      return "RGB8";
    case PixelFormat::rgba8:
      return "RGBA8";
    case PixelFormat::mono8:
      return "Mono8";
    case PixelFormat::bayer_rggb8:
      return "BayerRG8";
    case PixelFormat::bayer_bggr8:
      return "BayerBG8";
    case PixelFormat::bayer_grbg8:
      return "BayerGR8";
    case PixelFormat::bayer_gbrg8:
      return "BayerGB8";
  }
  return "?";
}

Fix half_turned(const Fix& fix) {
  Fix turned = fix;
  turned.world_from_robot = half_turned(fix.world_from_robot);
  turned.covariance.topRightCorner<2, 1>() *= -1.0;
  turned.covariance.bottomLeftCorner<1, 2>() *= -1.0;
  return turned;
}

Fix nearer_half(const Fix& fix, const Pose2& truth) {
  const bool other = fix.symmetric && std::abs(turn(truth.beta, fix.world_from_robot.beta)) > 0.5 * kPi;
  return other ? half_turned(fix) : fix;
}

}  // namespace movis
