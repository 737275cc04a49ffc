#include "movis/sim/renderer.h"

#include <algorithm>
#include <opencv2/core/mat.hpp>
#include <opencv2/core/utility.hpp>
#include <vector>

#include "movis/grab/views.h"
#include "strip.h"

namespace movis::sim {

struct Renderer::Cameras {
  Cameras(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look);

  // Memory for as many threads as OpenCV has.
  void prepare_workspaces();
  void make_strips(int worker, int workers, const State& state, std::uint64_t seed, grab::FrameSet& images);

  struct Strip {
    std::size_t camera;
    int first_row;
  };
  Stage stage;
  std::vector<CameraParts> cameras;
  std::vector<Strip> strips;
  std::vector<Workspace> workspaces;  // one a thread
};

Renderer::Cameras::Cameras(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look)
    : stage(arena, robot, look) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const int width = rig.cameras[i].width;
    cameras.push_back({Eye(rig, i, robot, look), make_sensor_row(look.sensor, width),
                       Surrounding(look.outside, look.sensor, width), look.outside});
    for (int row = 0; row < rig.cameras[i].height; row += kStripRows) strips.push_back({i, row});
  }
}

void Renderer::Cameras::prepare_workspaces() {
  const auto workers = static_cast<std::size_t>(std::max(1, cv::getNumThreads()));
  if (workspaces.size() == workers) return;
  int row_floats = 0;
  int corners = 0;
  for (const CameraParts& camera : cameras) {
    row_floats = std::max(row_floats, camera.sensor.row_floats);
    corners = std::max(corners, camera.eye.stride);
  }
  workspaces.assign(workers, Workspace(row_floats, corners));
}

void Renderer::Cameras::make_strips(int worker, int workers, const State& state, std::uint64_t seed,
                                    grab::FrameSet& images) {
  constexpr std::uint64_t kCameraStep = 1U << 20;  // more than a picture's rows
  for (auto i = static_cast<std::size_t>(worker); i < strips.size(); i += static_cast<std::size_t>(workers)) {
    const Strip& strip = strips[i];
    const CameraParts& camera = cameras[strip.camera];
    make_strip(camera, stage, state.world_from_robot, strip.first_row,
               std::min(strip.first_row + kStripRows, camera.eye.height), seed + kCameraStep * strip.camera,
               workspaces[static_cast<std::size_t>(worker)], images.memory[strip.camera].data);
  }
}

Renderer::Renderer(const omni::Rig& rig, const Arena& arena, const control::RobotModel& robot, const Look& look)
    : cameras_(std::make_unique<Cameras>(rig, arena, robot, look)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::render(const State& state, std::uint64_t noise_seed, grab::FrameSet& images) {
  const auto& cameras = cameras_->cameras;
  images.memory.resize(cameras.size());
  images.frames.resize(cameras.size());
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    images.memory[i].create(cameras[i].eye.height, cameras[i].eye.width, CV_8UC3);
    images.frames[i] = {grab::view_of(images.memory[i]), state.time_s};
  }
  cameras_->stage.set(state);
  cameras_->prepare_workspaces();
  const auto workers = static_cast<int>(cameras_->workspaces.size());
  if (workers == 1) {
    cameras_->make_strips(0, 1, state, noise_seed, images);
    return;
  }
  cv::parallel_for_(cv::Range(0, workers), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) cameras_->make_strips(i, workers, state, noise_seed, images);
  });
}

}  // namespace movis::sim
