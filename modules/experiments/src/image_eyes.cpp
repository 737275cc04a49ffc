// Level `images`: pictures rendered by the true rig, scanned with the believed one.
#include <algorithm>

#include "eyes.h"
#include "movis/scan/scanner.h"
#include "movis/sim/renderer.h"

namespace movis::experiments {
namespace {

class ImageEyes : public Eyes {
 public:
  ImageEyes(const omni::Rig& truth, const control::RobotModel& robot, const sim::Look& look,
            const scan::Colours& colours)
      : renderer_(truth, {}, robot, look), colours_(colours) {}

  int believe(const omni::Rig& rig) override {
    std::vector<scan::Scanner> scanners;
    scanners.reserve(rig.cameras.size());
    for (int camera = 0; camera < static_cast<int>(rig.cameras.size()); ++camera) {
      scanners.emplace_back(rig, camera, colours_, scan::ScanOptions{});
    }
    believed_.push_back(std::move(scanners));
    return static_cast<int>(believed_.size()) - 1;
  }

  void look_at(const Eigen::Vector2d& ball, std::uint64_t noise_seed) override {
    renderer_.render({0.0, {}, {ball.x(), ball.y(), sim::kBallRadius}}, noise_seed, images_);
  }

  void bearings(int believed, std::vector<Bearing>& bearings) override {
    std::vector<scan::Scanner>& scanners = believed_.at(static_cast<std::size_t>(believed));
    for (std::size_t i = 0; i < scanners.size(); ++i) scanners[i].scan(images_.frames[i].view, 0.0, bearings);
    const auto no_ball = [](const Bearing& bearing) { return bearing.object != ObjectClass::ball; };
    bearings.erase(std::remove_if(bearings.begin(), bearings.end(), no_ball), bearings.end());
  }

 private:
  sim::Renderer renderer_;
  scan::Colours colours_;
  grab::FrameSet images_;
  std::vector<std::vector<scan::Scanner>> believed_;
};

}  // namespace

std::unique_ptr<Eyes> make_image_eyes(const omni::Rig& truth, const control::RobotModel& robot, const sim::Look& look,
                                      const scan::Colours& colours) {
  return std::make_unique<ImageEyes>(truth, robot, look, colours);
}

}  // namespace movis::experiments
