#pragma once

#include <fmt/core.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace movis::grab {

inline std::string rig_text(const std::vector<std::string>& cameras, int width = 32, int height = 24,
                            const std::string& more = "") {
  std::string text = "cameras:\n";
  for (const std::string& camera : cameras) {
    text += fmt::format(
        "- name: {}\n  position: [0, 0.1, 0.25]\n  yaw_deg: 0\n  tilt_deg: [0, 0]\n"
        "  image: {{width: {}, height: {}{}}}\n  model: hyperboloid\n"
        "  hyperboloid: {{a: 0.028095, b: 0.0234125, rim_radius: 0.0275}}\n"
        "  pinhole: {{fu: 33, fv: 33, u0: 15.5, v0: 11.5}}\n",
        camera, width, height, more);
  }
  return text;
}

inline std::string encoded(const cv::Mat& image, const std::string& extension, const std::vector<int>& options = {}) {
  std::vector<unsigned char> bytes;
  cv::imencode(extension, image, bytes, options);
  return {bytes.begin(), bytes.end()};
}

// One colour, which tells frame and camera.
inline cv::Mat picture(int frame, int camera) {
  return {24, 32, CV_8UC3, cv::Scalar(frame, 100 + camera, 7)};
}

// A data set of two cameras M1 and M2 with 32x24 images; row i of frames.csv is in line i + 2, frame 10 + i at 0.1·i s.
class TinyDataset {
 public:
  explicit TinyDataset(int frames) {
    write("rig.yaml", rig_text({"M1", "M2"}));
    std::string table = "frame,time_s,M1,M2\n";
    for (int i = 0; i < frames; ++i) {
      table += fmt::format("{},{},images/{}_M1.png,images/{}_M2.png\n", 10 + i, 0.1 * i, i, i);
      for (int k = 0; k < 2; ++k) write(fmt::format("images/{}_M{}.png", i, k + 1), encoded(picture(i, k), ".png"));
    }
    write("frames.csv", table);
  }

  const std::filesystem::path& path() const { return folder_.path(); }
  void write(const std::string& name, const std::string& content) const { folder_.write(name, content); }

 private:
  test::TemporaryFolder folder_;
};

}  // namespace movis::grab
