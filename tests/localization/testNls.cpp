#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <random>

#include "movis/core/angle.h"
#include "movis/core/random.h"
#include "movis/localization/nls.h"

namespace movis::localization {
namespace {

using Eigen::Vector2d;

// The paper's 3.5 m × 4 m; goals 1 m wide and 0.4 m deep, their walls 0.1 m thick: the silhouette's w is 0.5.
Field paper_field() {
  Field field;
  field.half_width = 1.75;
  field.half_length = 2.0;
  field.circle = 0.5;
  field.line = 0.05;
  field.Fd = 2.0;
  field.Fw = 0.4;
  field.goal_thickness = 0.1;
  field.goal_depth = 0.4;
  return field;
}

omni::Rig three_cameras() {
  omni::Rig rig;
  for (const Vector2d& place : {Vector2d(-0.173, 0.1), Vector2d(0.173, 0.1), Vector2d(0.0, -0.2)}) {
    omni::Camera camera;
    camera.position = {place.x(), place.y(), 0.25};
    rig.cameras.push_back(camera);
  }
  return rig;
}

constexpr double kSigma = 3e-4;  // of an edge, radians

struct Scene {
  Field field = paper_field();
  FieldMap map{field};
  omni::Rig rig = three_cameras();
  std::vector<Bearing> bearings;
  triangulation::GoalLandmarks goals;
  std::vector<LinePoint> lines;
  NlsOptions options;

  Fix fix() const { return nls({rig, bearings, goals, lines}, map, options); }
  Fix from(const Pose2& guess) const { return nls_from(guess, {rig, bearings, goals, lines}, map, options); }
};

// A goal's outer corners on the floor, side +1 for yellow, −1 for blue: written down from field.yaml's definition.
std::array<Vector2d, 6> corners(const Field& field, double side) {
  const double w = field.Fw + field.goal_thickness;
  const double back = field.Fd + field.goal_depth;
  return {{{-w, side * field.Fd},
           {w, side * field.Fd},
           {-w, side * back},
           {w, side * back},
           {-field.Fw, side * (back + field.goal_thickness)},
           {field.Fw, side * (back + field.goal_thickness)}}};
}

// What a camera sees of a goal: all corners' directions about that of the goal's middle, and the outermost.
Bearing seen(const Scene& scene, const Pose2& world_from_robot, int camera, ObjectClass goal) {
  const double side = goal == ObjectClass::yellow_goal ? 1.0 : -1.0;
  const Vector2d viewpoint = world_from_robot * Vector2d(scene.rig.cameras[camera].position.head<2>());
  const Vector2d to_middle = Vector2d(0.0, side * (scene.field.Fd + 0.5 * scene.field.goal_depth)) - viewpoint;
  const double middle = std::atan2(to_middle.y(), to_middle.x());
  double left = -kPi, right = kPi;
  for (const Vector2d& corner : corners(scene.field, side)) {
    const Vector2d to_corner = corner - viewpoint;
    const double off = turn(middle, std::atan2(to_corner.y(), to_corner.x()));
    left = std::max(left, off);
    right = std::min(right, off);
  }
  Bearing bearing;
  bearing.camera = camera;
  bearing.object = goal;
  bearing.left = wrap_angle(middle + left - world_from_robot.beta);
  bearing.right = wrap_angle(middle + right - world_from_robot.beta);
  bearing.left_variance = bearing.right_variance = kSigma * kSigma;
  return bearing;
}

void look(Scene& scene, const Pose2& world_from_robot) {
  scene.bearings.clear();
  for (int camera = 0; camera < static_cast<int>(scene.rig.cameras.size()); ++camera) {
    scene.bearings.push_back(seen(scene, world_from_robot, camera, ObjectClass::yellow_goal));
    scene.bearings.push_back(seen(scene, world_from_robot, camera, ObjectClass::blue_goal));
  }
}

// Points on the middle of the border's, the middle's and the circle's line within 2.5 m.
void see_lines(Scene& scene, const Pose2& world_from_robot) {
  const Pose2 robot_from_world = inverse(world_from_robot);
  const double x = scene.field.half_width - 0.5 * scene.field.line;
  const double y = scene.field.half_length - 0.5 * scene.field.line;
  const auto add = [&](const Vector2d& in_field) {
    LinePoint point;
    point.camera = 0;
    point.point = robot_from_world * in_field;
    point.sigma_on_floor = 0.003;
    point.sigma = 0.003 * 0.25 / (point.point.squaredNorm() + 0.25 * 0.25);  // seen from 0.25 m above the floor
    if (point.point.norm() < 2.5) scene.lines.push_back(point);
  };
  for (double along = -0.98; along < 1.0; along += 0.04) {
    for (const double side : {-1.0, 1.0}) {
      add({side * x, along * y});
      add({along * x, side * y});
    }
    add({along * x, 0.0});
    add({0.5 * std::cos(kPi * along), 0.5 * std::sin(kPi * along)});
  }
}

double distance(const Fix& fix, const Pose2& truth) {
  return (fix.world_from_robot.translation() - truth.translation()).norm();
}

void expect_pose(const Fix& fix, const Pose2& truth, double tolerance) {
  ASSERT_EQ(fix.status, FixStatus::ok) << word(fix.status) << " at " << truth.x << ' ' << truth.y << ' ' << truth.beta;
  EXPECT_LT(distance(fix, truth), tolerance) << truth.x << ' ' << truth.y << ' ' << truth.beta;
  EXPECT_NEAR(turn(truth.beta, fix.world_from_robot.beta), 0.0, tolerance);
}

// Known answer. The robot stands on the centre spot, turned by 90°: its x axis points along Y, to the yellow goal. Seen
// from (0, ±0.1), on the Y axis, the outermost corners are the fronts' (±0.5, ±2), as those behind lie at a steeper
// angle. So with cameras at (±0.1, 0) in the robot frame the yellow goal's edges lie ±atan(0.5/(2 ∓ 0.1)) off the
// robot's x axis, the blue one's ±atan(0.5/(2 ± 0.1)) off its −x axis.
TEST(Nls, KnownAnswerOnTheCentreSpot) {
  Scene scene;
  scene.rig.cameras.resize(2);
  scene.rig.cameras[0].position = {0.1, 0.0, 0.25};
  scene.rig.cameras[1].position = {-0.1, 0.0, 0.25};
  for (const int camera : {0, 1}) {
    const double ahead = camera == 0 ? 1.9 : 2.1;
    const double behind = camera == 0 ? 2.1 : 1.9;
    Bearing yellow;
    yellow.camera = camera;
    yellow.object = ObjectClass::yellow_goal;
    yellow.left = std::atan(0.5 / ahead);
    yellow.right = -std::atan(0.5 / ahead);
    yellow.left_variance = yellow.right_variance = kSigma * kSigma;
    Bearing blue = yellow;
    blue.object = ObjectClass::blue_goal;
    blue.left = kPi - kPi * 2.0 + std::atan(0.5 / behind);
    blue.right = kPi - std::atan(0.5 / behind);
    scene.bearings.push_back(yellow);
    scene.bearings.push_back(blue);
  }
  expect_pose(scene.fix(), {0.0, 0.0, 0.5 * kPi}, 1e-6);
}

TEST(Nls, RoundTripAllOverTheField) {
  Scene scene;
  for (const double x : {-1.7, -0.9, 0.0, 0.4, 1.3}) {
    for (const double y : {-1.6, -0.7, 0.0, 1.1, 1.7}) {
      for (int step = 0; step < 6; ++step) {
        const Pose2 truth{x, y, wrap_angle(0.2 + step * kPi / 3.0)};
        look(scene, truth);
        expect_pose(scene.fix(), truth, 1e-5);
        expect_pose(scene.from({x + 0.3, y - 0.3, truth.beta + radians(15.0)}), truth, 1e-5);
      }
    }
  }
}

// By lines alone, up to the half turn; with a guess, that is settled.
TEST(Nls, RoundTripByWhiteGoalsAndLines) {
  Scene scene;
  scene.field.goals = scene.map.field.goals = Field::Goals::white;
  for (const Pose2& truth : {Pose2{-0.6, -0.8, 0.4}, Pose2{0.9, -0.2, 2.5}, Pose2{0.2, -1.4, -1.2}}) {
    scene.lines.clear();
    see_lines(scene, truth);
    const Fix fix = scene.fix();
    expect_pose(fix, truth, 1e-3);  // all three in the half that is given
    EXPECT_TRUE(fix.symmetric);
    const Pose2 turned{-truth.x, -truth.y, wrap_angle(truth.beta + kPi)};
    expect_pose(scene.from({turned.x + 0.2, turned.y, turned.beta + 0.1}), turned, 1e-3);
  }
}

TEST(Nls, NothingSeen) {
  Scene scene;
  EXPECT_EQ(scene.fix().status, FixStatus::no_goal);
  scene.map.field.goals = Field::Goals::white;
  EXPECT_EQ(scene.fix().status, FixStatus::no_landmark);
}

// Seen from 1.3 m before it by three cameras 0.35 m apart, one goal tells the pose; but it is believed only where the
// lines say so too. By one camera it is not told.
TEST(Nls, OneGoalInSight) {
  Scene scene;
  const Pose2 truth{0.4, 0.7, 1.0};
  for (int camera = 0; camera < 3; ++camera) {
    scene.bearings.push_back(seen(scene, truth, camera, ObjectClass::yellow_goal));
  }
  EXPECT_EQ(scene.fix().status, FixStatus::one_goal);
  see_lines(scene, truth);
  expect_pose(scene.fix(), truth, 1e-4);
  scene.lines.clear();
  scene.bearings.resize(1);
  EXPECT_EQ(scene.fix().status, FixStatus::one_goal);
}

// One camera sees four edges: three numbers, and only one to contradict them.
TEST(Nls, OneCameraLeft) {
  Scene scene;
  look(scene, {0.4, 0.7, 1.0});
  scene.bearings.resize(2);
  EXPECT_NE(scene.fix().status, FixStatus::ok);
  see_lines(scene, {0.4, 0.7, 1.0});
  expect_pose(scene.fix(), {0.4, 0.7, 1.0}, 2e-3);  // the lines give the pose, the goals which half it is
}

TEST(Nls, CoveredEdgesAreFoundOut) {
  Scene scene;
  const Pose2 truth{-0.7, 0.4, -2.0};
  for (const double covered_deg : {0.3, 2.0, 8.0}) {
    look(scene, truth);
    // An opponent before the blue goal's left edge, in all cameras; and something before one yellow edge.
    for (Bearing& bearing : scene.bearings) {
      if (bearing.object == ObjectClass::blue_goal) bearing.left -= radians(covered_deg);
    }
    scene.bearings[0].right += radians(0.5 * covered_deg);
    see_lines(scene, truth);
    expect_pose(scene.fix(), truth, 0.01);
    scene.lines.clear();
  }
}

// A field file whose goals stand elsewhere: the edges of either goal alone would do.
TEST(Nls, GoalsElsewhereThanTheFileSays) {
  Scene scene;
  look(scene, {0.5, 0.3, 0.4});
  see_lines(scene, {0.5, 0.3, 0.4});
  Field other = paper_field();
  other.Fd += 0.5;
  const FieldMap map(other);
  EXPECT_EQ(nls({scene.rig, scene.bearings, scene.goals, scene.lines}, map, {}).status, FixStatus::bad_fit);
}

// The edges of a goal that shines into its surroundings: the bias is told apart from the pose.
TEST(Nls, EdgesThatErrTogether) {
  Scene scene;
  const Pose2 truth{0.3, -0.9, 0.7};
  look(scene, truth);
  for (Bearing& bearing : scene.bearings) {
    bearing.left += radians(0.03);
    bearing.right -= radians(0.03);
  }
  expect_pose(scene.fix(), truth, 2e-3);
}

// From inside a goal it has no silhouette, and the other one is far away: what is given must be right.
TEST(Nls, RobotInsideAGoal) {
  Scene scene;
  for (const double y : {2.0, 2.1, 2.2}) {
    const Pose2 truth{0.1, y, 0.3};
    look(scene, truth);
    for (Bearing& bearing : scene.bearings) {
      if (bearing.object != ObjectClass::yellow_goal) continue;
      bearing.left = 2.8;
      bearing.right = -2.8;
    }
    const Fix fix = scene.fix();
    if (fix.status == FixStatus::ok) {
      EXPECT_LT(distance(fix, truth), 0.2) << y;
    }
  }
}

// A field of twice the size fits nothing.
TEST(Nls, AnotherField) {
  Scene scene;
  look(scene, {0.5, 0.9, 0.4});
  Field other = paper_field();
  other.half_width = 6.0;
  other.half_length = 9.0;
  other.Fd = 9.0;
  other.Fw = 1.0;
  const FieldMap map(other);
  EXPECT_EQ(nls({scene.rig, scene.bearings, scene.goals, scene.lines}, map, {}).status, FixStatus::bad_fit);
}

// As with the paper's methods, exchanged colours turn the world by half a turn, and nothing in the image tells.
TEST(Nls, SwappedGoalsTurnTheField) {
  Scene scene;
  look(scene, {0.5, 0.3, 0.4});
  for (Bearing& bearing : scene.bearings) {
    bearing.object = bearing.object == ObjectClass::yellow_goal ? ObjectClass::blue_goal : ObjectClass::yellow_goal;
  }
  expect_pose(scene.fix(), {-0.5, -0.3, 0.4 - kPi}, 1e-5);
}

// Edges that a file with other azimuths made, at random: no pose is to come of them.
TEST(Nls, RandomEdgesGiveNoPose) {
  Scene scene;
  RandomStream stream = make_stream(5, 0);
  std::uniform_real_distribution<double> azimuth(-kPi, kPi);
  std::uniform_real_distribution<double> width(0.1, 1.5);
  look(scene, {});
  int poses = 0;
  for (int draw = 0; draw < 300; ++draw) {
    for (Bearing& bearing : scene.bearings) {
      bearing.right = azimuth(stream);
      bearing.left = wrap_angle(bearing.right + width(stream));
    }
    poses += scene.fix().status == FixStatus::ok ? 1 : 0;
  }
  EXPECT_EQ(poses, 0);
}

TEST(Nls, NumbersThatAreNotFinite) {
  Scene scene;
  const Pose2 truth{0.5, 0.3, 0.4};
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    look(scene, truth);
    scene.bearings[0].left = bad;
    scene.bearings[3].right_variance = bad;
    expect_pose(scene.fix(), truth, 1e-4);  // by the four others
    for (Bearing& bearing : scene.bearings) bearing.right = bad;
    EXPECT_EQ(scene.fix().status, FixStatus::no_goal);
  }
}

// A camera's index beyond the rig's, from a file of another rig.
TEST(Nls, BearingOfACameraThatIsNotThere) {
  Scene scene;
  look(scene, {0.5, 0.3, 0.4});
  scene.bearings[0].camera = 7;
  scene.bearings[1].camera = -1;
  expect_pose(scene.fix(), {0.5, 0.3, 0.4}, 1e-4);
}

// Mean of eᵀ C⁻¹ e over draws of what the covariance stands for: independent noise on every edge, √(σ² + floor²), and a
// bias for each goal. It is χ² of 3 degrees of freedom. Over 1500 draws its mean has a standard deviation of 2 %; the
// residuals' scale, which is never below 1, makes some of the covariances too large.
TEST(Nls, CovarianceIsConsistent) {
  constexpr int kDraws = 1500;
  std::uint64_t seed = 1;
  for (const Pose2& truth : {Pose2{0.9, 0.3, 0.5}, Pose2{-0.2, -1.1, -2.0}, Pose2{-1.2, 0.7, 3.1}}) {
    Scene scene;
    look(scene, truth);
    const std::vector<Bearing> exact = scene.bearings;
    RandomStream stream = make_stream(seed++, 0);
    std::normal_distribution<double> normal;
    const double floor = radians(scene.options.edge_floor_deg);
    const double noise = std::sqrt(kSigma * kSigma + floor * floor);
    double sum = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      const double bias[2] = {radians(scene.options.edge_bias_deg) * normal(stream),
                              radians(scene.options.edge_bias_deg) * normal(stream)};
      scene.bearings = exact;
      for (Bearing& bearing : scene.bearings) {
        const double outwards = bias[bearing.object == ObjectClass::yellow_goal ? 0 : 1];
        bearing.left += outwards + noise * normal(stream);
        bearing.right += -outwards + noise * normal(stream);
      }
      const Fix fix = scene.from(truth);
      ASSERT_EQ(fix.status, FixStatus::ok);
      const Eigen::Vector3d error(fix.world_from_robot.x - truth.x, fix.world_from_robot.y - truth.y,
                                  turn(truth.beta, fix.world_from_robot.beta));
      sum += error.dot(fix.covariance.ldlt().solve(error));
    }
    const double nees = sum / kDraws / 3.0;
    EXPECT_GT(nees, 0.85) << truth.x;
    EXPECT_LT(nees, 1.15) << truth.x;
  }
}

}  // namespace
}  // namespace movis::localization
