#include "movis/sim/referee.h"
#include "physics_scene.h"

namespace movis::sim {
namespace {

// On the paper's field: lines at X = ±1.75, Y = ±2, goals at Y = ±2 with posts at X = ±0.5, 0.5 m high; the ball's
// radius is 0.11 m, so its whole is across a line 0.11 m further.
std::optional<Outcome> judged(const Eigen::Vector3d& ball, const Pose2& robot = {}, double time_s = 1.0) {
  return judge({time_s, robot, ball}, paper_field(), 20.0);
}

TEST(Referee, GoalNeedsTheWholeBall) {
  EXPECT_EQ(judged({0.0, 2.109, kBallRadius}), std::nullopt);
  EXPECT_EQ(judged({0.0, 2.111, kBallRadius}), Outcome::goal);
  EXPECT_EQ(judged({0.49, 2.111, kBallRadius}), Outcome::goal);
  EXPECT_EQ(judged({0.0, -2.109, kBallRadius}), std::nullopt);
  EXPECT_EQ(judged({0.0, -2.111, kBallRadius}), Outcome::own_goal);
}

// Its top is at the bar with its centre at 0.39 m.
TEST(Referee, OverTheBarOrBesideThePostIsOut) {
  EXPECT_EQ(judged({0.0, 2.111, 0.389}), Outcome::goal);
  EXPECT_EQ(judged({0.0, 2.111, 0.391}), Outcome::ball_out);
  EXPECT_EQ(judged({0.0, -2.111, 0.391}), Outcome::ball_out);
  EXPECT_EQ(judged({0.63, 2.111, kBallRadius}), Outcome::ball_out);
}

TEST(Referee, BallOut) {
  EXPECT_EQ(judged({1.859, 0.0, kBallRadius}), std::nullopt);
  EXPECT_EQ(judged({1.861, 0.0, kBallRadius}), Outcome::ball_out);
  EXPECT_EQ(judged({-1.861, 1.0, kBallRadius}), Outcome::ball_out);
  EXPECT_EQ(judged({1.0, -2.109, kBallRadius}), std::nullopt);
  EXPECT_EQ(judged({1.0, -2.111, kBallRadius}), Outcome::ball_out);
}

// Goals may stand behind the end lines: a ball between line and goal is still to score.
TEST(Referee, GoalLineBehindTheEndLine) {
  Field field = paper_field();
  field.Fd = 2.2;
  EXPECT_EQ(judge({1.0, {}, {0.0, 2.2, kBallRadius}}, field, 20.0), std::nullopt);
  EXPECT_EQ(judge({1.0, {}, {0.0, 2.311, kBallRadius}}, field, 20.0), Outcome::goal);
  EXPECT_EQ(judge({1.0, {}, {0.7, 2.2, kBallRadius}}, field, 20.0), Outcome::ball_out);
}

TEST(Referee, RobotOut) {
  const Eigen::Vector3d ball(0.0, 0.0, kBallRadius);
  EXPECT_EQ(judged(ball, {2.74, 0.0, 0.0}), std::nullopt);
  EXPECT_EQ(judged(ball, {2.76, 0.0, 0.0}), Outcome::robot_out);
  EXPECT_EQ(judged(ball, {0.0, -2.99, 0.0}), std::nullopt);
  EXPECT_EQ(judged(ball, {0.0, -3.01, 0.0}), Outcome::robot_out);
}

TEST(Referee, OutOfTime) {
  const Eigen::Vector3d ball(0.0, 0.0, kBallRadius);
  EXPECT_EQ(judged(ball, {}, 19.99), std::nullopt);
  EXPECT_EQ(judged(ball, {}, 20.0), Outcome::out_of_time);
}

// In the last instant a goal still counts.
TEST(Referee, GoalBeforeEverythingElse) {
  EXPECT_EQ(judged({0.0, 2.2, kBallRadius}, {3.0, 0.0, 0.0}, 20.0), Outcome::goal);
  EXPECT_EQ(judged({1.9, 0.0, kBallRadius}, {3.0, 0.0, 0.0}, 20.0), Outcome::ball_out);
}

TEST(Referee, Words) {
  EXPECT_STREQ(word(Outcome::goal), "goal");
  EXPECT_STREQ(word(Outcome::own_goal), "own_goal");
  EXPECT_STREQ(word(Outcome::ball_out), "ball_out");
  EXPECT_STREQ(word(Outcome::robot_out), "robot_out");
  EXPECT_STREQ(word(Outcome::out_of_time), "out_of_time");
}

}  // namespace
}  // namespace movis::sim
