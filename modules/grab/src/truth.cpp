#include "movis/grab/truth.h"

#include <vector>

#include "movis/core/angle.h"
#include "movis/core/csv.h"
#include "movis/core/error.h"

namespace movis::grab {

std::map<std::int64_t, Truth> read_truth(const std::filesystem::path& file) {
  static const std::vector<std::string> kHeader{"frame",  "time_s", "robot_x", "robot_y", "robot_beta",
                                                "ball_x", "ball_y", "ball_z",  "label"};
  const CsvTable table = CsvTable::read(file);
  if (table.header() != kHeader) {
    throw Error("{}:1: the header must be frame,time_s,robot_x,robot_y,robot_beta,ball_x,ball_y,ball_z,label",
                file.string());
  }
  std::map<std::int64_t, Truth> truth;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](std::size_t column) { return table.number(row, column); };
    const std::int64_t frame = table.integer(row, 0);
    const Pose2 world_from_robot{number(2), number(3), wrap_angle(number(4))};
    const Eigen::Vector3d ball_in_field(number(5), number(6), number(7));
    if (!truth.emplace(frame, Truth{number(1), world_from_robot, ball_in_field, table.text(row, 8)}).second) {
      throw Error("{}:{}: column 'frame': {} stands in an earlier line already; every frame has one truth",
                  file.string(), table.line(row), frame);
    }
  }
  if (truth.empty()) throw Error("{}: has a header but no row", file.string());
  return truth;
}

}  // namespace movis::grab
