#include <cmath>

#include "movis/core/angle.h"
#include "physics_scene.h"

namespace movis::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d place_of(const Physics& physics) {
  return physics.state().ball_in_field.head<2>();
}

// With a = 0.35 m/s², from 1.4 m/s: 4 s and 1.4² / 0.7 = 2.8 m. After 2 s the ball has 0.7 m/s and has gone 2.1 m.
TEST(PhysicsBall, RollsAndRests) {
  Physics physics = make_physics({});
  physics.place(scene(kFarAway, {0.0, 0.0}));
  physics.set_ball_velocity({1.4, 0.0, 0.0});
  step_frames(physics, 60);
  EXPECT_NEAR(physics.ball_velocity().x(), 0.7, 1e-9);
  EXPECT_NEAR(place_of(physics).x(), 2.1, 1e-9);
  step_frames(physics, 59);  // 3.967 s
  EXPECT_GT(physics.ball_velocity().x(), 0.0);
  step_frames(physics, 2);  // 4.033 s
  EXPECT_EQ(physics.ball_velocity().norm(), 0.0);
  EXPECT_NEAR(place_of(physics).x(), 2.8, 1e-9);
  EXPECT_EQ(place_of(physics).y(), 0.0);
  EXPECT_EQ(physics.state().ball_in_field.z(), kBallRadius);
  step_frames(physics, 30);
  EXPECT_NEAR(place_of(physics).x(), 2.8, 1e-9);
}

// In any direction, from speeds that do not end with a substep, and for other substeps: v² / (2a).
TEST(PhysicsBall, StoppingDistance) {
  for (const double substep_s : {1.0 / 960.0, 1.0 / 500.0}) {
    for (const double speed : {0.01, 0.777, 4.0}) {
      PhysicsOptions options;
      options.substep_s = substep_s;
      Physics physics = make_physics({}, options);
      physics.place(scene(kFarAway, {-1.0, 2.0}));
      physics.set_ball_velocity({speed * 0.6, -speed * 0.8, 0.0});
      step_frames(physics, 360);  // 4 m/s need 11.4 s
      const Vector2d way = place_of(physics) - Vector2d(-1.0, 2.0);
      const double expected = speed * speed / 0.7;
      EXPECT_NEAR(way.norm(), expected, 1e-9 * expected + 1e-12);
      EXPECT_NEAR(way.x() / way.norm(), 0.6, 1e-9);
      EXPECT_EQ(physics.ball_velocity().norm(), 0.0);
    }
  }
}

// A wall at X = 2.25 m; the ball arrives `degrees` off the normal with 3 m/s.
// Normal: v_n' = −e v_n, impulse J = (1 + e) m v_n. Tangent, for a shell (I = 2/3 m r²) that does not spin: the point
// of contact is moved by an impulse as by a mass 1 / (1/m + r²/I) = m / 2.5 = 0.4 m. Coulomb's impulse is at most μ J =
// 0.2 · 1.6 m v_n = 0.32 m v_n.
//   v_t > 0.32 / 0.4 v_n = 0.8 v_n (more than 38.7° off): it slides, v_t' = v_t − 0.32 v_n;
//   else it grips with 0.4 m v_t, v_t' = 0.6 v_t; the point of contact lies up to 0.75 mm inside the ball, which makes
//   the arm r 0.7 % shorter, the 0.4 m 0.8 % more and v_t' 0.6 % less.
TEST(PhysicsBall, ReboundFromAWall) {
  Arena arena{paper_field(), Wall{0.5, 0.3}, {}};
  for (const double off_deg : {0.0, 20.0, 35.0, 50.0, 75.0}) {
    Physics physics = make_physics(arena, frictionless_floor());
    physics.place(scene({-1.0, 0.0, 0.0}, {1.9, -0.5}));
    const double normal = 3.0 * std::cos(radians(off_deg));
    const double tangent = 3.0 * std::sin(radians(off_deg));
    physics.set_ball_velocity({normal, tangent, 0.0});
    step_frames(physics, 15);
    const bool grips = tangent < 0.8 * normal;
    const double expected = grips ? 0.6 * tangent : tangent - 0.32 * normal;
    EXPECT_NEAR(physics.ball_velocity().x(), -0.6 * normal, 1e-5) << off_deg;
    EXPECT_NEAR(physics.ball_velocity().y(), expected, grips ? 0.006 * expected + 1e-9 : 1e-5) << off_deg;
  }
}

// Slow balls rebound like fast ones.
TEST(PhysicsBall, ReboundAtAnySpeed) {
  Arena arena{paper_field(), Wall{0.5, 0.3}, {}};
  for (const double speed : {0.02, 0.2, 1.0, 6.0}) {
    Physics physics = make_physics(arena, frictionless_floor());
    physics.place(scene({-1.0, 0.0, 0.0}, {2.25 - kBallRadius - 0.002, 0.0}));
    physics.set_ball_velocity({speed, 0.0, 0.0});
    step_frames(physics, 10);
    EXPECT_NEAR(physics.ball_velocity().x(), -0.6 * speed, 1e-5 * speed) << speed;
  }
}

// A post's front is the end of a goal's side wall, 1 cm wide: the ball's centre on its middle line comes straight back.
TEST(PhysicsBall, ReboundFromAPost) {
  Physics physics = make_physics({paper_field(), {}, {}}, frictionless_floor());
  physics.place(scene({0.0, -1.0, 0.0}, {-0.505, 1.5}));
  physics.set_ball_velocity({0.0, 2.0, 0.0});
  step_frames(physics, 15);
  EXPECT_NEAR(physics.ball_velocity().y(), -1.2, 1e-5);
  EXPECT_NEAR(physics.ball_velocity().x(), 0.0, 1e-5);
}

// A cylinder of radius 0.2 m, met 0.155 m off centre: the hulls touch where the centres are 0.31 m apart, and the
// normal there is asin(0.155 / 0.31) = 30° off the motion. Without friction v' = v − (1 + e)(v·n) n, and with n = (−cos
// 30°, sin 30°), v = (2, 0): v·n = −1.7320508, v' = (2 − 1.6 · 1.7320508 · 0.8660254, 1.6 · 1.7320508 · 0.5) =
// (−0.4, 1.3856406). The ball may sink in by 1.5 mm before the contact is found, which turns the normal by 0.16°: 1
// cm/s.
TEST(PhysicsBall, ReboundFromAnObstacle) {
  Arena arena;
  arena.obstacles.emplace_back();
  PhysicsOptions options = frictionless_floor();
  options.contact_friction = 0.0;
  Physics physics = make_physics(arena, options);
  physics.place(scene(kFarAway, {-0.6, 0.155}));
  physics.set_ball_velocity({2.0, 0.0, 0.0});
  step_frames(physics, 15);
  EXPECT_NEAR(physics.ball_velocity().x(), -0.4, 0.015);
  EXPECT_NEAR(physics.ball_velocity().y(), 1.3856406, 0.015);
}

// Masses 0.43 and 12 kg, e = 0.6, the robot at rest: the ball comes back with
// (0.43 − 0.6 · 12) / 12.43 · 4 = −2.1786 m/s, the robot gets 1.6 · 0.43 / 12.43 · 4 = 0.2214 m/s and brakes within
// 0.2214² / (2 · 2.5) = 9.8 mm.
TEST(PhysicsBall, ReboundFromTheRobot) {
  Physics physics = make_physics({}, frictionless_floor());
  physics.place(scene({0.0, 0.0, 0.7}, {0.0, 1.0}));
  physics.set_ball_velocity({0.0, -4.0, 0.0});
  step_frames(physics, 15);
  EXPECT_NEAR(physics.ball_velocity().y(), 2.1786, 1e-3);
  EXPECT_NEAR(physics.state().world_from_robot.y, -0.0098, 4e-4);
  EXPECT_NEAR(physics.robot_velocity().translation().norm(), 0.0, 1e-9);
}

// Shots of 4 m/s (and harder) at thin walls and posts, from both sides and askew: the ball stays on its side. On its
// way it never gets closer than 2 mm less than its radius.
TEST(PhysicsBall, PassesThroughNoPost) {
  const double outer = 0.51 + kBallRadius - 0.002;
  const double inner = 0.50 - kBallRadius + 0.002;
  Physics physics = make_physics({paper_field(), {}, {}});
  for (const double speed : {4.0, 6.0}) {
    for (int i = 0; i < 40; ++i) {
      const double side_speed = (i % 8 - 3.5) * 0.3;
      physics.place(scene({0.0, -1.0, 0.0}, {1.0, 2.05 + 0.005 * i}));
      physics.set_ball_velocity({-speed, 0.3 * side_speed, 0.0});
      physics.step({}, 0.3, [&](const State& state) {
        const Vector3d& ball = state.ball_in_field;
        EXPECT_FALSE(ball.x() < outer && ball.y() > 2.0 && ball.y() < 2.25) << speed << " " << i;
        return ball.y() <= 2.0 || ball.y() >= 2.25;
      });
      physics.place(scene({0.0, -1.0, 0.0}, {0.0, 2.05 + 0.002 * i}));
      physics.set_ball_velocity({speed, side_speed, 0.0});
      physics.step({}, 0.3, [&](const State& state) {
        const Vector3d& ball = state.ball_in_field;
        EXPECT_FALSE(ball.x() > inner && ball.y() > 2.0) << speed << " " << i;
        return ball.y() <= 2.0;
      });
    }
  }
}

TEST(PhysicsBall, PassesNotThroughTheRobot) {
  Physics physics = make_physics({});
  for (int i = -10; i <= 10; ++i) {
    physics.place(scene({0.0, 0.0, 0.0}, {0.03 * i, 1.0}));
    physics.set_ball_velocity({0.0, -4.0, 0.0});
    physics.step(drive_at(0.0, 1.5), 0.4, [&](const State& state) {
      const Vector2d ball = state.ball_in_field.head<2>();
      const double distance = (ball - state.world_from_robot.translation()).norm();
      EXPECT_GT(distance, 0.25 + kBallRadius - 0.006);  // it sinks in by what it moves in a substep
      return false;
    });
    EXPECT_GT(physics.state().ball_in_field.y(), std::abs(i) < 9 ? 0.0 : -2.0);
  }
}

// Up with 2 m/s, along with 1.5 m/s: apex 2² / (2 · 9.81) = 0.20387 m, down after 4 / 9.81 = 0.40775 s, 0.61162 m on.
// The next hop starts with 0.6 · 2 = 1.2 m/s: 0.24465 s, apex 0.07339 m.
TEST(PhysicsBall, Flies) {
  Physics physics = make_physics({});
  physics.place(scene(kFarAway, {0.0, 0.0}));
  physics.set_ball_velocity({1.5, 0.0, 2.0});
  physics.step({}, 2.0 / 9.81);
  EXPECT_NEAR(physics.state().ball_in_field.z() - kBallRadius, 4.0 / 19.62, 1e-9);
  EXPECT_NEAR(physics.ball_velocity().z(), 0.0, 1e-9);
  physics.step({}, 2.0 / 9.81 - 1e-6);
  EXPECT_NEAR(place_of(physics).x(), 1.5 * 4.0 / 9.81, 1e-5);
  EXPECT_NEAR(physics.state().ball_in_field.z(), kBallRadius, 1e-5);
  physics.step({}, 1.2 / 9.81 + 1e-6);
  EXPECT_NEAR(physics.state().ball_in_field.z() - kBallRadius, 1.2 * 1.2 / 19.62, 1e-9);
  EXPECT_EQ(physics.ball_velocity().x(), 1.5);  // nothing slows it in the air
  step_frames(physics, 60);
  EXPECT_EQ(physics.state().ball_in_field.z(), kBallRadius);
  EXPECT_LT(physics.ball_velocity().x(), 1.5);
}

// A metre from the wall, which is 0.3 m high, with 2 m/s along: there from 0.445 to 0.565 s. Up with
// 4.9 m/s the ball is then higher than 1.1 m and goes over; up with 2 m/s it has landed and hops by at most 0.073 m.
TEST(PhysicsBall, FliesOverALowWall) {
  for (const double rising : {4.9, 2.0}) {
    Physics physics = make_physics({paper_field(), Wall{0.5, 0.3}, {}});
    physics.place(scene({-1.0, 0.0, 0.0}, {1.25, 0.0}));
    physics.set_ball_velocity({2.0, 0.0, rising});
    step_frames(physics, 24);  // 0.8 s
    EXPECT_EQ(physics.ball_velocity().x() > 0.0, rising == 4.9);
    EXPECT_EQ(place_of(physics).x() > 2.25, rising == 4.9);
  }
}

// The robot is 0.11 m high, the obstacle 0.6 m.
TEST(PhysicsBall, FliesOverTheRobotNotTheObstacle) {
  Arena arena;
  arena.obstacles.emplace_back().position = {0.0, 2.0};
  Physics physics = make_physics(arena);
  physics.place(scene({0.0, 0.0, 0.0}, {0.0, -1.0}));
  physics.set_ball_velocity({0.0, 2.5, 3.0});  // its bottom 0.45 m up over the back of the robot, 0.18 m over its front
  step_frames(physics, 15);
  EXPECT_EQ(physics.ball_velocity().y(), 2.5);
  EXPECT_EQ(physics.state().world_from_robot.y, 0.0);
  step_frames(physics, 30);
  EXPECT_LT(physics.ball_velocity().y(), 0.0);
}

}  // namespace
}  // namespace movis::sim
