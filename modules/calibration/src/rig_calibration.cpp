#include "movis/calibration/rig_calibration.h"

#include <algorithm>
#include <cmath>

#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "outcome.h"
#include "planar_rays.h"
#include "preconditions.h"

namespace movis::calibration {
namespace {

// Frames with a known place that some camera sees.
std::vector<int> frames_of_use(const Sightings& sightings) {
  std::vector<int> frames;
  for (std::size_t i = 0; i < sightings.frames.size(); ++i) {
    const Sighting& sighting = sightings.frames[i];
    if (!sighting.ball_in_robot) continue;
    if (!sighting.ball_in_robot->allFinite()) {
      throw Error("the ball's place of frame {} is not finite; check the truth file", sighting.frame);
    }
    if (std::any_of(sighting.bearings.begin(), sighting.bearings.end(), useful_ball)) {
      frames.push_back(static_cast<int>(i));
    }
  }
  return frames;
}

void check_places(const Sightings& sightings, const std::vector<int>& frames) {
  constexpr double kSame = 0.1;  // metres
  std::vector<Eigen::Vector3d> places;
  std::vector<double> azimuths;
  for (const int i : frames) {
    const Eigen::Vector3d place = *sightings.frames[i].ball_in_robot;
    const auto same = [&](const Eigen::Vector3d& other) { return (place - other).norm() < kSame; };
    if (std::none_of(places.begin(), places.end(), same)) places.push_back(place);
    azimuths.push_back(std::atan2(place.y(), place.x()));
  }
  if (static_cast<int>(places.size()) < kFewestFrames) {
    throw Error(
        "a ball at a known place is seen in {} of {} frames, at {} places that differ by {} m or more; a calibration "
        "needs at least {}, better 40, all around the robot and from near to far",
        frames.size(), sightings.frames.size(), places.size(), kSame, kFewestFrames);
  }
  check_directions(azimuths, "known places of the ball");
}

// Where a frame's ball is by the bearings alone, as the calibrated rig sees them.
std::optional<Eigen::Vector2d> seen_place(const Drawing& drawing, const omni::Rig& calibrated,
                                          const Sighting& sighting) {
  std::vector<PlanarRay> rays;
  for (const Bearing& bearing : sighting.bearings) {
    if (!useful_ball(bearing)) continue;
    const omni::Camera& camera = calibrated.cameras[bearing.camera];
    const auto pixel = pixel_of(drawing.believed[bearing.camera], {bearing.azimuth, bearing.elevation});
    const auto direction = pixel ? direction_of(camera, *pixel) : std::nullopt;
    if (direction) rays.push_back({camera.position.head<2>(), direction->azimuth});
  }
  constexpr double kOnePoint = radians(0.5);
  if (rays.size() < 2 || largest_error(rays) > kOnePoint) return std::nullopt;
  return meeting_point(rays);
}

std::string contradiction(const Drawing& drawing, const omni::Rig& calibrated, const Sighting& sighting) {
  const auto seen = seen_place(drawing, calibrated, sighting);
  if (!seen) return "the cameras do not see the ball at its known place, nor together at any other";
  constexpr double kSmall = 0.01;  // metres
  const double off = (*seen - sighting.ball_in_robot->head<2>()).norm();
  return fmt::format("the cameras see the ball {} from its known place, at ({:.3f}, {:.3f}) m of the robot frame",
                     off < kSmall ? fmt::format("{:.1f} mm", 1e3 * off) : fmt::format("{:.2f} m", off), seen->x(),
                     seen->y());
}

void name_rejected(const Adjustment& adjustment, const FrameVerdicts& verdicts, const Drawing& drawing,
                   const Sightings& sightings, RigCalibration& result) {
  for (std::size_t i = 0; i < sightings.frames.size(); ++i) {
    const Sighting& sighting = sightings.frames[i];
    if (verdicts.ball[i]) {
      result.rejected.push_back({sighting.frame, -1, contradiction(drawing, result.rig, sighting)});
    }
  }
  for (const Term& term : adjustment.terms) {
    if (term.used || verdicts.ball[term.frame]) continue;
    const Eigen::Vector2d error = term.root * term.at_solution;
    result.rejected.push_back({sightings.frames[term.frame].frame, term.camera,
                               fmt::format("its ball is off by {:.2f}° in azimuth and {:.2f}° in elevation",
                                           degrees(error.x()), degrees(error.y()))});
  }
}

// More than a third of the frames, or of a camera's sightings, cannot be wrong and the rest right.
void check_contradictions(const Adjustment& adjustment, const FrameVerdicts& verdicts, const Sightings& sightings,
                          const omni::Rig& nominal, std::size_t frames) {
  std::vector<std::int64_t> wrong;
  for (std::size_t i = 0; i < sightings.frames.size(); ++i) {
    if (verdicts.ball[i]) wrong.push_back(sightings.frames[i].frame);
  }
  if (3 * wrong.size() > frames) {
    throw Error(
        "places and images contradict each other in {} of {} frames: {}; are the places those of these frames, in this "
        "robot's frame, and is the nominal rig this one's?",
        wrong.size(), frames, listed(wrong));
  }
  const std::vector<CameraVerdict> cameras = contradicting_cameras(adjustment, verdicts, sightings);
  if (!cameras.empty()) throw_contradiction(cameras.front(), nominal);
}

}  // namespace

RigCalibration calibrate_rig(const omni::Rig& nominal, const Sightings& sightings, const RigOptions& options) {
  check_rigs(nominal, sightings, options);
  const std::vector<int> frames = frames_of_use(sightings);
  check_places(sightings, frames);
  const Drawing drawing(nominal, sightings.rig, options);
  check_camera_order_by_places(drawing, sightings);

  Adjustment adjustment;
  const RigUnknowns unknowns = add_rig_unknowns(adjustment, nominal.cameras.size());
  for (const int i : frames) {
    const Sighting& sighting = sightings.frames[i];
    const int slip = add_slip(adjustment, i, options.place_sigma);
    for (const Bearing& bearing : sighting.bearings) {
      if (!useful_ball(bearing)) continue;
      add_known_ball(adjustment, drawing, unknowns, i, bearing, *sighting.ball_in_robot, slip);
    }
  }
  solve_robustly(adjustment);
  const FrameVerdicts verdicts = solve_without_outliers(adjustment, sightings.frames.size());
  check_contradictions(adjustment, verdicts, sightings, nominal, frames.size());
  RigCalibration result = outcome(adjustment, unknowns, nominal, options);
  name_rejected(adjustment, verdicts, drawing, sightings, result);
  return result;
}

}  // namespace movis::calibration
