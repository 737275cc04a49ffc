#include <gtest/gtest.h>

#include "movis/grab/truth.h"
#include "support/temporary_folder.h"

namespace movis::grab {
namespace {

using test::expect_error;
using test::TemporaryFolder;

const std::string kHeader = "frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z,label\n";

TEST(Truth, ReadsRowsByFrame) {
  const TemporaryFolder folder;
  const auto truth =
      read_truth(folder.write("truth.csv", kHeader + "7,0.5,-1,2,4.0,0.25,-0.5,0.11,A\n3,0,0,0,-1,0,0,0,\n"));
  ASSERT_EQ(truth.size(), 2U);
  const Truth& row = truth.at(7);
  EXPECT_DOUBLE_EQ(row.time_s, 0.5);
  EXPECT_DOUBLE_EQ(row.world_from_robot.x, -1.0);
  EXPECT_DOUBLE_EQ(row.world_from_robot.y, 2.0);
  EXPECT_NEAR(row.world_from_robot.beta, 4.0 - 6.283185307179586, 1e-12);  // files may hold any angle
  EXPECT_EQ(row.ball_in_field, Eigen::Vector3d(0.25, -0.5, 0.11));
  EXPECT_EQ(row.label, "A");
  EXPECT_EQ(truth.at(3).label, "");
  EXPECT_DOUBLE_EQ(truth.at(3).world_from_robot.beta, -1.0);
}

TEST(Truth, ErrorsNameFileLineAndColumn) {
  const TemporaryFolder folder;
  const auto reading = [&](const std::string& text) {
    return [&folder, text] { read_truth(folder.write("truth.csv", text)); };
  };
  expect_error([&] { read_truth(folder.path() / "absent.csv"); }, {"absent.csv", "cannot be opened"});
  expect_error(reading(""), {"truth.csv", "is empty"});
  expect_error(reading(kHeader), {"truth.csv", "no row"});
  expect_error(reading("frame,time_s,robot_y,robot_x,robot_beta,ball_x,ball_y,ball_z,label\n0,0,0,0,0,0,0,0,\n"),
               {"truth.csv:1", "header must be frame,time_s,robot_x"});
  expect_error(reading("frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z\n0,0,0,0,0,0,0,0\n"),
               {"truth.csv:1", "header must be"});
  expect_error(reading(kHeader + "0,0,0,0,0,0,0,0,\n1,0,0,0,0,left,0,0,\n"), {"truth.csv:3", "'ball_x'", "'left'"});
  expect_error(reading(kHeader + "0,0,0,0,0,0,0,0,\n0,1,0,0,0,0,0,0,\n"), {"truth.csv:3", "'frame'", "0", "earlier"});
}

}  // namespace
}  // namespace movis::grab
