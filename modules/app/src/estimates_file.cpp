#include "estimates_file.h"

#include <fmt/format.h>

#include <iterator>

#include "movis/localization/object_position.h"

namespace movis::app {
namespace {

constexpr const char* kHeader =
    "frame,time_s,ball_status,ball_x_r,ball_y_r,ball_z_r,ball_cov_xx,ball_cov_xy,ball_cov_yy,"
    "pose_status,robot_x,robot_y,robot_beta,"
    "pose_cov_xx,pose_cov_xy,pose_cov_xb,pose_cov_yy,pose_cov_yb,pose_cov_bb,"
    "ball_x,ball_y,ball_vx,ball_vy,tick_us\n";

}  // namespace

EstimatesFile::EstimatesFile(const std::filesystem::path& file) : output_(file) {
  output_.stream() << kHeader;
}

void EstimatesFile::add(const pipeline::Estimate& estimate) {
  const PointEstimate& ball = estimate.ball_in_robot;
  const Fix& fix = estimate.fix;
  const bool ball_ok = ball.status == PointStatus::ok;
  const bool fix_known = fix.status == FixStatus::ok || (fix.status == FixStatus::ambiguous && fix.symmetric);
  fmt::memory_buffer row;
  auto out = std::back_inserter(row);
  fmt::format_to(out, "{},{:.6f},{}", estimate.index, estimate.time_s, word(ball.status));
  if (ball_ok) {
    fmt::format_to(out, ",{:.6f},{:.6f},{:.6f},{:.9g},{:.9g},{:.9g}", ball.point.x(), ball.point.y(), ball.point.z(),
                   ball.covariance(0, 0), ball.covariance(0, 1), ball.covariance(1, 1));
  } else {
    fmt::format_to(out, ",,,,,,");
  }
  fmt::format_to(out, ",{}", word(fix.status));
  if (fix_known) {
    const auto& c = fix.covariance;
    fmt::format_to(out, ",{:.6f},{:.6f},{:.6f},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", fix.world_from_robot.x,
                   fix.world_from_robot.y, fix.world_from_robot.beta, c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2),
                   c(2, 2));
  } else {
    fmt::format_to(out, ",,,,,,,,,");
  }
  const localization::ObjectPosition position = localization::object_position(fix, ball);
  if (position.status == localization::ObjectStatus::ok) {
    fmt::format_to(out, ",{:.6f},{:.6f}", position.in_field.x(), position.in_field.y());
  } else {
    fmt::format_to(out, ",,");
  }
  fmt::format_to(out, ",,,{:.1f}\n", estimate.tick_us);  // a single instant knows no velocity
  output_.stream().write(row.data(), static_cast<std::streamsize>(row.size()));
}

}  // namespace movis::app
