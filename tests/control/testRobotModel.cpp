#include <gtest/gtest.h>

#include <array>
#include <string>

#include "movis/control/robot_model.h"
#include "movis/core/angle.h"
#include "movis/core/paths.h"
#include "support/temporary_folder.h"

namespace movis::control {
namespace {

using test::expect_error;
using test::TemporaryFolder;

// The kicker stands on line 4, the turn's rate on 8, the frame rate on 10.
constexpr const char* kRobot =
    "radius: 0.25\nheight: 0.18\nmass: 12\n"
    "kicker: {width: 0.2, reach: 0.05, speed: 4, speed_sigma: 0.05, direction_sigma_deg: 2, lift_deg: 30}\n"
    "limits:\n  speed: 1.5\n  acceleration: 2.5\n  turn_rate: 4\n  turn_acceleration: 12\n"
    "frame_rate: 30\nlatency_frames: 3\nactuator_sigma: 0.02\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

RobotModel read(const std::string& text) {
  const TemporaryFolder folder;
  return read_robot(folder.write("robot.yaml", text));
}

TEST(RobotModel, ReadsTheMiniatureRobot) {
  const RobotModel robot = read_robot(data_file("robots/miniature.yaml"));
  EXPECT_EQ(robot.radius, 0.25);
  EXPECT_EQ(robot.limits.speed, 1.5);
  EXPECT_EQ(robot.limits.turn_acceleration, 12.0);
  EXPECT_NEAR(robot.kicker.direction_sigma, 0.0349066, 1e-7);
  EXPECT_NEAR(robot.latency(), 0.0666667, 1e-7);
  EXPECT_NEAR(robot.frame_period(), 0.0333333, 1e-7);
  EXPECT_FALSE(robot.wheels);
}

TEST(RobotModel, ReadsEveryKey) {
  const RobotModel robot = read(
      std::string(kRobot) + "wheels: {azimuths_deg: [30, 150, 225, -45], distance: 0.2, radius: 0.05, max_rate: 60}");
  EXPECT_EQ(robot.height, 0.18);
  EXPECT_EQ(robot.mass, 12.0);
  EXPECT_EQ(robot.kicker.width, 0.2);
  EXPECT_EQ(robot.kicker.reach, 0.05);
  EXPECT_EQ(robot.kicker.speed, 4.0);
  EXPECT_EQ(robot.kicker.speed_sigma, 0.05);
  EXPECT_NEAR(robot.kicker.lift, kPi / 6.0, 1e-12);
  EXPECT_EQ(robot.limits.acceleration, 2.5);
  EXPECT_EQ(robot.limits.turn_rate, 4.0);
  EXPECT_EQ(robot.frame_rate, 30.0);
  EXPECT_EQ(robot.latency_frames, 3);
  EXPECT_EQ(robot.actuator_sigma, 0.02);
  ASSERT_TRUE(robot.wheels);
  ASSERT_EQ(robot.wheels->azimuths.size(), 4U);
  EXPECT_NEAR(robot.wheels->azimuths[2], -0.75 * kPi, 1e-12);
  EXPECT_EQ(robot.wheels->distance, 0.2);
  EXPECT_EQ(robot.wheels->radius, 0.05);
  EXPECT_EQ(robot.wheels->max_rate, 60.0);
}

TEST(RobotModel, EveryValueHasARange) {
  for (const auto& [from, to, key] :
       {std::array{"radius: 0.25", "radius: 250", "radius"}, std::array{"height: 0.18", "height: 0", "height"},
        std::array{"mass: 12", "mass: -1", "mass"}, std::array{"width: 0.2", "width: 0", "kicker.width"},
        std::array{"reach: 0.05", "reach: -0.05", "kicker.reach"}, std::array{"speed: 4", "speed: 0", "kicker.speed"},
        std::array{"speed_sigma: 0.05", "speed_sigma: 5", "kicker.speed_sigma"},
        std::array{"sigma_deg: 2", "sigma_deg: -2", "kicker.direction_sigma_deg"},
        std::array{"lift_deg: 30", "lift_deg: 61", "kicker.lift_deg"},
        std::array{"speed: 1.5", "speed: 0", "limits.speed"},
        std::array{"acceleration: 2.5", "acceleration: -2.5", "limits.acceleration"},
        std::array{"turn_rate: 4", "turn_rate: 0", "limits.turn_rate"},
        std::array{"turn_acceleration: 12", "turn_acceleration: .inf", "turn_acceleration"},
        std::array{"frame_rate: 30", "frame_rate: 0", "frame_rate"},
        std::array{"latency_frames: 3", "latency_frames: 31", "latency_frames"},
        std::array{"latency_frames: 3", "latency_frames: -1", "latency_frames"},
        std::array{"actuator_sigma: 0.02", "actuator_sigma: 2", "actuator_sigma"}}) {
    expect_error([&, from = from, to = to] { read(replaced(kRobot, from, to)); }, {key, "out of range"});
  }
}

TEST(RobotModel, ErrorsNameFileLineAndKey) {
  expect_error([] { read(replaced(kRobot, "turn_rate: 4", "turn_rate: 0")); }, {"robot.yaml:8", "limits.turn_rate"});
  expect_error([] { read(replaced(kRobot, "turn_rate", "turnrate")); }, {"robot.yaml:8", "did you mean 'turn_rate'"});
  expect_error([] { read(replaced(kRobot, "frame_rate: 30\n", "")); }, {"robot.yaml:1", "frame_rate", "missing"});
  expect_error([] { read(replaced(kRobot, "latency_frames: 3", "latency_frames: 2.5")); },
               {"robot.yaml:11", "latency_frames", "whole number"});
}

TEST(RobotModel, KickerWiderThanTheRobot) {
  expect_error([] { read(replaced(kRobot, "width: 0.2", "width: 0.51")); },
               {"robot.yaml:4", "kicker.width", "diameter"});
}

// Wheels that stand on one line through the centre, or in fewer than three places, cannot drive every way.
TEST(RobotModel, WheelsThatCannotDriveInAllDirections) {
  const auto wheels = [](const std::string& azimuths) {
    read(kRobot + ("wheels: {azimuths_deg: " + azimuths + ", distance: 0.2, radius: 0.05, max_rate: 60}"));
  };
  EXPECT_NO_THROW(wheels("[0, 120, 240]"));
  EXPECT_NO_THROW(wheels("[0, 90, 180]"));
  expect_error([&] { wheels("[0, 180]"); }, {"robot.yaml:13", "wheels.azimuths_deg", "three wheels"});
  expect_error([&] { wheels("[]"); }, {"wheels.azimuths_deg", "three wheels"});
  expect_error([&] { wheels("[30, 210, 390]"); }, {"robot.yaml:13", "wheels.azimuths_deg", "all directions"});
  expect_error([&] { wheels("[0, 180, 0, 180]"); }, {"all directions"});
  expect_error([&] { wheels("[0, 0, 120]"); }, {"all directions"});
  expect_error([&] { wheels("120"); }, {"wheels.azimuths_deg", "list of numbers"});
  expect_error([&] { wheels("[0, left, 240]"); }, {"wheels.azimuths_deg", "must be a number"});
}

// By hand: the hull ends at 0.25 m and the ball has a radius of 0.11 m, so straight ahead the reach of 0.05 m ends with
// the ball's centre at 0.41 m. At the kicker's edge, x = 0.1, the same distance is y = √(0.41² − 0.1²) = 0.39762.
TEST(RobotModel, KickersReach) {
  const RobotModel robot = read(kRobot);
  EXPECT_TRUE(kicker_reaches(robot, {0.0, 0.36}, 0.11));
  EXPECT_TRUE(kicker_reaches(robot, {0.0, 0.409}, 0.11));
  EXPECT_FALSE(kicker_reaches(robot, {0.0, 0.411}, 0.11));
  EXPECT_TRUE(kicker_reaches(robot, {0.099, 0.397}, 0.11));
  EXPECT_FALSE(kicker_reaches(robot, {0.099, 0.399}, 0.11));
  EXPECT_FALSE(kicker_reaches(robot, {0.101, 0.36}, 0.11));
  EXPECT_FALSE(kicker_reaches(robot, {-0.101, 0.36}, 0.11));
}

TEST(RobotModel, KickerAndABallThatOverlapsTheHull) {
  EXPECT_TRUE(kicker_reaches(read(kRobot), {0.0, 0.33}, 0.11));
}

TEST(RobotModel, KickerReachesNoBallBehind) {
  EXPECT_FALSE(kicker_reaches(read(kRobot), {0.0, -0.36}, 0.11));
}

}  // namespace
}  // namespace movis::control
