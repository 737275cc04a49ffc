#include <algorithm>
#include <cmath>
#include <set>

#include "movis/calibration/rig_calibration.h"
#include "movis/core/angle.h"
#include "movis/core/error.h"
#include "outcome.h"
#include "pose_search.h"
#include "preconditions.h"

namespace movis::calibration {
namespace {

// Of one frame, what can be used: a ball that two cameras see, goals that two cameras see.
struct Views {
  int frame = 0;  // index
  std::vector<Bearing> balls, goals;
};

int cameras_of(const std::vector<Bearing>& bearings) {
  std::set<int> cameras;
  for (const Bearing& bearing : bearings) cameras.insert(bearing.camera);
  return static_cast<int>(cameras.size());
}

std::vector<Views> collect_views(const Sightings& sightings) {
  std::vector<Views> all;
  for (std::size_t i = 0; i < sightings.frames.size(); ++i) {
    Views views;
    views.frame = static_cast<int>(i);
    for (const Bearing& bearing : sightings.frames[i].bearings) {
      if (useful_ball(bearing)) views.balls.push_back(bearing);
      if (useful_goal(bearing)) views.goals.push_back(bearing);
    }
    if (cameras_of(views.balls) < 2) views.balls.clear();
    if (cameras_of(views.goals) < 2) views.goals.clear();
    if (!views.balls.empty() || !views.goals.empty()) all.push_back(std::move(views));
  }
  return all;
}

void check_views(const std::vector<Views>& all, std::size_t frames) {
  int balls = 0;
  int goals = 0;
  std::vector<double> azimuths;
  for (const Views& views : all) {
    balls += views.balls.empty() ? 0 : 1;
    goals += views.goals.empty() ? 0 : 1;
    for (const Bearing& bearing : views.balls) azimuths.push_back(bearing.azimuth);
  }
  if (balls < kFewestFrames || goals < kFewestFrames) {
    throw Error(
        "of {} frames {} show the ball and {} a goal to two cameras, uncut; a self-calibration needs at least {} of "
        "each, better 40: let the ball lie at different places and let the robot stand at different poses on the field",
        frames, balls, goals, kFewestFrames);
  }
  check_directions(azimuths, "balls");
}

// A ball's first (azimuth, log distance): on the floor in the mean direction of its bearings. A bearing that looks
// above the horizon is of a ball far away.
Eigen::Vector2d first_ball(const omni::Rig& rig, const std::vector<Bearing>& balls, double ball_radius) {
  constexpr double kFarthest = 10.0;  // metres
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Bearing& ball : balls) {
    const omni::Camera& camera = rig.cameras[ball.camera];
    const double drop = std::tan(-ball.elevation);
    const double height = camera.position.z() - ball_radius;
    const double distance = drop * kFarthest > height ? height / drop : kFarthest;
    sum += camera.position.head<2>() + distance * Eigen::Vector2d(std::cos(ball.azimuth), std::sin(ball.azimuth));
  }
  const Eigen::Vector2d mean = sum / static_cast<double>(balls.size());
  return {std::atan2(mean.y(), mean.x()), std::log(std::max(0.1, mean.norm()))};
}

void name_rejected(const Adjustment& adjustment, const FrameVerdicts& verdicts, const Sightings& sightings,
                   RigCalibration& result) {
  for (std::size_t i = 0; i < sightings.frames.size(); ++i) {
    const std::int64_t frame = sightings.frames[i].frame;
    if (verdicts.ball[i]) result.rejected.push_back({frame, -1, "the cameras do not see one ball on the floor"});
    if (verdicts.goals[i]) result.rejected.push_back({frame, -1, "the goals' edges fit no pose on the field"});
  }
  for (const Term& term : adjustment.terms) {
    const bool ball = term.kind == TermKind::ball;
    if (term.used || (ball ? verdicts.ball : verdicts.goals)[term.frame]) continue;
    const Eigen::Vector2d error = term.root * term.at_solution;
    const std::int64_t frame = sightings.frames[term.frame].frame;
    result.rejected.push_back(
        {frame, term.camera,
         ball ? fmt::format("its ball is off by {:.2f}° in azimuth and {:.2f}° in elevation", degrees(error.x()),
                            degrees(error.y()))
              : fmt::format("a goal's {} edge is off by {:.2f}°", term.kind == TermKind::left_edge ? "left" : "right",
                            degrees(error.x()))});
  }
}

// A wrong field contradicts all cameras alike; a camera is to blame where hardly anything contradicts the others.
bool others_agree(const Adjustment& adjustment, int camera) {
  std::size_t all = 0;
  std::size_t left_out = 0;
  for (const Term& term : adjustment.terms) {
    if (term.camera == camera) continue;
    ++all;
    left_out += term.used ? 0 : 1;
  }
  return 10 * left_out < all;
}

void check_contradictions(const Adjustment& adjustment, const FrameVerdicts& verdicts, const std::vector<Views>& all,
                          const Sightings& sightings, const omni::Rig& nominal) {
  const std::vector<CameraVerdict> cameras = contradicting_cameras(adjustment, verdicts, sightings);
  if (!cameras.empty() && others_agree(adjustment, cameras.front().camera)) {
    throw_contradiction(cameras.front(), nominal);
  }
  std::vector<std::int64_t> balls_wrong, goals_wrong;
  std::size_t balls = 0;
  std::size_t goals = 0;
  for (const Views& views : all) {
    const std::int64_t frame = sightings.frames[views.frame].frame;
    balls += views.balls.empty() ? 0 : 1;
    goals += views.goals.empty() ? 0 : 1;
    if (verdicts.ball[views.frame]) balls_wrong.push_back(frame);
    if (verdicts.goals[views.frame]) goals_wrong.push_back(frame);
  }
  if (3 * balls_wrong.size() > balls) {
    throw Error(
        "the cameras do not see one ball on the floor in {} of {} frames: {}; are all cameras' images of the same "
        "instants, does the ball lie on the floor, and is the nominal rig this one's?",
        balls_wrong.size(), balls, listed(balls_wrong));
  }
  std::size_t edges = 0;
  std::size_t edges_wrong = 0;
  for (const Term& term : adjustment.terms) {
    if (term.kind == TermKind::ball) continue;
    ++edges;
    edges_wrong += term.used ? 0 : 1;
  }
  if (3 * goals_wrong.size() > goals || 3 * edges_wrong > edges) {
    throw Error(
        "{} of {} goals' edges fit no pose on the field, in {} of {} frames not even half of them; is the field file "
        "that of these images (Fd, Fw, goal_depth, goal_thickness)?",
        edges_wrong, edges, goals_wrong.size(), goals);
  }
}

}  // namespace

RigCalibration self_calibrate_rig(const omni::Rig& nominal, const Sightings& sightings, const Field& field,
                                  const RigOptions& options) {
  check_rigs(nominal, sightings, options);
  if (field.goals == Field::Goals::white) {
    throw Error("the field's goals are white; self-calibration needs a yellow and a blue one");
  }
  const std::vector<Views> all = collect_views(sightings);
  check_views(all, sightings.frames.size());
  const Drawing drawing(nominal, sightings.rig, options);
  check_camera_order_by_balls(drawing, sightings);

  Adjustment adjustment;
  const RigUnknowns unknowns = add_rig_unknowns(adjustment, nominal.cameras.size());
  for (const Views& views : all) {
    if (!views.balls.empty()) {
      const int ball = adjustment.add_free(first_ball(sightings.rig, views.balls, options.ball_radius));
      for (const Bearing& bearing : views.balls) {
        add_floor_ball(adjustment, drawing, unknowns, views.frame, bearing, ball);
      }
    }
    if (const auto start = search_pose(sightings.rig, views.goals, field)) {
      const int pose = adjustment.add_free(Eigen::Vector3d(start->x, start->y, start->beta));
      for (const Bearing& bearing : views.goals) {
        add_goal(adjustment, drawing, unknowns, views.frame, bearing, field, pose);
      }
    }
  }
  solve_robustly(adjustment);
  const FrameVerdicts verdicts = solve_without_outliers(adjustment, sightings.frames.size());
  check_contradictions(adjustment, verdicts, all, sightings, nominal);
  RigCalibration result = outcome(adjustment, unknowns, nominal, options);
  name_rejected(adjustment, verdicts, sightings, result);
  return result;
}

}  // namespace movis::calibration
