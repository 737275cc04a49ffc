#include "track_json.h"

#include <cmath>

#include "json.h"
#include "movis/core/angle.h"
#include "movis/localization/object_position.h"

namespace movis::report {
namespace {

Json covariance(const Eigen::Matrix2d& value) {  // [xx, xy, yy], at full precision: the numbers are small
  if (!value.allFinite()) return nullptr;
  return {value(0, 0), value(0, 1), value(1, 1)};
}

Json polyline(const std::vector<Eigen::Vector2d>& points) {
  Json json = Json::array();
  for (const Eigen::Vector2d& point : points) {
    if (point.allFinite()) json.push_back(vector(point, kPixelDigits));
  }
  return json;
}

// Cameras

Json flag_words(std::uint8_t flags) {
  Json words = Json::array();
  if ((flags & kCutByBody) != 0) words.push_back("cut by the body");
  if ((flags & kNearSensor) != 0) words.push_back("near another sensor");
  if ((flags & kCutByDomain) != 0) words.push_back("cut by the border");
  if ((flags & kCutByObject) != 0) words.push_back("cut by an object");
  return words;
}

Json mark_json(const BearingMark& mark) {
  return {{"object", name(mark.object)},
          {"azimuth_deg", degree(mark.azimuth_deg)},
          {"elevation_deg", degree(mark.elevation_deg)},
          {"left_deg", degree(mark.left_deg)},
          {"right_deg", degree(mark.right_deg)},
          {"flags", flag_words(mark.flags)},
          {"centre_px", mark.centre_px ? vector(*mark.centre_px, kPixelDigits) : Json()},
          {"centre_line", polyline(mark.centre_line)},
          {"left_line", polyline(mark.left_line)},
          {"right_line", polyline(mark.right_line)}};
}

Json camera_json(const CameraPicture& camera) {
  Json json = {{"name", camera.name},
               {"position", vector(camera.position, kMetreDigits)},
               {"lost", camera.lost},
               {"image", picture_json(camera.image, camera.name)},
               {"panorama", picture_json(camera.panorama.image, camera.name)},
               {"min_elevation_deg", degree(camera.panorama.min_elevation_deg)},
               {"max_elevation_deg", degree(camera.panorama.max_elevation_deg)},
               {"marks", Json::array()},
               {"histograms", Json::array()}};
  for (const BearingMark& mark : camera.marks) json["marks"].push_back(mark_json(mark));
  for (const HistogramCurve& curve : camera.histograms) {
    json["histograms"].push_back(
        {{"object", name(curve.object)}, {"counts", curve.counts}, {"threshold", number(curve.threshold, 2)}});
  }
  return json;
}

// The ball. Its direction is the azimuth at the robot's origin.

const char* explanation(PointStatus status) {
  switch (status) {
    case PointStatus::ok:
      return "";
    case PointStatus::not_seen:
      return "no camera saw it";
    case PointStatus::one_camera:
      return "only one camera saw it, which gives a direction but no distance";
    case PointStatus::parallel_rays:
      return "the rays do not intersect within the range that is measured";
    case PointStatus::behind_camera:
      return "the rays meet behind a camera, so they are not of one point";
    case PointStatus::contradiction:
      return "the bearings are not of one point, and nothing tells which of them is wrong";
  }
  return "";
}

double direction(const Eigen::Vector2d& point) {
  return std::atan2(point.y(), point.x());
}

Json polar(const Eigen::Vector2d& point) {
  return {{"point", vector(point, kMetreDigits)},
          {"distance", number(point.norm(), kMetreDigits)},
          {"direction_deg", degree(degrees(direction(point)))}};
}

// Standard deviations, from the covariance to first order.
Json ball_sigma(const Eigen::Vector2d& point, const Eigen::Matrix3d& covariance_in_robot) {
  const Eigen::Matrix2d planar = covariance_in_robot.topLeftCorner<2, 2>();
  const Eigen::Vector2d radial = point.normalized();
  const Eigen::Vector2d tangential(-radial.y(), radial.x());
  return {{"x", number(std::sqrt(planar(0, 0)), kMetreDigits)},
          {"y", number(std::sqrt(planar(1, 1)), kMetreDigits)},
          {"z", number(std::sqrt(covariance_in_robot(2, 2)), kMetreDigits)},
          {"distance", number(std::sqrt(radial.dot(planar * radial)), kMetreDigits)},
          {"direction_deg", degree(degrees(std::sqrt(tangential.dot(planar * tangential)) / point.norm()))}};
}

Json ball_json(const PointEstimate& ball) {
  Json json = {{"status", word(ball.status)}, {"explanation", explanation(ball.status)}, {"measured", nullptr}};
  if (ball.status != PointStatus::ok || !ball.point.allFinite()) return json;
  json["measured"] = polar(ball.point.head<2>());
  json["measured"]["z"] = number(ball.point.z(), kMetreDigits);
  json["measured"]["covariance"] = covariance(ball.covariance.topLeftCorner<2, 2>());
  json["measured"]["sigma"] = ball_sigma(ball.point.head<2>(), ball.covariance);
  return json;
}

Json ball_error(const PointEstimate& ball, const std::optional<Eigen::Vector2d>& truth) {
  if (ball.status != PointStatus::ok || !truth) return nullptr;
  const Eigen::Vector2d measured = ball.point.head<2>();
  const Eigen::Vector2d error = measured - *truth;
  return {{"length", number(error.norm(), kMetreDigits)},
          {"x", number(error.x(), kMetreDigits)},
          {"y", number(error.y(), kMetreDigits)},
          {"distance", number(measured.norm() - truth->norm(), kMetreDigits)},
          {"direction_deg", degree(degrees(turn(direction(*truth), direction(measured))))}};
}

// The pose

const char* explanation(FixStatus status) {
  switch (status) {
    case FixStatus::ok:
      return "";
    case FixStatus::no_field:
      return "no field is given";
    case FixStatus::no_goal:
      return "neither goal was seen";
    case FixStatus::one_goal:
      return "only one goal was seen, which gives no pose";
    case FixStatus::no_distance:
      return "the goals were seen, but their landmarks could not be triangulated";
    case FixStatus::contradiction:
      return "the goals' distance from each other is not that of the field";
    case FixStatus::coinciding_circles:
      return "the robot stands on the circle through all four posts";
    case FixStatus::negative_radicand:
      return "the circles through the posts of the two goals do not meet";
    case FixStatus::outside_field:
      return "the solution lies far outside the field and is not believed";
    case FixStatus::no_landmark:
      return "neither goals nor lines enough for a pose were seen";
    case FixStatus::ambiguous:
      return "another pose explains what was seen as well";
    case FixStatus::bad_fit:
      return "no pose explains what was seen";
  }
  return "";
}

Json pose_json(const Pose2& pose) {
  if (!std::isfinite(pose.x + pose.y + pose.beta)) return nullptr;
  return {{"x", number(pose.x, kMetreDigits)},
          {"y", number(pose.y, kMetreDigits)},
          {"beta_deg", degree(degrees(wrap_angle(pose.beta)))}};
}

Json fix_json(const std::optional<Fix>& fix) {
  if (!fix || fix->status == FixStatus::no_field) return nullptr;
  Json json = {{"status", word(fix->status)}, {"explanation", explanation(fix->status)}, {"measured", nullptr}};
  Json pose = pose_json(fix->world_from_robot);
  if (fix->status != FixStatus::ok || pose.is_null()) return json;
  const Eigen::Vector3d sigma = fix->covariance.diagonal().cwiseSqrt();
  pose["covariance"] = covariance(fix->covariance.topLeftCorner<2, 2>());
  pose["sigma"] = {{"x", number(sigma.x(), kMetreDigits)},
                   {"y", number(sigma.y(), kMetreDigits)},
                   {"beta_deg", degree(degrees(sigma.z()))}};
  json["measured"] = std::move(pose);
  return json;
}

Json fix_error(const std::optional<Fix>& fix, const std::optional<Pose2>& truth) {
  if (!fix || fix->status != FixStatus::ok || !truth) return nullptr;
  const Eigen::Vector2d error = fix->world_from_robot.translation() - truth->translation();
  return {{"length", number(error.norm(), kMetreDigits)},
          {"x", number(error.x(), kMetreDigits)},
          {"y", number(error.y(), kMetreDigits)},
          {"beta_deg", degree(degrees(turn(truth->beta, fix->world_from_robot.beta)))}};
}

Json ball_in_field(const PointEstimate& ball, const std::optional<Fix>& fix) {
  const auto [status, point, sum] = localization::object_position(fix.value_or(Fix{}), ball);
  if (status != localization::ObjectStatus::ok) return nullptr;
  return {{"point", vector(point, kMetreDigits)}, {"covariance", covariance(sum)}};
}

}  // namespace

std::string to_json(const TrackFrame& frame) {
  const auto& true_ball = frame.true_ball_in_robot;
  Json json = {
      {"set", frame.set},
      {"frame", frame.frame},
      {"label", frame.label},
      {"tick_us", number(frame.tick_us, 1)},
      {"cameras", Json::array()},
      {"ball", ball_json(frame.ball_in_robot)},
      {"true_ball", true_ball && true_ball->allFinite() ? polar(*true_ball) : Json()},
      {"ball_error", ball_error(frame.ball_in_robot, true_ball)},
      {"fix", fix_json(frame.fix)},
      {"true_pose", frame.true_pose ? pose_json(*frame.true_pose) : Json()},
      {"fix_error", fix_error(frame.fix, frame.true_pose)},
      {"ball_in_field", ball_in_field(frame.ball_in_robot, frame.fix)},
      {"true_ball_in_field", frame.true_ball_in_field ? vector(*frame.true_ball_in_field, kMetreDigits) : Json()},
      {"field", frame.field ? field_json(*frame.field) : Json()}};
  for (const CameraPicture& camera : frame.cameras) json["cameras"].push_back(camera_json(camera));
  return script_text(json);
}

}  // namespace movis::report
