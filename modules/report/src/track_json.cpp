#include "track_json.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "movis/core/angle.h"
#include "movis/core/error.h"

namespace movis::report {
namespace {

using Json = nlohmann::json;

// Values, rounded to what a screen can show and null where they are not finite.

constexpr int kMetreDigits = 5;
constexpr int kDegreeDigits = 4;
constexpr int kPixelDigits = 1;

Json number(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

Json degree(double angle_deg) {
  return number(angle_deg, kDegreeDigits);
}

template <int N>
Json vector(const Eigen::Matrix<double, N, 1>& value, int digits) {
  if (!value.allFinite()) return nullptr;
  Json json = Json::array();
  for (const double v : value) json.push_back(number(v, digits));
  return json;
}

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

// Pictures

std::string base64(const std::vector<std::uint8_t>& bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t taken = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < taken ? bytes[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= taken ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

const char* media_type(const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() > 8 && bytes[0] == 0x89 && bytes[1] == 'P' && bytes[2] == 'N' && bytes[3] == 'G') return "image/png";
  if (bytes.size() > 4 && bytes[0] == 0xff && bytes[1] == 0xd8) return "image/jpeg";
  return nullptr;
}

Json picture(const EncodedImage& image, const std::string& camera) {
  if (image.bytes.empty()) return nullptr;
  const char* type = media_type(image.bytes);
  if (type == nullptr) throw Error("report: a picture of camera {} is neither PNG nor JPEG; encode it first", camera);
  if (image.width <= 0 || image.height <= 0) {
    throw Error("report: a picture of camera {} has the size {}×{}; set its width and height", camera, image.width,
                image.height);
  }
  return {{"src", std::string("data:") + type + ";base64," + base64(image.bytes)},
          {"width", image.width},
          {"height", image.height}};
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
               {"image", picture(camera.image, camera.name)},
               {"panorama", picture(camera.panorama.image, camera.name)},
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

// The measured ball carried into the field by the measured pose. The covariance is propagated to first order, taking
// both measurements as independent.
Json ball_in_field(const PointEstimate& ball, const std::optional<Fix>& fix) {
  if (ball.status != PointStatus::ok || !fix || fix->status != FixStatus::ok) return nullptr;
  const Eigen::Vector2d point = fix->world_from_robot * Eigen::Vector2d(ball.point.head<2>());
  const Eigen::Vector2d arm = point - fix->world_from_robot.translation();
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(fix->world_from_robot.beta).toRotationMatrix();
  Eigen::Matrix<double, 2, 3> by_pose;
  by_pose << 1.0, 0.0, -arm.y(), 0.0, 1.0, arm.x();
  const Eigen::Matrix2d sum = rotation * ball.covariance.topLeftCorner<2, 2>() * rotation.transpose() +
                              by_pose * fix->covariance * by_pose.transpose();
  return {{"point", vector(point, kMetreDigits)}, {"covariance", covariance(sum)}};
}

Json area_json(const Field::Area& area) {
  return {{"depth", number(area.depth, kMetreDigits)}, {"width", number(area.width, kMetreDigits)}};
}

Json field_json(const std::optional<Field>& field) {
  if (!field) return nullptr;
  return {{"half_width", number(field->half_width, kMetreDigits)},
          {"half_length", number(field->half_length, kMetreDigits)},
          {"circle", number(field->circle, kMetreDigits)},
          {"line", number(field->line, kMetreDigits)},
          {"Fd", number(field->Fd, kMetreDigits)},
          {"Fw", number(field->Fw, kMetreDigits)},
          {"goal_depth", number(field->goal_depth, kMetreDigits)},
          {"goal_thickness", number(field->goal_thickness, kMetreDigits)},
          {"white_goals", field->goals == Field::Goals::white},
          {"penalty_area", area_json(field->penalty_area)},
          {"goal_area", area_json(field->goal_area)},
          {"corner_arc", number(field->corner_arc, kMetreDigits)}};
}

// "<" would let "</script" or "<!--" end or change the element that the JSON stands in.
std::string escape_for_script(const std::string& json) {
  std::string escaped;
  escaped.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      escaped += "\\u003c";
    } else {
      escaped += c;
    }
  }
  return escaped;
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
      {"field", field_json(frame.field)}};
  for (const CameraPicture& camera : frame.cameras) json["cameras"].push_back(camera_json(camera));
  return escape_for_script(json.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace movis::report
