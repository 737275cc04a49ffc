#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "movis/core/paths.h"
#include "movis/grab/dataset.h"
#include "movis/grab/truth.h"
#include "movis/sim/renderer.h"

namespace movis::test {

// The opponents of the set field-obstacles, by frame.
inline std::map<std::int64_t, std::vector<sim::Obstacle>> traced_obstacles() {
  const std::string name = std::string(MOVIS_SOURCE_DIR) + "/tests/sim/field-obstacles.csv";
  std::ifstream file(name);
  std::map<std::int64_t, std::vector<sim::Obstacle>> obstacles;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] < '0' || line[0] > '9') continue;  // a comment, or the header
    for (char& c : line) c = c == ',' ? ' ' : c;
    std::int64_t frame = 0;
    sim::Obstacle cyan, magenta;
    std::istringstream(line) >> frame >> cyan.position.x() >> cyan.position.y() >> magenta.position.x() >>
        magenta.position.y();
    cyan.band = sim::Obstacle::Band::cyan;
    magenta.band = sim::Obstacle::Band::magenta;
    obstacles[frame] = {cyan, magenta};
  }
  if (obstacles.empty()) throw std::runtime_error(name + ": no rows");
  return obstacles;
}

// The scenes of a ray-traced set for our renderer: the same surfaces, the same robot, and neither blur nor noise.
class TracedSet {
 public:
  explicit TracedSet(const std::filesystem::path& folder)
      : dataset_(grab::read_dataset(folder)),
        truth_(grab::read_truth(folder / "truth.csv")),
        look_(sim::read_look(data_file("looks/hall.yaml"))) {
    robot_.radius = 0.24;
    robot_.height = 0.11;
    look_.sensor = {};
    if (dataset_.field_file) arena_.field = read_field(*dataset_.field_file);
    if (folder.filename() == "field-obstacles") obstacles_ = traced_obstacles();
  }

  const grab::Dataset& dataset() const { return dataset_; }
  const std::optional<Field>& field() const { return arena_.field; }

  void render(std::int64_t frame, grab::FrameSet& images) {
    if (!renderer_ || !obstacles_.empty()) {
      if (!obstacles_.empty()) arena_.obstacles = obstacles_.at(frame);
      renderer_.emplace(dataset_.rig, arena_, robot_, look_);
    }
    const grab::Truth& truth = truth_.at(frame);
    renderer_->render({0.0, truth.world_from_robot, truth.ball_in_field}, 1, images);
    images.index = frame;
  }

 private:
  grab::Dataset dataset_;
  std::map<std::int64_t, grab::Truth> truth_;
  std::map<std::int64_t, std::vector<sim::Obstacle>> obstacles_;
  control::RobotModel robot_;
  sim::Look look_;
  sim::Arena arena_;
  std::optional<sim::Renderer> renderer_;
};

}  // namespace movis::test
