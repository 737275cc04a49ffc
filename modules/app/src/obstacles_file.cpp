#include "obstacles_file.h"

#include <fmt/format.h>

#include <iterator>

#include "movis/core/angle.h"

namespace movis::app {

ObstaclesFile::ObstaclesFile(const std::filesystem::path& file) : output_(file) {
  output_.stream() << "frame,time_s,azimuth_deg,distance,width,x_r,y_r,cov_xx,cov_xy,cov_yy,cameras\n";
}

void ObstaclesFile::add(const pipeline::Estimate& estimate) {
  fmt::memory_buffer rows;
  for (const Obstacle& obstacle : estimate.obstacles) {
    const auto& c = obstacle.covariance;
    fmt::format_to(std::back_inserter(rows), "{},{:.6f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.6g},{:.6g},{:.6g},{}\n",
                   estimate.index, estimate.time_s, degrees(obstacle.azimuth), obstacle.distance, obstacle.width,
                   obstacle.foot.x(), obstacle.foot.y(), c(0, 0), c(0, 1), c(1, 1), obstacle.cameras);
  }
  output_.stream().write(rows.data(), static_cast<std::streamsize>(rows.size()));
}

}  // namespace movis::app
