#include "locate_command.h"

#include <fmt/format.h>

#include <cmath>

#include "line_pixels.h"
#include "movis/core/angle.h"
#include "movis/localization/line_match.h"
#include "movis/localization/line_pixel.h"

namespace movis::app {
namespace {

void print(const localization::LineFit& fit, std::size_t pixels, const Field& field) {
  const Fix& fix = fit.fix;
  // Distances from a pose far outside of the field tell nothing.
  const bool matched = fit.support > 0.0 && fit.median < field.half_width;
  fmt::print("status {}\n", word(fix.status));
  if (fix.status == FixStatus::ok) {
    fmt::print("x {:.4f}\ny {:.4f}\nbeta_deg {:.3f}\n", fix.world_from_robot.x, fix.world_from_robot.y,
               degrees(fix.world_from_robot.beta));
  }
  if (matched) fmt::print("median_m {:.4f}\nwithin_15cm {:.4f}\n", fit.median, fit.within_15cm);
  fmt::print("points {}\nleft_out {}\n", fit.points, pixels - fit.points);
  if (matched)
    fmt::print("within_5cm {:.4f}\non_lines {:.4f}\nspread {:.3f}\n", fit.within_5cm, fit.on_lines, fit.spread);
  if (fix.status == FixStatus::ok) {
    const Eigen::Vector3d sigma = fix.covariance.diagonal().cwiseSqrt();
    fmt::print("sigma_x {:.4f}\nsigma_y {:.4f}\nsigma_beta_deg {:.4f}\nsymmetric {}\n", sigma[0], sigma[1],
               degrees(sigma[2]), fix.symmetric);
  }
}

}  // namespace

void locate(const LocateArguments& arguments) {
  const omni::Rig rig = omni::read_rig(arguments.rig);
  const localization::FieldMap map(read_field(arguments.field));
  const int index = choose_camera(rig, arguments.camera, arguments.rig);
  const std::vector<Eigen::Vector2d> pixels = read_line_pixels(arguments.points, rig.cameras[index]);
  std::vector<LinePoint> points;
  // Without a place on the floor the point has no sigma either: it is left out, but counts as such.
  for (const Eigen::Vector2d& pixel : pixels)
    points.push_back(localization::line_point(rig.cameras[index], index, pixel, map.field.line).value_or(LinePoint{}));
  localization::LineMatchScratch scratch;
  if (arguments.guess.empty()) {
    print(localization::find_by_lines(points, map, {}, scratch), pixels.size(), map.field);
  } else {
    const Pose2 guess{arguments.guess[0], arguments.guess[1], wrap_angle(radians(arguments.guess[2]))};
    print(localization::match_lines(points, map, guess, {}, scratch), pixels.size(), map.field);
  }
}

}  // namespace movis::app
